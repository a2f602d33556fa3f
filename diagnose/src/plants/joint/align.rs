//! This file is stage 0 for a plant of one joint: it resamples a recording, finds its faults and
//! measures its noise.

use super::checks;
use super::inertia::Inertia;
use super::run::{JointRun, PlantKind};
use crate::align::{
    Fault, band_hz, check_clock, check_missing, cutoff_hz, forget_sense_at_rest,
    forget_sense_at_reversals, median_step, quiet_cutoff_hz, regular_count, resample,
    smallest_step, smoothed_motion,
};
use crate::continuity::{Position, Remark, Stamps, mend, settle};
use crate::doubt::Smoothing;
use crate::filter::white_noise;
use crate::plant::Run;
use crate::rules::{MOST_GIVEN, STILL_QUANTA, STILL_SIGMAS};
use rigproof_spec::effect::Motion;

/// The recorded signals of a plant by role, in SI units; NaN where nothing was recorded.
#[derive(Clone, Debug)]
pub struct Signals {
    /// The kind of plant.
    pub plant: PlantKind,
    /// Whether the joint is linear or rotary.
    pub kind: Motion,
    /// Time stamps, s, increasing.
    pub time_s: Vec<f64>,
    /// Position, m or rad.
    pub position: Vec<f64>,
    /// Axis: command times its gain. Bench: metered effort. N or N·m.
    pub effort: Vec<f64>,
    /// Axis with a position servo: its goal. The effort is computed from it and the position.
    pub goal: Option<Vec<f64>>,
    /// Bench: the effort that an external simulation predicts.
    pub predicted: Option<Vec<f64>>,
    /// Bench: the current, A.
    pub current: Option<Vec<f64>>,
    /// Whether the drive holds its value between samples.
    pub held: bool,
    /// Resolution of the position, if stated.
    pub position_quantum: Option<f64>,
    /// Noise of the position, if stated.
    pub position_noise: Option<f64>,
    /// Noise of the effort, if stated.
    pub effort_noise: Option<f64>,
    /// Magnitude at which the effort saturates, if stated.
    pub effort_limit: Option<f64>,
}

/// Aligns a recording.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub fn align(recorded: &Signals) -> Result<JointRun, Fault> {
    let mut signals = recorded.clone();
    let step_s = median_step(&signals.time_s);
    check_clock(&signals.time_s, step_s)?;
    check_missing("position", &signals.time_s, &signals.position)?;
    check_missing("effort", &signals.time_s, &signals.effort)?;
    let (quantum, position_noise) = resolution(&signals);
    let (mended, jitter) = mended(&mut signals, (step_s, quantum))?;
    let position_noise = position_noise.hypot(jitter);
    checks::check(recorded, &signals, step_s)?;
    let count = regular_count(&signals.time_s, step_s);
    let (position, recorded_p) = resample(&signals.time_s, &signals.position, step_s, count);
    let (effort, recorded_e) = resample(&signals.time_s, &signals.effort, step_s, count);
    let optional = |values: &Option<Vec<f64>>| {
        let values = values.as_ref()?;
        Some(resample(&signals.time_s, values, step_s, count).0)
    };
    let predicted = optional(&signals.predicted);
    let current = optional(&signals.current);
    let effort_noise = signals.effort_noise.unwrap_or_else(|| {
        let rounding = smallest_step(&effort) / 12f64.sqrt();
        // What a bench measures is noisy, what drives an axis is not.
        let is_measured = signals.plant == PlantKind::Bench;
        let noise = is_measured.then(|| white_noise(&effort)).flatten();
        noise.map_or(rounding, |noise| noise.max(rounding))
    });
    let band_hz = band_hz(&effort, step_s);
    let most_hz = cutoff_hz(step_s, band_hz);
    let cutoff_hz = quiet_cutoff_hz(&position, step_s, most_hz, position_noise);
    let (mut motion, speed_floor) = smoothed_motion(&position, step_s, cutoff_hz, position_noise);
    let smoothing = Smoothing {
        step_s,
        cutoff_hz,
        noise: position_noise,
        speed_floor,
    };
    let untold_speed = smoothing.untold_speeds(&position, &motion, &vec![1.0; motion.len()]);
    let still = (STILL_QUANTA * quantum).max(STILL_SIGMAS * position_noise);
    forget_sense_at_rest(&mut motion, &position, step_s, still);
    if signals.plant == PlantKind::Axis {
        forget_sense_at_reversals(&mut motion);
    }
    let run = JointRun {
        plant: signals.plant,
        kind: signals.kind,
        inertia: Inertia::None,
        described: Vec::new(),
        step_s,
        start_s: 0.0,
        held: signals.held,
        rows: None,
        position,
        motion,
        effort,
        predicted,
        current,
        law: None,
        position_noise,
        effort_noise,
        recorded: both(recorded_p, recorded_e),
        speed_floor,
        untold_speed,
        metered_by: Vec::new(),
        servo: None,
        parts: Vec::new(),
        remarks: mended,
    };
    check_sign(&run, mean(&run.effort))?;
    Ok(run)
}

/// Whether each sample of both signals was recorded.
fn both(one: Vec<bool>, other: Vec<bool>) -> Vec<bool> {
    let pairs = one.into_iter().zip(other);
    pairs.map(|(one, other)| one && other).collect()
}

/// Repairs jumps of the position and moves samples to the grid of their time stamps. Returns the
/// remarks, and the position noise that jitter adds.
fn mended(
    signals: &mut Signals,
    (step_s, quantum): (f64, f64),
) -> Result<(Vec<Remark>, f64), Fault> {
    let mut position = [Position {
        channel: "position",
        samples: core::mem::take(&mut signals.position),
        stated_quantum: signals.position_quantum,
        quantum,
        noise: signals.position_noise.unwrap_or(0.0),
        is_angle: signals.kind == Motion::Rotary,
        slip: 0.0,
    }];
    let stamps = Stamps {
        time_s: &signals.time_s,
        step_s,
    };
    // An effort that is computed from the position repeats with it, so it is no witness.
    let others = [signals.goal.as_mut().unwrap_or(&mut signals.effort)].into_iter();
    let others = others
        .chain(&mut signals.predicted)
        .chain(&mut signals.current);
    let mut mended = mend(stamps, &mut position, &mut others.collect::<Vec<_>>())?;
    let settled = settle(stamps, &mut position);
    let [position] = position;
    signals.position = position.samples;
    let mut noise = 0.0;
    if let Some(settled) = settled {
        mended.push(settled.said);
        signals.time_s = settled.time_s;
        noise = settled.noise;
    }
    Ok((mended, noise))
}

/// The resolution of the position, and its noise including rounding.
fn resolution(signals: &Signals) -> (f64, f64) {
    let quantum = signals
        .position_quantum
        .unwrap_or_else(|| smallest_step(&signals.position));
    let stated = signals.position_noise.unwrap_or(0.0);
    (quantum, (quantum / 12f64.sqrt()).hypot(stated))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// A passive resistance cannot give out energy on average. If it does, a channel has the wrong sign.
/// `about` is the effort that counts as none: where a sensor may not be tared, the mean.
pub(super) fn check_sign(run: &JointRun, about: f64) -> Result<(), Fault> {
    if run.plant == PlantKind::Axis {
        return Ok(());
    }
    let (mut power, mut size) = (0.0, 0.0);
    for (now, effort) in run.motion.iter().zip(&run.effort) {
        power += now.speed * (effort - about);
        size += (now.speed * (effort - about)).abs();
    }
    if power < -MOST_GIVEN * size {
        return Err(Fault {
            channel: "effort",
            from_s: 0.0,
            to_s: run.clock().duration_s(),
            reason: "the resistance drives the motion: energy comes out of the brake; one of the two channels has the wrong sign (set `sign = -1`)".to_owned(),
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
