//! This file writes the report of a recording from which something could be concluded.

use super::ended::blank;
use super::numbers::numbers;
use super::words::summary;
use super::{Diagnosis, Options};
use crate::cause::Cause;
use crate::effect::Effect;
use crate::evidence::{Intervals, inclusion, not_seen, null_directions};
use crate::explain::{Explanations, status};
use crate::locate::locate;
use crate::plant::{Plant, Run, Shown};
use crate::problem::Problem;
use crate::report::{EffectReport, ExplanationReport, Floor, Report, Unknown, Verdict};
use crate::rules::{MOST_LISTED, NAMED};
use crate::scatter::{Trials, left_over};
use crate::selection::{Selection, floor_limit, refs, usable_rms};
use crate::unknown::unknown;
use rigproof_model::effects::entry;
use rigproof_spec::effect::Quantity;
use rigproof_trace::rig::{RigEffect, Value};

/// The residual of the windows beside the predicted sensor noise.
pub(crate) fn floor(problem: &Problem, selection: &Selection) -> Floor {
    let predicted = problem.floor;
    let before = usable_rms(problem, &selection.before.residual);
    let after = usable_rms(problem, &selection.after.residual);
    Floor {
        predicted,
        measured_before: before,
        measured_after: after,
        ratio_before: before / predicted,
        ratio_after: after / predicted,
        unit: Quantity::Effort
            .dimension(problem.run.motion_kind())
            .to_string(),
    }
}

/// The verdict on a selection.
pub(crate) fn verdict(
    selection: &Selection,
    floor: &Floor,
    limit: f64,
    rivals: &[Vec<String>],
    mended: &[Effect],
) -> Verdict {
    let explained = floor.ratio_after <= limit;
    // A name below the probability for naming has rivals. Names that were not compared have rivals
    // if any are listed.
    let by_name = selection.found.iter().zip(rivals);
    let is_open = by_name.into_iter().any(|(own, rivals)| {
        own.probability < NAMED || own.probability >= 1.0 && !rivals.is_empty()
    });
    match (selection.found.is_empty() && mended.is_empty(), explained) {
        (true, true) => Verdict::Consistent,
        (true, false) => Verdict::NoneOfLibrary,
        (false, false) => Verdict::PartlyExplained,
        (false, true) if is_open => Verdict::Ambiguous,
        (false, true) => Verdict::Explained,
    }
}

/// Everything that the report is written from.
pub struct Stand<'a, P: Plant> {
    /// The description.
    pub plant: &'a P,
    /// The problem of the fitted part.
    pub problem: &'a Problem<'a>,
    /// What was named.
    pub selection: &'a Selection,
    /// What was named and withdrawn.
    pub withdrawn: &'a [Cause],
    /// The fitted part.
    pub train: &'a P::Run,
    /// The recording on which the result is shown.
    pub test: &'a P::Run,
    /// Time at which the held-out part of `test` begins, s after its first sample.
    pub test_from_s: f64,
    /// Whether it is a separate recording.
    pub other_recording: bool,
    pub options: &'a Options,
    /// Trials of a brake with different gains; `problem` is then restricted to within trials.
    pub trials: Option<&'a Trials>,
    /// The explanations that were compared.
    pub explanations: &'a Explanations,
}

impl<P: Plant> Stand<'_, P> {
    /// The report of what is shown; `intervals` are those of the selection.
    pub(crate) fn report(&self, shown: Shown<P>, intervals: &Intervals) -> Diagnosis<P> {
        let (problem, selection) = (self.problem, self.selection);
        let all = self.rivals();
        let mut rivals: Vec<Vec<String>> = all
            .iter()
            .map(|own| own.iter().map(|cause| problem.name(*cause)).collect())
            .collect();
        let floor = self.floor();
        let mended = self.train.remarks().iter();
        let mended: Vec<Effect> = mended.filter_map(|own| own.cause.clone()).collect();
        let verdict = verdict(selection, &floor, floor_limit(problem), &rivals, &mended);
        let is_left = floor.ratio_after > floor_limit(problem);
        let unknown = is_left.then(|| self.unknown()).flatten();
        let Shown {
            calibration,
            fit,
            curves,
        } = shown;
        // Composed variants are not simulated yet.
        let is_plain = !selection
            .found
            .iter()
            .any(|own| own.term.cause.is_composed());
        let (next_experiment, experiment) = match self.options.next_experiment && is_plain {
            true => P::next_experiment(self, &all).unzip(),
            false => (None, None),
        };
        let (before, after) = (&selection.before.residual, &selection.after.residual);
        let remarks = self.remarks(&floor, intervals);
        let summary = summary(problem, verdict, selection, fit.as_ref(), &rivals, &mended);
        let mut effects = self.effects(&calibration.found(self, intervals));
        effects.extend(mended.iter().filter_map(|own| self.mended(own)));
        rivals.resize(effects.len(), Vec::new());
        let names = |causes: &[Cause]| causes.iter().map(|c| problem.name(*c)).collect();
        let mut protocol = P::protocol(self, fit.as_ref());
        protocol.extend(remarks.iter().map(|own| own.words.clone()));
        let report = Report {
            protocol,
            located: locate(problem, before, after),
            stages: self.stages(),
            effects,
            ambiguous_with: rivals,
            withdrawn: names(self.withdrawn),
            nominal: self.plant.nominal_numbers(&calibration),
            inverse_model: self.inverse_model(&[]),
            not_seen: not_seen(problem, selection),
            held: P::held(self),
            arm: P::arm(self),
            null_directions: null_directions(problem, selection),
            unknown,
            fit,
            next_experiment,
            floor: Some(floor),
            explanations: self.explained(),
            remarks,
            ..blank(self.plant.plant_name(), verdict, summary)
        };
        Diagnosis {
            report,
            calibration,
            curves,
            experiment: experiment.flatten(),
        }
    }

    /// The explanations that were compared, the most probable first.
    fn explained(&self) -> Vec<ExplanationReport> {
        let living = self.explanations.living.iter().take(MOST_LISTED);
        living
            .map(|own| ExplanationReport {
                names: own
                    .terms
                    .iter()
                    .map(|t| self.problem.name(t.cause))
                    .collect(),
                probability: own.weight,
                leaves: own.leaves,
            })
            .collect()
    }

    /// For each effect the rivals in its place, and the twin that no recording of this plant can
    /// distinguish.
    fn rivals(&self) -> Vec<Vec<Cause>> {
        let Selection { nominal, found, .. } = self.selection;
        let taken = |cause: &Cause| refs(nominal, found).iter().any(|t| t.cause == *cause);
        let of = |own: Cause| {
            let mut instead = self.explanations.instead_of(own);
            let twin = self.problem.run.twin(own);
            let twin = twin.filter(|twin| !taken(twin) && !instead.contains(twin));
            instead.extend(twin);
            instead
        };
        found.iter().map(|own| of(own.term.cause)).collect()
    }

    pub(crate) fn floor(&self) -> Floor {
        let floor = floor(self.problem, self.selection);
        if self.trials.is_none() {
            return floor;
        }
        // Gains that differ between trials are projected out, which explains nothing. The floor is
        // computed with them.
        let rms = |of| usable_rms(self.problem, &self.left_over(of));
        let (before, after) = (rms(false), rms(true));
        Floor {
            measured_before: before,
            measured_after: after,
            ratio_before: before / floor.predicted,
            ratio_after: after / floor.predicted,
            ..floor
        }
    }

    /// The residual of the nominal or the extended model, including the gains of the trials.
    fn left_over(&self, with_found: bool) -> Vec<f64> {
        let Selection {
            nominal,
            found,
            before,
            after,
            ..
        } = self.selection;
        if with_found {
            left_over(self.problem, &refs(nominal, found), after)
        } else {
            left_over(self.problem, &refs(nominal, &[]), before)
        }
    }

    /// The shape of the residual: a scatter of the trials, or a curve.
    fn unknown(&self) -> Option<Unknown> {
        let usable = &self.problem.windows.usable;
        let scatter = |trials: &Trials| trials.scatter(&self.left_over(true), usable, 0.0);
        if let Some(scatter) = self.trials.and_then(scatter) {
            return Some(scatter.described());
        }
        let residual = &self.selection.after.residual;
        unknown(self.problem, residual)
    }

    /// A cause that alignment measured and mended: nothing else competes with it.
    fn mended(&self, effect: &Effect) -> Option<EffectReport> {
        let entry = entry(effect.mechanism())?;
        let run = self.problem.run;
        let values = effect.parameters.iter().copied().map(Value::unknown);
        let stated = RigEffect {
            mechanism: effect.mechanism(),
            values: values.collect(),
            onset: None,
            of_torque: false,
        };
        Some(EffectReport {
            mechanism: effect.mechanism().name(),
            joint: self.problem.run.place_name(effect.cause.at),
            parameters: numbers(&stated, (run.motion_kind(), run.driven_by())),
            onset_s: None,
            onset_low95_s: None,
            onset_high95_s: None,
            z: 0.0,
            inclusion: 1.0,
            share_explained: 0.0,
            probability: 1.0,
            status: status(1.0),
            equation: entry.equation,
            refuted_by: entry.refuted_by,
        })
    }

    /// The named effects. `fitted` holds their parameters.
    fn effects(&self, fitted: &[RigEffect]) -> Vec<EffectReport> {
        let (problem, selection) = (self.problem, self.selection);
        let units = (problem.run.motion_kind(), problem.run.driven_by());
        let found = selection.found.iter().zip(fitted).enumerate();
        found
            .filter_map(|(index, (found, fitted))| {
                let cause = found.term.cause;
                let entry = entry(cause.mechanism)?;
                Some(EffectReport {
                    mechanism: cause.mechanism.name(),
                    joint: problem.run.place_name(cause.at),
                    parameters: numbers(fitted, units),
                    onset_s: found.term.onset_s,
                    onset_low95_s: fitted.onset.and_then(|onset| onset.low95),
                    onset_high95_s: fitted.onset.and_then(|onset| onset.high95),
                    z: found.z,
                    inclusion: inclusion(problem, selection, index),
                    share_explained: found.share,
                    probability: found.probability,
                    status: status(found.probability),
                    equation: entry.equation,
                    refuted_by: entry.refuted_by,
                })
            })
            .collect()
    }
}
