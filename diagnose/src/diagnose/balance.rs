//! This file shows a fit by the balance of efforts: the residual before and after, on the fitted
//! and on the held-out part.

use super::write::Stand;
use super::{Contributed, Curves, FittedCurves};
use crate::candidates::realise;
use crate::evidence::{Intervals, coefficients_by_term};
use crate::filter::rms;
use crate::plant::{Plant, Run, Shown};
use crate::problem::{Problem, Term, add};
use crate::report::{Agreement, BeforeAfter, FitReport};
use crate::rules::HELD_OUT_TIMES;
use crate::selection::{Selection, refs};
use rigproof_spec::effect::Quantity;

/// The result of a fit by the balance of efforts.
pub(crate) fn shown<P: Plant>(stand: &Stand<'_, P>, intervals: &Intervals) -> Shown<P> {
    let test = stand.balanced(stand.test, stand.test_from_s);
    let calibration = P::calibrated(stand, intervals);
    let asked = stand.options.refit && stand.test_from_s < stand.test.clock().duration_s();
    let train = asked.then(|| stand.balanced(stand.train, 0.0));
    let fit = train
        .as_ref()
        .map(|train| stand.balance_report((train, &test), &calibration));
    Shown {
        calibration,
        fit,
        curves: stand.balance_curves(train, test),
    }
}

/// The windows of a recording with the model before and after.
struct Balanced {
    times_s: Vec<f64>,
    usable: Vec<bool>,
    /// Whether a row belongs to one output alone.
    whole: Vec<bool>,
    recorded: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    /// The noise floor of the usable rows, N·m.
    floor: f64,
}

impl<P: Plant> Stand<'_, P> {
    /// The selection without the found mechanisms.
    pub(crate) fn bare(&self) -> Selection {
        Selection {
            found: Vec::new(),
            after: self.selection.before.clone(),
            ..self.selection.clone()
        }
    }

    /// Both models on a recording from a time on, with the parameters of the fitted part.
    fn balanced(&self, run: &P::Run, from_s: f64) -> Balanced {
        let width_s = self.problem.windows.width_s();
        let step_s = run.clock().step_s;
        let mut windows = run.all_windows(width_s);
        windows.keep(|centre, bump| {
            (centre - bump.len() / 2) as f64 * step_s >= from_s - 0.5 * step_s
        });
        run.keep_told(&mut windows);
        let problem = Problem::new(run, windows);
        let bare = self.bare();
        let centres = problem.windows.centres.iter();
        let before_it = centres.take_while(|&&centre| (centre as f64) * step_s < from_s);
        let first = before_it.count();
        let average = |signal: &[f64]| problem.windows.average(signal).split_off(first);
        let usable = problem.windows.usable.clone().split_off(first);
        let mut combined = problem.windows.combined.clone();
        Balanced {
            times_s: problem.windows.times_s().split_off(first),
            whole: usable
                .iter()
                .zip(combined.split_off(first))
                .map(|(u, c)| *u && c.is_none())
                .collect(),
            usable,
            recorded: average(&run.driving()),
            before: modelled(&problem, &bare, |_| true).split_off(first),
            after: modelled(&problem, self.selection, |_| true).split_off(first),
            floor: problem.floor,
        }
    }

    fn balance_report(&self, (train, test): (&Balanced, &Balanced), calibration: &P) -> FitReport {
        let (horizon, free_runs) = P::free_runs(self, calibration);
        let least = test.floor;
        let train = before_after(train);
        let held_out = before_after(test);
        let where_from = if self.other_recording {
            "another recording"
        } else {
            "the end of the recording"
        };
        FitReport {
            protocol: format!(
                "before and after: balance of efforts over the usable windows along the recorded motion, numbers from the fitted part, no refit by free runs; held out: {where_from}; {free_runs}"
            ),
            unit: self.effort_unit(),
            train,
            held_out: Some(held_out),
            held_out_without_refit: None,
            held_out_from_rest: None,
            horizon,
            recovered_share: (held_out.before - held_out.after)
                / (held_out.before - least).max(1e-300),
            improved: held_out.after < held_out.before,
            agreement: Some(self.balance_agreement(test)),
            drift: None,
        }
    }

    /// Whether the held-out windows leave no more than the fitted ones, both relative to the noise
    /// floor.
    fn balance_agreement(&self, test: &Balanced) -> Agreement {
        let allowed = HELD_OUT_TIMES * test.floor * self.floor().ratio_after.max(1.0);
        let pairs = test.recorded.iter().zip(&test.after).zip(&test.usable);
        let counted = pairs.zip(&test.times_s).filter(|((_, usable), _)| **usable);
        let errors = counted.map(|(((recorded, after), _), time_s)| (recorded - after, *time_s));
        Agreement::of(&errors.collect::<Vec<_>>(), allowed)
    }

    fn effort_unit(&self) -> String {
        let motion = self.train.motion_kind();
        Quantity::Effort.dimension(motion).to_string()
    }

    /// The contribution of each named mechanism in the windows of the fitted part. `of` takes the
    /// shown ones.
    pub(crate) fn contributed(&self, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Contributed> {
        let (problem, selection) = (self.problem, self.selection);
        let known = modelled(problem, selection, |_| false);
        let found = selection.found.iter();
        found
            .map(|found| {
                let mut effort =
                    modelled(problem, selection, |term| core::ptr::eq(term, &found.term));
                add(&mut effort, &known, -1.0);
                Contributed {
                    name: problem.name(found.term.cause),
                    effort: of(&effort),
                }
            })
            .collect()
    }

    /// The curves of the output with the larger unexplained residual; NaN where a window does not
    /// count.
    fn balance_curves(&self, train: Option<Balanced>, test: Balanced) -> Curves {
        let counted = |values: &[f64], usable: &[bool]| -> Vec<f64> {
            let pairs = values.iter().zip(usable);
            pairs.map(|(v, u)| if *u { *v } else { f64::NAN }).collect()
        };
        let windows = &self.problem.windows;
        let outputs = windows.outputs;
        // A row that combines both equations appears in neither picture.
        let own = windows.usable.iter().zip(&windows.combined);
        let usable: Vec<bool> = own.map(|(u, combined)| *u && combined.is_none()).collect();
        let before = counted(&self.selection.before.residual, &usable);
        let after = counted(&self.selection.after.residual, &usable);
        let energy = |output: usize| -> f64 {
            let rows = before.iter().skip(output).step_by(outputs);
            rows.filter(|r| r.is_finite()).map(|r| r * r).sum()
        };
        let loudest = (1..outputs).fold(0, |loudest, output| {
            if energy(output) > energy(loudest) {
                output
            } else {
                loudest
            }
        });
        let output = loudest;
        let of = |values: &[f64]| -> Vec<f64> {
            values
                .iter()
                .skip(output)
                .step_by(outputs)
                .copied()
                .collect()
        };
        let shown = |own: &Balanced| FittedCurves {
            time_s: of(&own.times_s),
            recorded: of(&counted(&own.recorded, &own.whole)),
            before: of(&counted(&own.before, &own.whole)),
            after: of(&counted(&own.after, &own.whole)),
        };
        let held_out = shown(&test);
        Curves {
            fitted: train.as_ref().map(shown).unwrap_or_default(),
            time_s: held_out.time_s,
            output: self.train.output_name(output),
            recorded: held_out.recorded,
            before: held_out.before,
            after: held_out.after,
            unit: self.effort_unit(),
            window_time_s: of(&self.problem.windows.times_s()),
            window_counts: usable
                .iter()
                .skip(output)
                .step_by(outputs)
                .copied()
                .collect(),
            residual_before: of(&before),
            residual_after: of(&after),
            contributed: self.contributed(of),
            floor: self.problem.floor,
            residual_unit: self.effort_unit(),
        }
    }
}

/// The modelled effort of a selection on a problem with other rows, from the terms that act.
pub(crate) fn modelled(
    problem: &Problem,
    selection: &Selection,
    acts: impl Fn(&Term) -> bool,
) -> Vec<f64> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let mut sum = problem.windows.average(&problem.known);
    let terms = refs(&selection.nominal, &selection.found);
    for (term, own) in terms
        .iter()
        .zip(&coefficients)
        .filter(|(term, _)| acts(term))
    {
        let Some(moved) = realise(problem, term.cause, &term.shape, term.onset_s, &[]) else {
            continue;
        };
        let given = term.known.as_ref().unwrap_or(own);
        for (c, rows) in given.iter().zip(&moved.free) {
            add(&mut sum, &rows.raw, *c);
        }
        if let Some(rows) = &moved.fixed {
            add(&mut sum, &rows.raw, 1.0);
        }
    }
    sum
}

fn before_after(balanced: &Balanced) -> BeforeAfter {
    let kept = |values: &[f64]| -> Vec<f64> {
        let pairs = values.iter().zip(&balanced.recorded).zip(&balanced.usable);
        pairs
            .filter(|(_, u)| **u)
            .map(|((v, r), _)| r - v)
            .collect()
    };
    let size = rms(&kept(&vec![0.0; balanced.recorded.len()])).max(1e-300);
    let (before, after) = (rms(&kept(&balanced.before)), rms(&kept(&balanced.after)));
    BeforeAfter {
        before,
        after,
        nrmse_before: 100.0 * before / size,
        nrmse_after: 100.0 * after / size,
    }
}
