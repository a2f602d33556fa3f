//! This file runs the stages on a recording of the five-bar: align, locate, explain, doubt, show.

use super::experiment;
use super::free_run::{Model, horizons};
use super::held::held;
use super::held_out::Parts;
use super::locate::locate;
use super::mapping;
use super::run::FiveBarRun;
use super::undone::{left, undone_first};
use crate::align::Fault;
use crate::candidates::realise;
use crate::diagnose::ended::{blank, faulty, not_excited};
use crate::diagnose::words::summary;
use crate::diagnose::write::{floor, verdict};
use crate::diagnose::{Curves, Description, Diagnosis, FittedCurves, Options};
use crate::evidence::{
    Rivals, coefficients_by_term, inclusion, inconstant, intervals, is_told_by_itself, not_seen,
    rivals,
};
use crate::problem::{Cause, NominalEffect, Problem, Term, add};
use crate::report::{
    BeforeAfter, EffectReport, FITTED_PART, FitReport, HELD_OUT_PART, Horizon, Report, StageReport,
};
use crate::rules::{QUIET_NM, WIDTHS_S};
use crate::run::rms;
use crate::select::{Selection, floor_limit, refs, select};
use crate::weak::{FEWEST_WINDOWS, Windows};
use crate::write_rig::numbers;
use rigproof_model::effects::entry;
use rigproof_spec::effect::Motion;
use rigproof_spec::joint::Joint;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};

/// Diagnoses recordings of a five-bar together; `held_out` is another recording of the same rig. Without it the last of many shows the
/// result, or the end of the last.
pub fn diagnose(
    rig: &FiveBar,
    recordings: &[&FiveBarRecording],
    held_out: Option<&FiveBarRecording>,
    options: &Options,
) -> Diagnosis {
    let description = || Description::FiveBar(rig.clone());
    let parts = match Parts::of(rig, recordings, held_out, options) {
        Ok(parts) => parts,
        Err((which, fault)) => return faulty(description(), &which, fault),
    };
    let Parts { train, test, .. } = &parts;
    let mut problem = problem(train);
    let usable = problem.windows.usable.iter().filter(|u| **u).count() / problem.windows.outputs;
    if usable < FEWEST_WINDOWS {
        return not_excited(description(), usable, travel(train), train.theta_noise);
    }
    // A description with effects of its own was balanced before; without them its recording may be far from balance.
    if rig.effects.is_empty()
        && let Err(fault) = mapping::check(train, &problem)
    {
        return faulty(description(), "recording", fault);
    }
    let mut terms: Vec<Term> = Vec::new();
    for effect in left(rig) {
        let Some(mut term) = problem.nominal_term(&effect) else {
            return faulty(description(), "description", meaningless(&effect));
        };
        // A spring of the description has its rest angle in a constant bias of its own.
        let linear = entry(effect.cause.mechanism).map_or(0, |entry| entry.linear);
        term.free.truncate(linear);
        terms.push(term);
    }
    let mut selection = select(&mut problem, terms, options.gates);
    let withdrawn = withdraw_inconstant(&problem, &mut selection);
    Stand {
        rig,
        problem: &problem,
        selection: &selection,
        withdrawn: &withdrawn,
        train,
        test,
        test_from_s: parts.test_from_s,
        options,
    }
    .report(parts.other_recording)
}

/// Takes out the names whose number is not constant where more than noise is left, and what then explains too little. Where
/// something with a memory would explain as much, that may be what changes the number: the name stays beside it, as ambiguous.
fn withdraw_inconstant(problem: &Problem, selection: &mut Selection) -> Vec<Cause> {
    let mut withdrawn = Vec::new();
    loop {
        let mut causes = inconstant(problem, selection);
        if !causes.is_empty() {
            let rivals = rivals(problem, selection);
            let pairs = selection.found.iter().zip(&rivals);
            let told =
                pairs.filter(|(_, own)| own.instead.iter().all(|c| is_told_by_itself(c.mechanism)));
            let told: Vec<Cause> = told.map(|(found, _)| found.term.cause).collect();
            causes.retain(|cause| told.contains(cause));
        }
        if causes.is_empty() {
            return withdrawn;
        }
        selection.withdraw(problem, &causes);
        selection.weigh_again(problem);
        withdrawn.extend(causes);
    }
}

/// A nominal effect that has no meaning on this layout or at this joint.
fn meaningless(effect: &NominalEffect) -> Fault {
    Fault {
        channel: "effect",
        from_s: 0.0,
        to_s: 0.0,
        reason: format!(
            "`{}` cannot stand in the nominal model of this five-bar; take it out, or give it a joint that has it",
            effect.cause.name()
        ),
    }
}

/// The problem with the narrowest windows whose predicted floor is small against the driving effort.
fn problem(run: &FiveBarRun) -> Problem<'_> {
    let over = |width_s| {
        let windows = Windows::over(run.len(), 2, (run.step_s, run.start_s), width_s);
        Problem::of_five_bar(run, windows)
    };
    let quiet = |problem: &Problem| problem.floor <= QUIET_NM;
    let [narrow, middle, wide] = WIDTHS_S;
    let narrow = over(narrow);
    if quiet(&narrow) {
        return narrow;
    }
    let middle = over(middle);
    if quiet(&middle) { middle } else { over(wide) }
}

/// The greatest range of θA and θB, rad.
fn travel(run: &FiveBarRun) -> f64 {
    let range = |theta: &Vec<f64>| {
        let low = theta.iter().copied().fold(f64::INFINITY, f64::min);
        theta.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
    };
    run.theta.iter().map(range).fold(0.0, f64::max)
}

/// Everything the report is written from.
pub(super) struct Stand<'a> {
    pub(super) rig: &'a FiveBar,
    pub(super) problem: &'a Problem<'a>,
    pub(super) selection: &'a Selection,
    pub(super) withdrawn: &'a [Cause],
    pub(super) train: &'a FiveBarRun,
    pub(super) test: &'a FiveBarRun,
    /// Where the held-out part of `test` begins, s after its first sample.
    pub(super) test_from_s: f64,
    pub(super) options: &'a Options,
}

/// The windows of a recording with the models before and after.
struct Balanced {
    times_s: Vec<f64>,
    usable: Vec<bool>,
    /// Which rows are one output's alone.
    whole: Vec<bool>,
    recorded: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    /// What sensor noise alone leaves in the usable rows, N·m.
    floor: f64,
}

impl Stand<'_> {
    fn report(&self, other_recording: bool) -> Diagnosis {
        let (problem, selection) = (self.problem, self.selection);
        let all = rivals(problem, selection);
        let rivals: Vec<Vec<String>> = all.iter().map(Rivals::names).collect();
        let floor = floor(problem, selection, Motion::Rotary);
        let verdict = verdict(selection, &floor, floor_limit(problem), &rivals);
        let test = self.balanced(self.test, self.test_from_s);
        let intervals = intervals(problem, selection);
        let calibration = self.calibrated(&intervals);
        let asked = self.options.refit && self.test_from_s < self.test.duration_s();
        let train = asked.then(|| self.balanced(self.train, 0.0));
        let fit = train
            .as_ref()
            .map(|train| self.fit_report((train, &test), &calibration, other_recording));
        let (next_experiment, experiment) = match self.options.next_experiment {
            true => experiment::next(self, &all).unzip(),
            false => (None, None),
        };
        let mut protocol = self.protocol(other_recording);
        protocol.extend(fit.iter().map(|fit| fit.protocol.clone()));
        let (before, after) = (&selection.before.residual, &selection.after.residual);
        let summary = summary(verdict, selection, fit.as_ref(), &rivals);
        let report = Report {
            protocol,
            located: locate(problem, self.train, before, after),
            stages: self.stages(),
            effects: self.effects(&calibration, &all),
            ambiguous_with: rivals,
            too_small_to_name: selection.too_small.iter().map(|c| c.name()).collect(),
            withdrawn: self.withdrawn.iter().map(|c| c.name()).collect(),
            not_seen: not_seen(problem, selection, self.options.gates, Motion::Rotary),
            held: held(problem, self.train, selection),
            fit,
            next_experiment,
            floor: Some(floor.clone()),
            ..blank("rig", verdict, summary)
        };
        let curves = self.curves(train, test, floor.unit);
        Diagnosis {
            report,
            calibration: Description::FiveBar(calibration),
            curves,
            experiment: experiment.flatten(),
        }
    }

    fn stages(&self) -> Vec<StageReport> {
        let stages = self.selection.stages.iter();
        stages
            .map(|stage| StageReport {
                entered: stage.entered.mechanism.name(),
                joint: stage.entered.joint.map(Joint::letter),
                standing: stage.standing.iter().map(|c| c.name()).collect(),
                residual: stage.residual,
                inverse_error_percent: None,
            })
            .collect()
    }

    /// The selection with nothing found.
    fn bare(&self) -> Selection {
        Selection {
            found: Vec::new(),
            after: self.selection.before.clone(),
            ..self.selection.clone()
        }
    }

    /// The models before and after on a recording from a time on, both with the numbers of the fitted part.
    fn balanced(&self, run: &FiveBarRun, from_s: f64) -> Balanced {
        let fitted = &self.problem.windows;
        let width_s = (fitted.bump.len() - 1) as f64 * fitted.step_s;
        let mut windows = Windows::over(run.len(), 2, (run.step_s, run.start_s), width_s);
        windows.keep(|centre, bump| {
            (centre - bump.len() / 2) as f64 * run.step_s >= from_s - 0.5 * run.step_s
        });
        let problem = Problem::of_five_bar(run, windows);
        let bare = self.bare();
        let centres = problem.windows.centres.iter();
        let before_it = centres.take_while(|&&centre| (centre as f64) * run.step_s < from_s);
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
            recorded: average(&super::columns::driving(run, run.forces())),
            before: modelled(&problem, &bare, |_| true).split_off(first),
            after: modelled(&problem, self.selection, |_| true).split_off(first),
            floor: problem.floor,
        }
    }

    /// Errors of free runs with the nominal effects of the calibration and with all of them, and how they were made.
    fn free_runs(&self, calibration: &FiveBar) -> (Vec<Horizon>, String) {
        let bare = self.bare();
        let intervals = intervals(self.problem, &bare);
        let nominal = Stand {
            selection: &bare,
            ..*self
        };
        // The runs have the angles that the linkage had.
        let (undone, _) = undone_first(self.rig);
        let model = |calibration: &FiveBar| {
            let mut own = calibration.clone();
            own.effects.drain(..undone.len());
            Model::of(&own)
        };
        let before = model(&nominal.calibrated(&intervals));
        let after = model(calibration);
        let first = (self.test_from_s / self.test.step_s).round() as usize;
        // Of several recordings the first: a run does not go across a seam.
        let fitted = self.train.parts.first().unwrap_or(self.train);
        let parts = [
            (HELD_OUT_PART, self.test, first..self.test.len()),
            (FITTED_PART, fitted, 0..fitted.len()),
        ];
        let (mut all, mut said) = (Vec::new(), Vec::new());
        for (name, run, part) in parts {
            match horizons(&before, &after, run, part, name) {
                Ok((horizons, words)) => {
                    all.extend(horizons);
                    said.push(words);
                }
                Err(error) => return (Vec::new(), format!("no free runs: {error}")),
            }
        }
        let how = format!(
            "free runs of the reference rig from the smoothed recorded state, brakes and memories led along the recording to there, steps of at most 1 ms, force straight between samples, currents held; angles of A and B and tip against the recording, {}",
            said.join(", ")
        );
        (all, how)
    }

    fn fit_report(
        &self,
        (train, test): (&Balanced, &Balanced),
        calibration: &FiveBar,
        other_recording: bool,
    ) -> FitReport {
        let (horizon, free_runs) = self.free_runs(calibration);
        let least = test.floor;
        let train = before_after(train);
        let held_out = before_after(test);
        let where_from = if other_recording {
            "another recording"
        } else {
            "the end of the recording"
        };
        FitReport {
            protocol: format!(
                "before and after: balance of efforts over the usable windows along the recorded motion, numbers from the fitted part, no refit by free runs; held out: {where_from}; {free_runs}"
            ),
            unit: "N·m".to_owned(),
            train,
            held_out: Some(held_out),
            held_out_without_refit: None,
            held_out_from_rest: None,
            horizon,
            recovered_share: (held_out.before - held_out.after)
                / (held_out.before - least).max(1e-300),
            improved: held_out.after < held_out.before,
            drift: None,
        }
    }

    fn effects(&self, calibration: &FiveBar, limits: &[Rivals]) -> Vec<EffectReport> {
        let offset = undone_first(self.rig).0.len() + self.selection.nominal.len();
        let found = self.selection.found.iter().enumerate();
        found
            .filter_map(|(index, found)| {
                let cause = found.term.cause;
                let entry = entry(cause.mechanism)?;
                let fitted = calibration.effects.get(offset + index)?;
                Some(EffectReport {
                    mechanism: cause.mechanism.name(),
                    joint: cause.joint.map(Joint::letter),
                    parameters: numbers(&fitted.effect, Motion::Rotary),
                    onset_s: found.term.onset_s,
                    onset_low95_s: fitted.effect.onset.and_then(|onset| onset.low95),
                    onset_high95_s: fitted.effect.onset.and_then(|onset| onset.high95),
                    z: found.z,
                    inclusion: inclusion(self.problem, self.selection, index, self.options.gates),
                    share_explained: found.share,
                    equation: entry.equation,
                    refuted_by: entry.refuted_by,
                    limit_of: limits.get(index).map_or_else(Vec::new, Rivals::limits),
                })
            })
            .collect()
    }

    /// The held-out balance and the residual of the output in which more was unexplained; not a number where a window does not count.
    fn curves(&self, train: Option<Balanced>, test: Balanced, unit: String) -> Curves {
        let counted = |values: &[f64], usable: &[bool]| -> Vec<f64> {
            let pairs = values.iter().zip(usable);
            pairs.map(|(v, u)| if *u { *v } else { f64::NAN }).collect()
        };
        let windows = &self.problem.windows;
        // A row that combines both equations belongs to neither picture.
        let own = windows.usable.iter().zip(&windows.combined);
        let usable: Vec<bool> = own.map(|(u, combined)| *u && combined.is_none()).collect();
        let before = counted(&self.selection.before.residual, &usable);
        let after = counted(&self.selection.after.residual, &usable);
        let energy = |output: usize| -> f64 {
            let rows = before.iter().skip(output).step_by(2);
            rows.filter(|r| r.is_finite()).map(|r| r * r).sum()
        };
        let output = usize::from(energy(1) > energy(0));
        let of = |values: &[f64]| -> Vec<f64> {
            values.iter().skip(output).step_by(2).copied().collect()
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
            output: if output == 0 {
                "effort on arm AE (θA)"
            } else {
                "effort on arm BC (θB)"
            },
            recorded: held_out.recorded,
            before: held_out.before,
            after: held_out.after,
            unit: unit.clone(),
            window_time_s: of(&self.problem.windows.times_s()),
            window_counts: usable.iter().skip(output).step_by(2).copied().collect(),
            residual_before: of(&before),
            residual_after: of(&after),
            floor: self.problem.floor,
            residual_unit: unit,
        }
    }
}

/// What a selection's numbers give on a problem of other rows, of the terms that act.
pub(super) fn modelled(
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
