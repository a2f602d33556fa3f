//! This file reads settled torques and time constants off the steps of a recording.

use crate::rules::{
    LEAST_STEP_A, LINE_SHARE, LONGEST_EDGE_S, SETTLED_SHARE, SETTLING, SPEED_SHARE,
};
use rigproof_model::brake::identify::{TRANSIENT, fit_step};
use rigproof_spec::tables::{Edge, GAIN_BREAK_A};

use super::Identified;
use super::plateau::Plateau;
use super::sampled::{Part, Sampled, deviation, mean};

/// A settled stretch at constant current and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady {
    /// The index of the recording.
    pub recording: usize,
    /// Current, A.
    pub current_a: f64,
    /// Speed, rad/s.
    pub omega_rad_s: f64,
    /// Mean resistance, N·m.
    pub torque_nm: f64,
}

/// A step of current at constant speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The index of the recording.
    pub recording: usize,
    /// The direction of the edge.
    pub edge: Edge,
    /// The current of the step, A: the target of a rising step, the origin of a falling one.
    pub current_a: f64,
    /// Speed, rad/s.
    pub omega_rad_s: f64,
    /// The time at which the torque starts to change, s.
    pub start_s: f64,
    /// Time constant, s.
    pub time_constant_s: f64,
}

/// One plateau at constant speed.
struct Settled<'a> {
    plateau: &'a Plateau,
    omega_rad_s: f64,
    torque_nm: f64,
    noise_nm: f64,
}

/// Finds the settled torques and the steps of a recording.
pub fn find(sampled: &Sampled, plateaus: &[Plateau], recording: usize, found: &mut Identified) {
    let settled: Vec<Option<Settled>> = plateaus.iter().map(|p| settled(sampled, p)).collect();
    let mut kept = vec![true; settled.len()];
    for (index, pair) in settled.windows(2).enumerate() {
        let [Some(before), Some(after)] = pair else {
            continue;
        };
        match step(sampled, before, after, recording) {
            Ok(Some(step)) => found.steps.push(step),
            Ok(None) => {}
            Err(reason) => {
                // An unsettled plateau gives no torque and ends no step.
                kept.get_mut(index + 1).into_iter().for_each(|k| *k = false);
                found.left_out.push(format!("{}: {reason}", sampled.name));
            }
        }
    }
    for (settled, kept) in settled.iter().zip(&kept) {
        if let (Some(settled), true) = (settled, kept) {
            found.steady.push(Steady {
                recording,
                current_a: settled.plateau.current_a,
                omega_rad_s: settled.omega_rad_s,
                torque_nm: settled.torque_nm,
            });
        }
    }
}

/// The settled torque of a plateau, from its last part; `None` if the speed is not constant or
/// there is none.
fn settled<'a>(sampled: &Sampled, plateau: &'a Plateau) -> Option<Settled<'a>> {
    let samples = &plateau.samples;
    let count = samples.len();
    let whole = sampled.part(samples.clone());
    let omega_rad_s = whole.speed_rad_s();
    let travel_rad = omega_rad_s.abs() * whole.duration_s();
    let away_rad = whole.distance_from_line_rad();
    if away_rad.is_nan() || away_rad > LINE_SHARE * travel_rad {
        return None;
    }
    let last = (count as f64 * SETTLED_SHARE) as usize;
    let end = resistance(&sampled.part(samples.end - last..samples.end), omega_rad_s);
    Some(Settled {
        plateau,
        omega_rad_s,
        torque_nm: mean(&end),
        noise_nm: deviation(&end),
    })
}

fn resistance(part: &Part<'_>, omega_rad_s: f64) -> Vec<f64> {
    let sense = omega_rad_s.signum();
    part.torque_nm.iter().map(|torque| torque * sense).collect()
}

/// The step between two plateaus, if there is one; the reason if it cannot be read.
fn step(
    sampled: &Sampled,
    before: &Settled<'_>,
    after: &Settled<'_>,
    recording: usize,
) -> Result<Option<Step>, String> {
    let (from_a, to_a) = (before.plateau.current_a, after.plateau.current_a);
    let edge = if to_a > from_a {
        Edge::Rising
    } else {
        Edge::Falling
    };
    let current_a = from_a.max(to_a);
    let pause = sampled.part(before.plateau.samples.end..after.plateau.samples.start);
    let same_speed =
        (before.omega_rad_s - after.omega_rad_s).abs() < SPEED_SHARE * after.omega_rad_s.abs();
    let small =
        (to_a - from_a).abs() < LEAST_STEP_A || current_a < GAIN_BREAK_A - LEAST_STEP_A / 2.0;
    if small || !same_speed || pause.duration_s() > LONGEST_EDGE_S {
        return Ok(None);
    }
    let transient = sampled.part(before.plateau.samples.end..after.plateau.samples.end);
    let torque_nm = resistance(&transient, after.omega_rad_s);
    let ends_nm = [before.torque_nm, after.torque_nm];
    let noise_nm = after.noise_nm.max(before.noise_nm);
    let start_s = transient.time_s.first().copied().unwrap_or(0.0);
    let Some(fit) = fit_step(transient.time_s, &torque_nm, ends_nm, noise_nm, TRANSIENT) else {
        return Err(format!(
            "the step from {from_a:.2} to {to_a:.2} A at {start_s:.3} s has no transient that can be read; sample faster or hold the current for longer"
        ));
    };
    let held_s = (1.0 - SETTLED_SHARE) * transient.duration_s();
    if held_s < SETTLING * fit.time_constant_s {
        let least_s = SETTLING * fit.time_constant_s / (1.0 - SETTLED_SHARE);
        return Err(format!(
            "the current after the step at {start_s:.3} s is held for {:.3} s, which is too short for a time constant of {:.4} s; hold it for {least_s:.2} s",
            transient.duration_s(),
            fit.time_constant_s
        ));
    }
    Ok(Some(Step {
        recording,
        edge,
        current_a,
        omega_rad_s: after.omega_rad_s,
        start_s: fit.start_s,
        time_constant_s: fit.time_constant_s,
    }))
}
