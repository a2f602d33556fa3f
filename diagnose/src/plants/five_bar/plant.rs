//! This file makes the five-bar a `Plant`.

use super::experiment;
use super::free_run::{Model, simulated};
use super::from_rig::aligned;
use super::held::held;
use super::mapping;
use super::replay::replayed;
use super::replica::replica;
use super::run::FiveBarRun;
use super::undone::{described, left};
use crate::align::Fault;
use crate::cause::Cause;
use crate::diagnose::numbers::fitted;
use crate::diagnose::write::Stand;
use crate::effect::Effect;
use crate::evidence::Intervals;
use crate::plant::{
    At, Described, Plant, Replayed, Replica, Simulated, SimulatedOutput, Unsimulated,
};
use crate::plants::joined::joined;
use crate::problem::Problem;
use crate::report::{FitReport, HeldReport, Horizon, NextExperiment};
use crate::selection::Selection;
use crate::sensor::sensed;
use rand_pcg::Pcg64Mcg;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::RigEffect;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, layout_name};
use rigproof_trace::{Trace, TraceError};
use std::path::Path;

impl Plant for FiveBar {
    type Recording = FiveBarRecording;
    type Run = FiveBarRun;

    fn plant_name(&self) -> &'static str {
        "rig"
    }

    fn aligned(&self, recording: &FiveBarRecording, before_s: f64) -> Result<FiveBarRun, Fault> {
        described(self, recording, before_s)
    }

    fn joined(runs: Vec<FiveBarRun>) -> Result<FiveBarRun, (usize, Fault)> {
        joined(runs)
    }

    fn part(run: &FiveBarRun, from: usize, to: usize) -> FiveBarRun {
        run.part(from, to)
    }

    /// The held-out part of the same recording keeps its history: brakes, heat and memories start
    /// at the first sample.
    fn parted(mut run: FiveBarRun, cut: usize, before: usize) -> (FiveBarRun, FiveBarRun, f64) {
        let fitted = run.part(0, cut);
        // An onset is a time on the common clock of all recordings.
        run.start_s += before as f64 * run.step_s;
        let from_s = cut as f64 * run.step_s;
        (fitted, run, from_s)
    }

    fn nominal(&self) -> Vec<Effect> {
        left(self)
    }

    /// A description with effects of its own was balanced before. Without them its recording may be
    /// far from balance.
    fn check(&self, run: &FiveBarRun, problem: &Problem) -> Result<(), (At, Fault)> {
        if let Some(reason) = Model::of(self).not_computed(self.layout) {
            let fault = Fault {
                channel: "effect",
                from_s: 0.0,
                to_s: 0.0,
                reason,
            };
            return Err(("description", fault));
        }
        if !self.effects.is_empty() {
            return Ok(());
        }
        mapping::check(run, problem).map_err(|fault| ("recording", fault))
    }

    fn check_found(&self, problem: &Problem, selection: &Selection) -> Result<(), Fault> {
        mapping::check_found(problem, selection)
    }

    fn meaningless(&self, problem: &Problem, effect: &Effect) -> Option<Fault> {
        Some(Fault {
            channel: "effect",
            from_s: 0.0,
            to_s: 0.0,
            reason: format!(
                "`{}` cannot stand in the nominal model of this five-bar; take it out, or give it a joint that has it",
                problem.name(effect.cause)
            ),
        })
    }

    fn calibrated(stand: &Stand<'_, FiveBar>, intervals: &Intervals) -> FiveBar {
        stand.with_numbers(intervals)
    }

    fn found(&self, stand: &Stand<'_, FiveBar>, intervals: &Intervals) -> Vec<RigEffect> {
        let all = fitted(stand.problem, stand.selection, intervals);
        let nominal = stand.selection.nominal.len();
        all.into_iter().skip(nominal).collect()
    }

    fn free_runs(stand: &Stand<'_, FiveBar>, calibration: &FiveBar) -> (Vec<Horizon>, String) {
        stand.free_runs(calibration)
    }

    fn protocol(stand: &Stand<'_, FiveBar>, fit: Option<&FitReport>) -> Vec<String> {
        let mut lines = stand.protocol_lines();
        lines.extend(fit.map(|fit| fit.protocol.clone()));
        lines
    }

    fn held(stand: &Stand<'_, FiveBar>) -> Option<HeldReport> {
        held(stand.problem, stand.train, stand.selection)
    }

    fn next_experiment(
        stand: &Stand<'_, FiveBar>,
        rivals: &[Vec<Cause>],
    ) -> Option<(NextExperiment, Option<Trace>)> {
        experiment::next(stand, rivals)
    }
}

impl Described for FiveBar {
    fn describes(text: &str, origin: &Path) -> Result<bool, TraceError> {
        FiveBar::describes(text, origin)
    }

    fn read(text: &str, origin: &Path) -> Result<FiveBar, TraceError> {
        FiveBar::parse(text, origin)
    }

    fn rig_name(&self) -> &str {
        &self.name
    }

    fn written(&self) -> String {
        self.to_toml()
    }

    fn measured(&self, trace: Trace, origin: &Path) -> Result<FiveBarRecording, TraceError> {
        self.taken(trace, origin)
    }

    fn in_units(&self, units: &[(String, String)]) -> Result<FiveBar, String> {
        self.with_column_units(units)
    }

    fn read_csv(
        &self,
        file: &Path,
        hints: &Hints,
    ) -> Result<(FiveBarRecording, Dialect, Vec<String>), TraceError> {
        self.read_text(file, hints)
    }

    fn read_messages(&self, file: &Path) -> Result<(FiveBarRecording, Vec<String>), TraceError> {
        self.read_mcap(file)
    }

    fn times_s(recording: &FiveBarRecording) -> &[f64] {
        &recording.time_s
    }

    fn only(recording: &FiveBarRecording, kept: &[bool]) -> FiveBarRecording {
        recording.only(kept)
    }

    fn replica(
        &self,
        model: &FiveBar,
        recording: &FiveBarRecording,
    ) -> Result<Replica<FiveBarRecording>, String> {
        replica(self, model, recording)
    }

    fn sensed(
        recording: &FiveBarRecording,
        [angle, force]: [f64; 2],
        random: &mut Pcg64Mcg,
    ) -> FiveBarRecording {
        let mut out = recording.clone();
        for signal in &mut out.theta {
            *signal = sensed(signal, angle, random);
        }
        for signal in &mut out.force {
            *signal = sensed(signal, force, random);
        }
        out
    }

    fn replay(&self, after: &FiveBar, recording: &FiveBarRecording) -> Option<Replayed> {
        replayed(self, after, recording)
    }

    fn simulated(
        &self,
        model: &FiveBar,
        recording: &FiveBarRecording,
        restart_s: f64,
    ) -> Result<Simulated, Unsimulated> {
        if let Some(reason) = Model::of(model).not_computed(model.layout) {
            return Err(Unsimulated::Model(reason));
        }
        let run = aligned(self, recording).map_err(Unsimulated::Recording)?;
        let own = simulated(&Model::of(model), &run, restart_s)
            .map_err(|error| Unsimulated::Model(error.to_string()))?;
        let output = |name, unit: &str, recorded, simulated| SimulatedOutput {
            name,
            unit: unit.to_owned(),
            recorded,
            simulated,
            counts: run.recorded.clone(),
        };
        let ([a, b], [recorded_a, recorded_b]) = (own.theta_rad, own.recorded_rad);
        let times = 0..run.len();
        Ok(Simulated {
            time_s: times.map(|k| run.start_s + k as f64 * run.step_s).collect(),
            outputs: vec![
                output("theta_a", "rad", Some(recorded_a), a),
                output("theta_b", "rad", Some(recorded_b), b),
                output("tip", "m", None, own.tip_off_m),
            ],
            runs: Some([own.runs, own.broken_off]),
        })
    }

    fn refuses(&self, calibration: Option<&FiveBar>) -> Option<String> {
        let is_own = calibration.is_some_and(|other| other.layout == self.layout);
        (!is_own).then(|| {
            format!(
                "the rig is a five-bar, {}, the calibration is of another one; give the calibration of this rig",
                layout_name(self.layout)
            )
        })
    }

    fn without_found(&self, calibration: &FiveBar) -> FiveBar {
        let mut out = calibration.clone();
        out.effects.truncate(self.effects.len());
        out
    }
}
