//! This file builds the equations of a plant from its rig description and a recording.

use super::align::{Signals, align};
use super::inertia::Inertia;
use super::servo::Servoed;
use super::sweep;
use crate::align::{Fault, forget_sense_near_reversals};
use crate::cause::Cause;
use crate::effect::Effect;
use crate::plant::Clock;
use crate::plants::joint::run::{JointBrake, JointRun, PlantKind};
use crate::plants::joint::simulate::{Interpolation, Model, Protocol};
use crate::rules::STILL_NOISES;
use rigproof_model::brake::Characteristic;
use rigproof_trace::rig::{Drive, Plant as RigPlant, Recording, Rig, Signal, Status, Value};

/// Aligns a recording as its sensors show it.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub fn aligned(rig: &Rig, recording: &Recording) -> Result<JointRun, Fault> {
    bare(rig, recording, |position, _| position.to_vec())
}

/// Aligns a recording with corrected positions: `behind` gives them from the shown ones.
pub(super) fn bare(
    rig: &Rig,
    recording: &Recording,
    behind: impl Fn(&[f64], Clock) -> Vec<f64>,
) -> Result<JointRun, Fault> {
    let gain = rig.parameters.map_or(1.0, |p| p.command_gain.value);
    let signals = signals(rig, recording, gain, behind);
    let mut run = match rig.is_sweep() {
        true => sweep::align(&signals, recording)?,
        false => align(&signals)?,
    };
    run.servo = Servoed::of(recording, gain, &run);
    if let Some(servo) = &run.servo {
        run.effort = servo.along(&run);
    }
    run.inertia = inertia(rig);
    run.described = nominal(rig);
    run.law = brake(rig);
    if let (Some(_), Some(current)) = (&run.law, &run.current) {
        // This comes before the directions near reversals are discarded, since a lag follows the
        // yield torque through a reversal.
        run.predicted = run.braked(current);
        let still = STILL_NOISES * run.position_noise;
        if !run.is_sweep() {
            forget_sense_near_reversals(&mut run.motion, &run.position, still);
        }
    }
    Ok(run)
}

/// The channels of a recording as efforts and motion. `gain` is the effort per unit of command.
fn signals(
    rig: &Rig,
    recording: &Recording,
    gain: f64,
    behind: impl Fn(&[f64], Clock) -> Vec<f64>,
) -> Signals {
    let axis = recording.plant == RigPlant::Axis;
    let drive = recording.drive.as_ref();
    let effort = if axis {
        drive
    } else {
        recording.force.as_ref()
    };
    // A servo computes its effort from the noisy position, so the effort takes on noise too.
    let scale = match (&recording.servo, axis) {
        (Some(servo), _) => gain * servo.gain,
        (None, true) => gain,
        (None, false) => 1.0,
    };
    let scaled = |x: Option<f64>| x.map(|x| x * scale.abs());
    let given = |e: &Signal| -> Vec<f64> {
        let Some(servo) = recording.servo else {
            return e.samples.iter().map(|x| x * scale).collect();
        };
        let pairs = e.samples.iter().zip(&recording.position.samples);
        pairs
            .map(|(goal, at)| gain * servo.voltage(goal - at))
            .collect()
    };
    let noisy = match recording.servo {
        Some(_) => Some(sample_noise(&recording.position)),
        None => effort
            .filter(|e| e.noise.is_some() || e.quantum.is_some())
            .map(sample_noise),
    };
    Signals {
        plant: if axis {
            PlantKind::Axis
        } else {
            PlantKind::Bench
        },
        kind: recording.motion,
        time_s: recording.time_s.clone(),
        position: behind(&recording.position.samples, stamps(&recording.time_s)),
        effort: effort.map_or_else(Vec::new, given),
        goal: recording.servo.and(drive).map(|d| d.samples.clone()),
        predicted: recording.simulated.as_ref().map(|s| s.samples.clone()),
        current: drive.filter(|_| !axis).map(|d| d.samples.clone()),
        held: rig.protocol.drive == Drive::Held,
        position_quantum: recording.position.quantum,
        position_noise: recording.position.noise,
        effort_noise: scaled(noisy),
        effort_limit: match recording.servo {
            Some(servo) => Some(gain.abs() * servo.supply_v),
            None => scaled(effort.and_then(|e| e.limit)),
        },
    }
}

/// The standard deviation of one sample of a channel from noise and rounding, in the channel's own
/// unit.
fn sample_noise(channel: &Signal) -> f64 {
    let rounding = channel.quantum.unwrap_or(0.0) / 12f64.sqrt();
    channel.noise.unwrap_or(0.0).hypot(rounding)
}

/// A clock over time stamps, with the first at 0.
fn stamps(time_s: &[f64]) -> Clock {
    let ends = time_s.first().zip(time_s.last());
    let samples = time_s.len();
    let length_s = ends.map_or(0.0, |(first, last)| last - first);
    Clock {
        step_s: length_s / samples.saturating_sub(1).max(1) as f64,
        start_s: 0.0,
        samples,
    }
}

/// The nominal brake of a bench.
fn brake(rig: &Rig) -> Option<JointBrake> {
    let seconds = |own: &Option<Value>| own.map(|own| own.value);
    let characteristic = rig.characteristic.as_ref().map(|own| {
        let rising_s = seconds(&own.rising).unwrap_or(0.0);
        let law = Characteristic {
            points: own.points.clone(),
            rising_s,
            falling_s: seconds(&own.falling).unwrap_or(rising_s),
        };
        JointBrake::Characteristic(law, rig.driving())
    });
    let table = rig
        .brake
        .as_ref()
        .map(|own| JointBrake::Thesis(own.table()));
    characteristic.or(table)
}

pub(crate) fn inertia(rig: &Rig) -> Inertia {
    match (rig.plant, rig.parameters) {
        (RigPlant::Axis, Some(parameters)) => match parameters.inertia.status {
            Status::Known => Inertia::Known(parameters.inertia.value),
            _ => Inertia::Unknown(parameters.inertia.value),
        },
        _ => Inertia::None,
    }
}

/// The effects of the nominal model.
pub(crate) fn nominal(rig: &Rig) -> Vec<Effect> {
    rig.effects
        .iter()
        .map(|effect| Effect {
            cause: match effect.of_torque {
                true => Cause::of(effect.mechanism).of_torque(),
                false => Cause::of(effect.mechanism),
            },
            parameters: effect.values.iter().map(|v| v.value).collect(),
            unknown: effect.values.iter().any(|v| v.status != Status::Known),
            onset_s: effect.onset.map(|v| v.value),
        })
        .collect()
}

/// The plant with all parameters as stated.
pub fn plant(rig: &Rig) -> Model {
    Model {
        inertia: rig.parameters.map_or(0.0, |p| p.inertia.value),
        described: rig.effects.len(),
        effects: nominal(rig),
    }
}

/// The protocol of free runs as stated.
pub fn protocol(rig: &Rig) -> Protocol {
    Protocol {
        interpolation: match rig.protocol.drive {
            Drive::Held => Interpolation::Hold,
            Drive::Straight | Drive::Static => Interpolation::Linear,
            Drive::Periodic => Interpolation::Band,
        },
        start_samples: rig.protocol.start_samples,
        substeps: rig.protocol.substeps,
        warm_up_periods: rig.protocol.warm_up_periods,
    }
}
