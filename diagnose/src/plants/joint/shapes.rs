//! This file says which causes are tried on a plant of one joint, and in which shapes.

use super::run::JointRun;
use crate::candidates::{fastest, geometric, periods, stribeck_shapes};
use crate::cause::Cause;
use crate::plant::Run;
use crate::weak::Windows;
use rigproof_model::effects::{Form, LIBRARY};
use rigproof_spec::effect::Mechanism;

/// The causes that have a meaning on a plant of one joint, in the library's order.
pub fn causes(run: &JointRun) -> Vec<Cause> {
    let has_brake = run.brake().is_some();
    // A gain can only be wrong against something that is known.
    let is_known = run.known().iter().any(|e| *e != 0.0);
    LIBRARY
        .iter()
        .filter(|entry| match entry.mechanism {
            Mechanism::CurrentHysteresis | Mechanism::ReversalOvershoot => has_brake,
            // Only the five-bar is asked for them: the rules of the other plants were chosen without.
            Mechanism::Settling | Mechanism::AsymmetricPresliding => false,
            Mechanism::GainError => is_known,
            _ => matches!(entry.form, Form::Resistance(_) | Form::Drive),
        })
        .map(|entry| Cause::of(entry.mechanism))
        .collect()
}

/// The shapes of a mechanism that are tried; `residual` is what is left, row by row.
pub fn shapes(
    run: &JointRun,
    mechanism: Mechanism,
    windows: &Windows,
    residual: &[f64],
) -> Vec<Vec<f64>> {
    let travel = run.travel().max(1e-12);
    let one = |values: Vec<f64>| values.into_iter().map(|v| vec![v]).collect();
    match mechanism {
        Mechanism::Stribeck => stribeck_shapes(run.speed_floor, fastest(&run.motion)),
        Mechanism::Presliding | Mechanism::AsymmetricPresliding => one(geometric(
            (3.0 * run.position_noise).max(1e-4 * travel),
            0.2 * travel,
            12,
        )),
        Mechanism::Hysteresis => geometric(0.2 / travel, 40.0 / travel, 8)
            .into_iter()
            .flat_map(|gamma| [-1.4, -0.5, 0.5, 1.4].map(|ratio| vec![gamma, gamma * ratio]))
            .collect(),
        Mechanism::Ripple => one(periods(&points(run, windows, residual), run.travel())),
        Mechanism::Lag => one(geometric(0.5 * run.step_s, 0.25, 14)),
        Mechanism::ReversalOvershoot => one(geometric(0.01, 1.5, 6)),
        Mechanism::CurrentHysteresis => one(geometric(0.01, 0.5, 7)),
        Mechanism::ChannelSkew => {
            let sizes = geometric(0.5 * run.step_s, 0.08f64.max(4.0 * run.step_s), 12);
            one(sizes.iter().flat_map(|&s| [s, -s]).collect())
        }
        _ => vec![vec![]],
    }
}

/// Position and residual of each usable window.
fn points(run: &JointRun, windows: &Windows, residual: &[f64]) -> Vec<(f64, f64)> {
    windows
        .centres
        .iter()
        .zip(residual)
        .zip(&windows.usable)
        .filter(|(_, usable)| **usable)
        .filter_map(|((&centre, &r), _)| run.motion.get(centre).map(|now| (now.position, r)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::joint::recorded::exact_bench;
    use core::f64::consts::TAU;

    #[test]
    fn the_period_of_a_ripple_is_among_those_tried() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let windows = run.windows_of(0.017);
        let period = run.travel() / 23.7;
        let residual: Vec<f64> = windows
            .centres
            .iter()
            .map(|c| 0.4 * libm::sin(TAU * run.motion[*c].position / period + 0.9))
            .collect();
        let best = periods(&points(&run, &windows, &residual), run.travel())[0];
        assert!((best / period - 1.0).abs() < 0.02, "{best} {period}");
    }
}
