//! This file makes an arm a `Plant`.

use super::align::{aligned, arm};
use super::beside::beside;
use super::by_joint::by_joint;
use super::parts::place_names;
use super::run::ChainRun;
use super::simulated::simulated;
use crate::align::Fault;
use crate::cause::{Cause, JointId, Place};
use crate::diagnose::numbers::fitted;
use crate::diagnose::write::Stand;
use crate::effect::Effect;
use crate::evidence::Intervals;
use crate::plant::{Described, Plant, Simulated, Unsimulated};
use crate::plants::joined::joined;
use crate::report::ArmReport;
use crate::sensor::sensed;
use rand_pcg::Pcg64Mcg;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::Status;
use rigproof_trace::rig::chain::{AtJoint, ChainRecording, ChainRig};
use rigproof_trace::{Trace, TraceError};
use std::path::Path;

impl Plant for ChainRig {
    type Recording = ChainRecording;
    type Run = ChainRun;

    fn plant_name(&self) -> &'static str {
        "chain"
    }

    fn aligned(&self, recording: &ChainRecording, _: f64) -> Result<ChainRun, Fault> {
        aligned(self, recording)
    }

    fn joined(runs: Vec<ChainRun>) -> Result<ChainRun, (usize, Fault)> {
        joined(runs)
    }

    fn part(run: &ChainRun, from: usize, to: usize) -> ChainRun {
        run.part(from, to)
    }

    /// The effects in the description besides the model. Joints are numbered in the arm's order, not
    /// the file's.
    fn nominal(&self) -> Vec<Effect> {
        let names = arm(self).map_or_else(|_| Vec::new(), |chain| place_names(self, &chain));
        let each = self.effects.iter().filter_map(|own| {
            let joint = names.iter().position(|name| *name == own.joint)?;
            let values = &own.effect.values;
            Some(Effect {
                cause: Cause::at(own.effect.mechanism, Place::Joint(JointId(joint))),
                parameters: values.iter().map(|value| value.value).collect(),
                unknown: values.iter().any(|value| value.status == Status::Unknown),
                onset_s: own.effect.onset.map(|onset| onset.value),
            })
        });
        each.collect()
    }

    fn calibrated(stand: &Stand<'_, ChainRig>, intervals: &Intervals) -> ChainRig {
        let mut rig = stand.plant.clone();
        let all = fitted(stand.problem, stand.selection, intervals).into_iter();
        let nominal = stand.selection.nominal.len();
        let found = all.skip(nominal).zip(&stand.selection.found);
        rig.effects.extend(found.filter_map(|(effect, found)| {
            let joint = stand.problem.run.place_name(found.term.cause.at)?;
            Some(AtJoint {
                joint: joint.to_owned(),
                effect,
            })
        }));
        rig
    }

    fn arm(stand: &Stand<'_, ChainRig>) -> Option<ArmReport> {
        by_joint(stand)
    }
}

impl Described for ChainRig {
    fn describes(text: &str, origin: &Path) -> Result<bool, TraceError> {
        ChainRig::describes(text, origin)
    }

    fn read(text: &str, origin: &Path) -> Result<ChainRig, TraceError> {
        let rig = ChainRig::parse(text, origin)?;
        arm(&rig).map_err(|reason| TraceError::recording(origin, reason))?;
        Ok(rig)
    }

    fn rig_name(&self) -> &str {
        &self.name
    }

    fn written(&self) -> String {
        self.to_toml()
    }

    fn beside(&self) -> Vec<(&'static str, String)> {
        beside(self)
    }

    fn measured(&self, trace: Trace, origin: &Path) -> Result<ChainRecording, TraceError> {
        self.taken(trace, origin)
    }

    fn in_units(&self, units: &[(String, String)]) -> Result<ChainRig, String> {
        self.with_column_units(units)
    }

    fn read_csv(
        &self,
        file: &Path,
        hints: &Hints,
    ) -> Result<(ChainRecording, Dialect, Vec<String>), TraceError> {
        self.read_text(file, hints)
    }

    fn read_messages(&self, file: &Path) -> Result<(ChainRecording, Vec<String>), TraceError> {
        self.read_mcap(file)
    }

    fn times_s(recording: &ChainRecording) -> &[f64] {
        &recording.time_s
    }

    fn only(recording: &ChainRecording, kept: &[bool]) -> ChainRecording {
        recording.only(kept)
    }

    fn sensed(
        recording: &ChainRecording,
        [position, effort]: [f64; 2],
        random: &mut Pcg64Mcg,
    ) -> ChainRecording {
        let mut out = recording.clone();
        for signal in &mut out.position {
            *signal = sensed(signal, position, random);
        }
        for signal in out.motor.iter_mut().flatten() {
            *signal = sensed(signal, position, random);
        }
        let torques = out.torque.iter_mut().flatten();
        for signal in out.effort.iter_mut().chain(torques) {
            *signal = sensed(signal, effort, random);
        }
        out
    }

    fn simulated(
        &self,
        model: &ChainRig,
        recording: &ChainRecording,
        _: f64,
    ) -> Result<Simulated, Unsimulated> {
        simulated(model, recording)
    }

    fn without_found(&self, calibration: &ChainRig) -> ChainRig {
        let mut out = calibration.clone();
        out.effects.truncate(self.effects.len());
        out
    }
}
