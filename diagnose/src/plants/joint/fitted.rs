//! This file fits the nominal and the extended model, and gives their free runs.

use super::inertia::Inertia;
use crate::diagnose::write::Stand;
use crate::diagnose::{Curves, FittedCurves};
use crate::effect::Effect;
use crate::evidence::{Intervals, coefficients_by_term, parameters};
use crate::plants::joint::free_run::{HORIZONS_S, Shown, figure, horizon_error, show};
use crate::plants::joint::from_rig;
use crate::plants::joint::refit::error_rms;
use crate::plants::joint::run::{JointRun, PlantKind};
use crate::plants::joint::simulate::{Model, Protocol, output};
use crate::report::{BeforeAfter, FitReport, HELD_OUT_PART, Horizon};
use crate::selection::{floor_limit, refs};
use rigproof_spec::effect::Quantity;
use rigproof_trace::rig::Rig;

/// The fitted nominal and extended model, with their free runs.
pub(crate) struct Fitted {
    pub(crate) nominal: Shown,
    pub(crate) found: Shown,
    pub(crate) by_windows: Model,
    /// Whether the output-error refit predicts the held-out part better than the weak-form fit.
    pub(crate) is_refitted: bool,
}

/// The refitted parameters or those of the weak form, whichever predict the held-out part better.
fn better(refitted: Shown, windows: &Model, run: &JointRun, protocol: &Protocol) -> (Shown, bool) {
    let error = |plant: &Model| error_rms(plant, run, protocol);
    let (of_refit, of_windows) = (error(&refitted.plant), error(windows));
    match of_windows < of_refit || !of_refit.is_finite() && of_windows.is_finite() {
        true => {
            let shown = Shown {
                plant: windows.clone(),
                drift: None,
                ..refitted
            };
            (shown, false)
        }
        false => (refitted, true),
    }
}

/// The intervals of the refitted parameters: those of the weak form, widened by the difference
/// between the two fits, which estimates the model error.
pub(crate) fn wider(intervals: &Intervals, fitted: &Fitted) -> Intervals {
    let (windows, runs) = (&fitted.by_windows, &fitted.found.plant);
    let mut wider = intervals.clone();
    if let Some(half) = wider.nuisances.first_mut() {
        *half += (runs.inertia - windows.inertia).abs();
    }
    let effects = windows.effects.iter().zip(&runs.effects);
    for (halves, (windows, runs)) in wider.terms.iter_mut().zip(effects) {
        let numbers = windows.parameters.iter().zip(&runs.parameters);
        for (half, (windows, runs)) in halves.iter_mut().zip(numbers) {
            *half += (runs - windows).abs();
        }
    }
    wider
}

impl Stand<'_, Rig> {
    /// The model of the weak-form fit, with or without the mechanisms found.
    pub(crate) fn model(&self, found: bool) -> Model {
        let mut selection = self.selection.clone();
        if !found {
            selection.found.clear();
            selection.after = selection.before.clone();
        }
        let (nuisances, coefficients) = coefficients_by_term(self.problem, &selection);
        let terms = refs(&selection.nominal, &selection.found);
        let effects = terms
            .iter()
            .zip(&coefficients)
            .map(|(term, own)| Effect {
                cause: term.cause,
                parameters: parameters(self.problem, term, own),
                unknown: term.known.is_none(),
                onset_s: term.onset_s,
            })
            .collect();
        let given = from_rig::plant(self.plant).inertia;
        Model {
            described: self.selection.nominal.len(),
            inertia: nuisances
                .first()
                .copied()
                .unwrap_or(given)
                .max(1e-3 * given),
            effects,
        }
    }

    pub(crate) fn fit(&self, protocol: &Protocol) -> Option<Fitted> {
        if !self.options.refit {
            return None;
        }
        let inertia_free = matches!(self.train.inertia, Inertia::Unknown(_));
        // The edges of a brake's torque are known to one sample and would dominate a free run. A
        // brake keeps the parameters of the weak form.
        let stays = self.train.brake().is_some();
        let nominal = self.selection.nominal.iter();
        let known_nominal: Vec<bool> = nominal.map(|t| stays || t.known.is_some()).collect();
        let mut known_all = known_nominal.clone();
        known_all.extend(self.selection.found.iter().map(|_| stays));
        let by_windows = self.model(true);
        let found = show(
            &by_windows,
            inertia_free,
            &known_all,
            self.train,
            protocol,
            // Where the windows leave only noise, there is no drift to fit.
            !self.selection.found.is_empty()
                && self.floor().ratio_after > floor_limit(self.problem),
        );
        let bare = self.model(false);
        let nominal = show(
            &bare,
            inertia_free,
            &known_nominal,
            self.train,
            protocol,
            false,
        );
        let (nominal, _) = better(nominal, &bare, self.test, protocol);
        let (found, is_refitted) = better(found, &by_windows, self.test, protocol);
        Some(Fitted {
            nominal,
            found,
            by_windows,
            is_refitted,
        })
    }

    pub(crate) fn fit_report(
        &self,
        fitted: &Fitted,
        intervals: &Intervals,
        protocol: &Protocol,
    ) -> FitReport {
        let pair = |run: &JointRun| {
            let (before, size) = figure(&fitted.nominal.plant, run, protocol);
            let (after, _) = figure(&fitted.found.plant, run, protocol);
            let percent = |x: f64| 100.0 * x / size.max(1e-300);
            BeforeAfter {
                before,
                after,
                nrmse_before: percent(before),
                nrmse_after: percent(after),
            }
        };
        let (train, held_out) = (pair(self.train), pair(self.test));
        let floor = match self.train.plant {
            PlantKind::Axis => self.train.position_noise,
            PlantKind::Bench => self.train.effort_noise,
        };
        let horizon = HORIZONS_S
            .into_iter()
            .filter_map(|horizon_s| {
                Some(Horizon {
                    horizon_s,
                    part: HELD_OUT_PART,
                    unit: self.output_unit(),
                    tip_before_mm: None,
                    tip_after_mm: None,
                    before: horizon_error(&fitted.nominal.plant, self.test, protocol, horizon_s)?,
                    after: horizon_error(&fitted.found.plant, self.test, protocol, horizon_s)?,
                })
            })
            .collect();
        let (windows_only, _) = figure(&fitted.by_windows, self.test, protocol);
        FitReport {
            protocol: self.fit_protocol(protocol),
            unit: self.output_unit(),
            train,
            held_out: Some(held_out),
            held_out_without_refit: Some(windows_only),
            held_out_from_rest: (protocol.warm_up_periods > 0).then(|| {
                let from_rest = Protocol {
                    warm_up_periods: 0,
                    start_samples: 0,
                    ..*protocol
                };
                figure(&fitted.found.plant, self.test, &from_rest).0
            }),
            horizon,
            recovered_share: (held_out.before - held_out.after) / (held_out.before - floor).max(1e-300),
            improved: held_out.after < held_out.before,
            agreement: self.agreement(&fitted.found.plant, intervals, protocol),
            drift: fitted.found.drift.map(|rate| {
                format!("the free run of the fitted part drifts by a constant effort that changes at {rate:.4e} {}; a warming drive, a slow load or wear would look the same", Quantity::EffortPerTime.dimension(self.plant.motion))
            }),
        }
    }

    pub(crate) fn free_run_curves(
        &self,
        before: &Model,
        after: &Model,
        protocol: &Protocol,
    ) -> Curves {
        let run = self.test;
        let times = |run: &JointRun| -> Vec<f64> {
            let all = 0..run.len();
            all.map(|k| run.start_s + k as f64 * run.step_s).collect()
        };
        let recorded = |run: &JointRun| match run.plant {
            PlantKind::Axis => run.position.clone(),
            PlantKind::Bench => run.effort.clone(),
        };
        let fitted = FittedCurves {
            time_s: times(self.train),
            recorded: recorded(self.train),
            before: output(before, self.train, protocol),
            after: output(after, self.train, protocol),
        };
        Curves {
            fitted,
            time_s: times(run),
            output: match run.plant {
                PlantKind::Axis => "position",
                PlantKind::Bench => "metered effort",
            },
            recorded: recorded(run),
            before: output(before, run, protocol),
            after: output(after, run, protocol),
            unit: self.output_unit(),
            window_time_s: self.problem.windows.times_s(),
            window_counts: self.problem.windows.usable.clone(),
            residual_before: self.selection.before.residual.clone(),
            residual_after: self.selection.after.residual.clone(),
            contributed: self.contributed(<[f64]>::to_vec),
            floor: self.problem.floor,
            residual_unit: Quantity::Effort.dimension(self.plant.motion).to_string(),
        }
    }

    pub(crate) fn output_unit(&self) -> String {
        let quantity = match self.train.plant {
            PlantKind::Axis => Quantity::Travel,
            PlantKind::Bench => Quantity::Effort,
        };
        quantity.dimension(self.plant.motion).to_string()
    }
}
