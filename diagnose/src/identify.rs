//! This file identifies the table of a brake from recordings on the bench, as §3.4 does: torque
//! gain, time constants, backlash.
//!
//! The computation is in `model`; this file finds the steps and reversals in a recording.

mod backlash;
mod interval;
mod plateau;
mod refusal;
mod sampled;
mod sets;
mod step;

use crate::rules::FAST_SHARE;
use rigproof_model::brake::identify::{average, gain_fit, surface_fit};
use rigproof_spec::tables::Edge;
use rigproof_spec::units::rpm_from_rad_s;
use rigproof_trace::rig::{Brake, Gain, Recording, Surface, Value};

pub use backlash::Reversal;
pub use refusal::IdentifyError;
pub use step::{Steady, Step};

use interval::with_interval;
use sampled::Sampled;
use sets::Sets;

/// What recordings of a brake determine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Identified {
    /// The parts of the table that the recordings determine, with 95 % intervals.
    pub brake: Brake,
    /// The parts that they do not determine, and what to record for each.
    pub missing: Vec<String>,
    /// Every step of current that was found.
    pub steps: Vec<Step>,
    /// Every settled stretch at constant current and speed.
    pub steady: Vec<Steady>,
    /// Every reversal at constant current.
    pub reversals: Vec<Reversal>,
    /// What was found and not used, and why.
    pub left_out: Vec<String>,
    /// Scatter of the settled torque: current, A, standard deviation, N·m, and number of stretches (figure 3.9).
    pub scatter: Vec<(f64, f64, usize)>,
}

/// Identifies a brake from recordings: `(name, recording)`.
///
/// Settled torques and time constants are averaged over the consecutive steps of one current and
/// one speed in one recording, as in the text. The averages are fitted, and their scatter gives the
/// intervals.
///
/// # Errors
/// A recording has no current or torque, its torque drives the motion, or none of them holds a step
/// or a reversal.
pub fn identify(recordings: &[(String, Recording)]) -> Result<Identified, IdentifyError> {
    let mut found = Identified::default();
    for (index, (name, recording)) in recordings.iter().enumerate() {
        let sampled = Sampled::new(name, recording)?;
        let plateaus = plateau::plateaus(&sampled);
        step::find(&sampled, &plateaus, index, &mut found);
        backlash::find(&sampled, &plateaus, index, &mut found);
    }
    if found.steps.is_empty() && found.reversals.is_empty() {
        return Err(IdentifyError::Nothing {
            left_out: found
                .left_out
                .first()
                .cloned()
                .unwrap_or_else(|| "the current never stays at one value for 0.1 s".to_owned()),
        });
    }
    let sets = Sets::new(&found);
    found.scatter = sets.scatter();
    torque_gain(&sets, &mut found);
    found.brake.rising = surface(&sets, Edge::Rising, &mut found.missing);
    found.brake.falling = surface(&sets, Edge::Falling, &mut found.missing);
    found.brake.backlash_width = backlash::width(&found.reversals);
    if found.brake.backlash_width.is_none() {
        found.missing.push(
            "the backlash width: record motion that reverses by more than 6°, at a constant current of 0.5 A or more"
                .to_owned(),
        );
    }
    Ok(found)
}

fn torque_gain(sets: &Sets, found: &mut Identified) {
    let steady = sets.steady();
    let greatest = steady.iter().map(|s| s.0).fold(0.0, f64::max);
    let Some(fit) = gain_fit(&steady) else {
        found.missing.push(
            "the torque gain: hold at least three currents from 0.2 A and, below it, no current and one more".to_owned(),
        );
        return;
    };
    if fit.break_in_linear {
        found.left_out.push(
            "k_1 rests on 0.2 A itself, which (3.3) counts to the other piece: hold a current below it as well".to_owned(),
        );
    }
    let [k_1, k_2] = fit.linear;
    let [k_3, k_4, k_5] = fit.quadratic;
    found.brake.torque_gain = Some(Gain {
        k: [k_1, k_2, k_3, k_4, k_5].map(|k| with_interval(&k)),
        r_squared: Some(fit.r_squared),
        greatest_current: Value::known(greatest),
    });
}

fn surface(sets: &Sets, edge: Edge, missing: &mut Vec<String>) -> Option<Surface> {
    let measured = sets.time_constants(edge);
    let fast = measured
        .iter()
        .filter(|(_, omega_rpm, _)| *omega_rpm >= FAST_SHARE * edge.threshold_rpm());
    let fast: Vec<f64> = fast.map(|m| m.2).collect();
    let (name, threshold_rpm) = (edge.name(), edge.threshold_rpm());
    let Some(mean) = average(&fast) else {
        missing.push(format!(
            "the {name} time constant: step between no current and 0.2 A or more at {threshold_rpm} rpm and above"
        ));
        return None;
    };
    let fit = surface_fit(&measured, edge);
    if fit.is_none() {
        missing.push(format!(
            "the {name} time constant below {threshold_rpm} rpm: step at three speeds or more up to there, at two currents or more each"
        ));
    }
    let range = |pick: fn(&(f64, f64, f64)) -> f64| {
        let values = measured.iter().map(pick);
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        values.fold(ends, |(low, high), x| (low.min(x), high.max(x)))
    };
    let (least_a, _) = range(|m| m.0);
    let (least_rpm, greatest_rpm) = range(|m| m.1);
    let speed = |rpm: f64| Value::known(rpm * rigproof_spec::units::RAD_S_PER_RPM);
    Some(Surface {
        average: with_interval(&mean),
        r_squared: fit.as_ref().map(|fit| fit.r_squared),
        a: fit.map(|fit| fit.coefficients.map(|a| with_interval(&a))),
        speed_range: [speed(least_rpm), speed(greatest_rpm)],
        least_current: Value::known(least_a),
    })
}

/// Absolute speed in rpm.
fn speed_rpm(omega_rad_s: f64) -> f64 {
    rpm_from_rad_s(omega_rad_s.abs())
}
