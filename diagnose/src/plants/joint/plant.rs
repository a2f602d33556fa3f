//! This file makes an axis or a bench a `Plant`.

use super::fitted::wider;
use super::inverse::{self, CUTOFF_HZ, DECIMATION, FILTER_ORDER};
use super::mistaken::{
    another_drive, another_inertia, beyond_reason, impossible_numbers, inertia_as_stated,
    without_brake,
};
use super::run::{JointRun, PlantKind};
use super::simulate::output;
use super::write_rig::{calibrated, found_in, nominal_numbers};
use super::{experiment, from_rig, replica, undone};
use crate::align::Fault;
use crate::cause::Cause;
use crate::continuity::Remark;
use crate::diagnose::write::Stand;
use crate::effect::Effect;
use crate::evidence::Intervals;
use crate::plant::{At, Described, Plant, Replica, Shown, Simulated, SimulatedOutput, Unsimulated};
use crate::plants::joined::joined;
use crate::problem::Problem;
use crate::report::{FitReport, InverseReport, NextExperiment, Number};
use crate::selection::Selection;
use crate::sensor::sensed;
use rand_pcg::Pcg64Mcg;
use rigproof_spec::effect::{Mechanism, Quantity};
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::{Recording, Rig, RigEffect, Value, motion_name};
use rigproof_trace::{Trace, TraceError};
use std::collections::BTreeMap;
use std::path::Path;

impl Plant for Rig {
    type Recording = Recording;
    type Run = JointRun;

    fn plant_name(&self) -> &'static str {
        self.plant.name()
    }

    fn aligned(&self, recording: &Recording, before_s: f64) -> Result<JointRun, Fault> {
        undone::aligned(self, recording, before_s)
    }

    fn joined(runs: Vec<JointRun>) -> Result<JointRun, (usize, Fault)> {
        joined(runs)
    }

    fn part(run: &JointRun, from: usize, to: usize) -> JointRun {
        run.part(from, to)
    }

    fn nominal(&self) -> Vec<Effect> {
        undone::left(self)
    }

    fn check(&self, run: &JointRun, _: &Problem) -> Result<(), (At, Fault)> {
        let not_so = undone::not_computed(self).or_else(|| undone::not_told(self));
        let fault = not_so.map(undone::of_description);
        let fault = fault.or_else(|| without_brake(self, run));
        fault.map_or(Ok(()), |fault| Err(("description", fault)))
    }

    fn stated(
        &self,
        run: &JointRun,
        problem: &Problem,
        selection: &Selection,
    ) -> Option<(Rig, Remark)> {
        let (inertia, remark) = inertia_as_stated(run, problem, selection)?;
        let mut own = self.clone();
        own.parameters.as_mut()?.inertia = Value::known(inertia);
        Some((own, remark))
    }

    fn check_found(&self, problem: &Problem, selection: &Selection) -> Result<(), Fault> {
        another_drive(problem, selection).map_or(Ok(()), Err)
    }

    fn check_numbers(
        &self,
        run: &JointRun,
        problem: &Problem,
        selection: &Selection,
    ) -> Result<(), Fault> {
        let fault = another_inertia(run, problem, selection);
        let fault = fault.or_else(|| impossible_numbers(run, problem, selection));
        fault.map_or(Ok(()), Err)
    }

    fn beyond_reason(&self, problem: &Problem, selection: &Selection) -> Option<Cause> {
        beyond_reason(problem, selection)
    }

    fn meaningless(&self, problem: &Problem, effect: &Effect) -> Option<Fault> {
        Some(undone::of_description(format!(
            "`{}` cannot stand in the nominal model of this {}; take it out",
            problem.name(effect.cause),
            self.plant.name()
        )))
    }

    fn calibrated(stand: &Stand<'_, Rig>, intervals: &Intervals) -> Rig {
        calibrated(stand.plant, &stand.model(true), intervals, false)
    }

    fn found(&self, stand: &Stand<'_, Rig>, _: &Intervals) -> Vec<RigEffect> {
        found_in(&self.effects, stand.plant.effects.len(), stand.selection)
    }

    /// Refits the parameters by free runs: of an axis under the recorded command, of a bench along
    /// the recorded motion.
    fn shown(stand: &Stand<'_, Rig>, intervals: &Intervals) -> Shown<Rig> {
        let protocol = from_rig::protocol(stand.plant);
        let fitted = stand.fit(&protocol);
        let (before, after) = match &fitted {
            Some(f) => (f.nominal.plant.clone(), f.found.plant.clone()),
            None => (stand.model(false), stand.model(true)),
        };
        // A bench with a brake keeps the parameters of the weak form.
        let is_refitted = fitted.as_ref().is_some_and(|fitted| fitted.is_refitted);
        let refitted = is_refitted && stand.train.brake().is_none();
        let fit = fitted.as_ref();
        let wider = fit
            .filter(|_| refitted)
            .map(|fitted| wider(intervals, fitted));
        let intervals = wider.as_ref().unwrap_or(intervals);
        Shown {
            calibration: calibrated(stand.plant, &after, intervals, refitted),
            fit: fit.map(|fitted| stand.fit_report(fitted, intervals, &protocol)),
            curves: stand.free_run_curves(&before, &after, &protocol),
        }
    }

    fn protocol(stand: &Stand<'_, Rig>, _: Option<&FitReport>) -> Vec<String> {
        stand.protocol_lines(&from_rig::protocol(stand.plant))
    }

    fn nominal_numbers(&self, calibration: &Rig) -> BTreeMap<String, Number> {
        nominal_numbers(self, calibration)
    }

    fn next_experiment(
        stand: &Stand<'_, Rig>,
        rivals: &[Vec<Cause>],
    ) -> Option<(NextExperiment, Option<Trace>)> {
        experiment::next(stand, rivals)
    }

    fn inverse_model(run: &JointRun, laws: &[(Mechanism, Vec<f64>)]) -> Option<InverseReport> {
        let model = inverse::inverse_model(run, laws)?;
        Some(InverseReport {
            protocol: inverse::protocol(),
            filter_order: FILTER_ORDER,
            cutoff_hz: CUTOFF_HZ,
            decimation: DECIMATION,
            nominal_error_percent: model.error_percent,
        })
    }
}

impl Described for Rig {
    /// Every text that no other plant describes.
    fn describes(_: &str, _: &Path) -> Result<bool, TraceError> {
        Ok(true)
    }

    fn read(text: &str, origin: &Path) -> Result<Rig, TraceError> {
        Rig::parse(text, origin)
    }

    fn rig_name(&self) -> &str {
        &self.name
    }

    fn written(&self) -> String {
        self.to_toml()
    }

    fn measured(&self, trace: Trace, origin: &Path) -> Result<Recording, TraceError> {
        self.taken(trace, origin)
    }

    fn in_units(&self, units: &[(String, String)]) -> Result<Rig, String> {
        self.with_column_units(units)
    }

    fn read_csv(
        &self,
        file: &Path,
        hints: &Hints,
    ) -> Result<(Recording, Dialect, Vec<String>), TraceError> {
        self.read_text(file, hints)
    }

    fn read_messages(&self, file: &Path) -> Result<(Recording, Vec<String>), TraceError> {
        self.read_mcap(file)
    }

    fn times_s(recording: &Recording) -> &[f64] {
        &recording.time_s
    }

    fn only(recording: &Recording, kept: &[bool]) -> Recording {
        recording.only(kept)
    }

    fn replica(&self, model: &Rig, recording: &Recording) -> Result<Replica<Recording>, String> {
        replica::replica(self, model, recording)
    }

    fn sensed(
        recording: &Recording,
        [position, effort]: [f64; 2],
        random: &mut Pcg64Mcg,
    ) -> Recording {
        let mut out = recording.clone();
        out.position = sensed(&out.position, position, random);
        // The current of a bench is a command and has no sensor noise.
        if let Some(signal) = out.force.as_mut().or(out.drive.as_mut()) {
            *signal = sensed(signal, effort, random);
        }
        out
    }

    fn simulated(
        &self,
        model: &Rig,
        recording: &Recording,
        _: f64,
    ) -> Result<Simulated, Unsimulated> {
        if let Some(reason) = undone::not_computed(model) {
            return Err(Unsimulated::Model(reason));
        }
        let run = from_rig::aligned(model, recording).map_err(Unsimulated::Recording)?;
        let protocol = from_rig::protocol(model);
        let (name, recorded, quantity, start) = match run.plant {
            // The samples that gave the start state are not compared.
            PlantKind::Axis if protocol.warm_up_periods == 0 => (
                "position",
                &run.position,
                Quantity::Travel,
                protocol.start_samples,
            ),
            PlantKind::Axis => ("position", &run.position, Quantity::Travel, 0),
            PlantKind::Bench => ("effort", &run.effort, Quantity::Effort, 0),
        };
        let was = run.recorded.iter().enumerate();
        let output = SimulatedOutput {
            name,
            unit: quantity.dimension(model.motion).to_string(),
            recorded: Some(recorded.clone()),
            simulated: output(&from_rig::plant(model), &run, &protocol),
            counts: was.map(|(k, was)| *was && k >= start).collect(),
        };
        let times = 0..run.len();
        Ok(Simulated {
            time_s: times.map(|k| run.start_s + k as f64 * run.step_s).collect(),
            outputs: vec![output],
            runs: None,
        })
    }

    fn refuses(&self, calibration: Option<&Rig>) -> Option<String> {
        let of = |rig: &Rig| format!("{} {}", motion_name(rig.motion), rig.plant.name());
        let other = match calibration {
            Some(other) if (other.plant, other.motion) == (self.plant, self.motion) => return None,
            Some(other) => format!("a {}", of(other)),
            None => "another plant".to_owned(),
        };
        Some(format!(
            "the calibration is of {other}, the rig is a {}; give the calibration of this rig",
            of(self)
        ))
    }

    fn without_found(&self, calibration: &Rig) -> Rig {
        let mut out = calibration.clone();
        out.effects.truncate(self.effects.len());
        out
    }
}
