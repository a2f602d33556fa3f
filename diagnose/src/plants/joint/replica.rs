//! This file simulates a recording of a plant of one joint: an axis freely under the recorded
//! command, a bench along the recorded motion.

use super::undone::not_computed;
use crate::plant::Replica;
use crate::plants::joint::from_rig::{aligned, plant, protocol};
use crate::plants::joint::run::PlantKind;
use crate::plants::joint::simulate::output;
use rigproof_trace::rig::{Recording, Rig, Signal};

/// The recording that a plant with the parameters of `model` would have made. `nominal` describes
/// the recording.
///
/// # Errors
/// The recording is faulty.
pub(crate) fn replica(
    nominal: &Rig,
    model: &Rig,
    recording: &Recording,
) -> Result<Replica<Recording>, String> {
    if let Some(reason) = not_computed(model) {
        return Err(reason);
    }
    let run = aligned(nominal, recording).map_err(|fault| fault.reason)?;
    let out = output(&plant(model), &run, &protocol(model));
    let mut own = recording.clone();
    let times = 0..run.len();
    own.time_s = times.map(|k| run.start_s + k as f64 * run.step_s).collect();
    let mut effort_noise = run.effort_noise;
    match run.plant {
        PlantKind::Axis => {
            own.position.samples = out;
            let gain = nominal.parameters.map_or(1.0, |p| p.command_gain.value);
            effort_noise /= gain.abs();
            match &run.servo {
                Some(servo) => set(&mut own.drive, servo.goal().iter().copied()),
                None => set(&mut own.drive, run.effort.iter().map(|e| e / gain)),
            }
        }
        PlantKind::Bench => {
            own.position.samples = run.motion.iter().map(|now| now.position).collect();
            set(&mut own.force, out.into_iter());
            set(&mut own.drive, run.current.into_iter().flatten());
            if run.law.is_none() {
                set(&mut own.simulated, run.predicted.into_iter().flatten());
            }
        }
    }
    Ok(Replica {
        how: match own.force {
            Some(_) => "the calibrated plant along the recorded motion",
            None => "a free run of the calibrated plant under the recorded command",
        },
        recording: own,
        noise: [run.position_noise, effort_noise],
    })
}

fn set(signal: &mut Option<Signal>, samples: impl Iterator<Item = f64>) {
    if let Some(signal) = signal {
        signal.samples = samples.collect();
    }
}
