//! This file writes the report of a recording from which something could be concluded.

use super::ended::blank;
use super::words::summary;
use super::{Curves, Description, Diagnosis, FittedCurves, Options};
use crate::evidence::{Rivals, inclusion, intervals, not_seen, null_directions, rivals};
use crate::from_rig;
use crate::locate::locate;
use crate::problem::{Cause, Problem};
use crate::report::{EffectReport, Floor, Report, Unknown, Verdict};
use crate::run::{PlantKind, Run};
use crate::scatter::{Trials, left_over};
use crate::select::{Selection, floor_limit, refs, usable_rms};
use crate::simulate::{Plant, Protocol, output};
use crate::unknown::unknown;
use crate::write_rig::{calibrated, nominal_numbers, numbers};
use rigproof_model::effects::{entry, facts};
use rigproof_spec::effect::{Motion, Quantity};
use rigproof_trace::rig::Rig;

/// The residual of the windows against what sensor noise predicts.
pub(crate) fn floor(problem: &Problem, selection: &Selection, motion: Motion) -> Floor {
    let predicted = problem.floor;
    let before = usable_rms(problem, &selection.before.residual);
    let after = usable_rms(problem, &selection.after.residual);
    Floor {
        predicted,
        measured_before: before,
        measured_after: after,
        ratio_before: before / predicted,
        ratio_after: after / predicted,
        unit: Quantity::Effort.dimension(motion).to_string(),
    }
}

/// What a selection comes to.
pub(crate) fn verdict(
    selection: &Selection,
    floor: &Floor,
    limit: f64,
    rivals: &[Vec<String>],
) -> Verdict {
    let explained = floor.ratio_after <= limit;
    match (selection.found.is_empty(), explained) {
        (true, true) => Verdict::Consistent,
        (true, false) => Verdict::NoneOfLibrary,
        (false, false) => Verdict::PartlyExplained,
        (false, true) if rivals.iter().any(|r| !r.is_empty()) => Verdict::Ambiguous,
        (false, true) => Verdict::Explained,
    }
}

/// Everything the report is written from.
pub(super) struct Stand<'a> {
    pub(super) rig: &'a Rig,
    pub(super) problem: &'a Problem<'a>,
    pub(super) selection: &'a Selection,
    pub(super) withdrawn: &'a [Cause],
    pub(super) train: &'a Run,
    pub(super) test: &'a Run,
    pub(super) options: &'a Options,
    pub(super) width_s: f64,
    /// Trials of a brake whose gains differ; `problem` is told within them.
    pub(super) trials: Option<&'a Trials>,
}

impl Stand<'_> {
    /// The diagnosis; `other_recording` says whether the held-out part is a recording of its own.
    pub(super) fn report(&self, other_recording: bool) -> Diagnosis {
        let protocol = from_rig::protocol(self.rig);
        let fitted = self.fit(&protocol);
        let rivals: Vec<Vec<String>> = self.rivals().iter().map(Rivals::names).collect();
        let floor = self.floor();
        let verdict = verdict(self.selection, &floor, floor_limit(self.problem), &rivals);
        let unknown = if floor.ratio_after > floor_limit(self.problem) {
            self.unknown()
        } else {
            None
        };
        let fit = fitted
            .as_ref()
            .map(|f| self.fit_report(f, &protocol, other_recording));
        let plants = match &fitted {
            Some(f) => (f.nominal.plant.clone(), f.found.plant.clone()),
            None => (self.plant(false), self.plant(true)),
        };
        let intervals = intervals(self.problem, self.selection);
        // A bench with a brake keeps the numbers of its windows.
        let refitted = fitted.is_some() && self.train.brake().is_none();
        let calibration = calibrated(self.rig, &plants.1, &intervals, refitted);
        let summary = summary(verdict, self.selection, fit.as_ref(), &rivals);
        let report = Report {
            protocol: self.protocol_lines(&protocol, other_recording),
            floor: Some(floor),
            located: locate(
                self.problem,
                self.train,
                &self.selection.before.residual,
                &self.selection.after.residual,
            ),
            stages: self.stages(),
            effects: self.effects(&calibration),
            ambiguous_with: rivals,
            too_small_to_name: self
                .selection
                .too_small
                .iter()
                .map(|cause| cause.name())
                .collect(),
            withdrawn: self.withdrawn.iter().map(|cause| cause.name()).collect(),
            nominal: nominal_numbers(self.rig, &calibration),
            inverse_model: self.inverse_model(),
            not_seen: not_seen(
                self.problem,
                self.selection,
                self.options.gates,
                self.rig.motion,
            ),
            null_directions: null_directions(self.problem, self.selection),
            unknown,
            fit,
            ..blank(self.rig.plant.name(), verdict, summary)
        };
        let curves = self.curves(&plants.0, &plants.1, &protocol);
        Diagnosis {
            report,
            calibration: Description::Joint(calibration),
            curves,
            experiment: None,
        }
    }

    /// For each effect, what explains as much in its place: measured rivals, and the twin that no recording of this
    /// plant can tell: a constant that changes no sign with the motion is a bias or a direction asymmetry.
    fn rivals(&self) -> Vec<Rivals> {
        let mut all = rivals(self.problem, self.selection);
        for (rivals, found) in all.iter_mut().zip(&self.selection.found) {
            let Some(twin) = facts(found.term.cause.mechanism).and_then(|facts| facts.twin) else {
                continue;
            };
            let twin = Cause::of(twin);
            let taken = refs(&self.selection.nominal, &self.selection.found)
                .iter()
                .any(|t| t.cause == twin);
            if !taken && !rivals.instead.contains(&twin) {
                rivals.instead.push(twin);
            }
        }
        all
    }

    pub(super) fn floor(&self) -> Floor {
        let floor = floor(self.problem, self.selection, self.rig.motion);
        if self.trials.is_none() {
            return floor;
        }
        // What differs from trial to trial is not explained by being taken out.
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

    /// What the nominal model, or the one with the names, leaves over with the gains of the trials still in it.
    fn left_over(&self, with_found: bool) -> Vec<f64> {
        let Selection {
            nominal,
            found,
            before,
            after,
            ..
        } = self.selection;
        if with_found {
            left_over(self.problem, self.train, &refs(nominal, found), after)
        } else {
            left_over(self.problem, self.train, &refs(nominal, &[]), before)
        }
    }

    /// The shape of what is left: a scatter of the trials, or a curve.
    fn unknown(&self) -> Option<Unknown> {
        let usable = &self.problem.windows.usable;
        let scatter = |trials: &Trials| trials.scatter(&self.left_over(true), usable, 0.0);
        if let Some(scatter) = self.trials.and_then(scatter) {
            return Some(scatter.described());
        }
        let residual = &self.selection.after.residual;
        unknown(self.problem, self.train, residual, self.rig.motion)
    }

    fn effects(&self, calibration: &Rig) -> Vec<EffectReport> {
        let offset = self.selection.nominal.len();
        self.selection
            .found
            .iter()
            .enumerate()
            .filter_map(|(index, found)| {
                let entry = entry(found.term.cause.mechanism)?;
                let fitted = calibration.effects.get(offset + index)?;
                Some(EffectReport {
                    mechanism: found.term.cause.mechanism.name(),
                    joint: None,
                    parameters: numbers(fitted, self.rig.motion),
                    onset_s: found.term.onset_s,
                    onset_low95_s: fitted.onset.and_then(|onset| onset.low95),
                    onset_high95_s: fitted.onset.and_then(|onset| onset.high95),
                    z: found.z,
                    inclusion: inclusion(self.problem, self.selection, index, self.options.gates),
                    share_explained: found.share,
                    equation: entry.equation,
                    refuted_by: entry.refuted_by,
                    limit_of: Vec::new(),
                })
            })
            .collect()
    }

    fn curves(&self, before: &Plant, after: &Plant, protocol: &Protocol) -> Curves {
        let run = self.test;
        let times = |run: &Run| -> Vec<f64> {
            let all = 0..run.len();
            all.map(|k| run.start_s + k as f64 * run.step_s).collect()
        };
        let recorded = |run: &Run| match run.plant {
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
            floor: self.problem.floor,
            residual_unit: Quantity::Effort.dimension(self.rig.motion).to_string(),
        }
    }

    pub(super) fn output_unit(&self) -> String {
        let quantity = match self.train.plant {
            PlantKind::Axis => Quantity::Travel,
            PlantKind::Bench => Quantity::Effort,
        };
        quantity.dimension(self.rig.motion).to_string()
    }
}
