//! This file is the columns of a plant of one joint: resistances along its motion, and changes of its drive.

use super::inertia::Inertia;
use super::run::{JointRun, PlantKind};
use crate::filter::gradient;
use crate::plant::{self, Columns, Run};
use crate::problem::less;
use crate::signals::{USUAL_SHARE, lagged_yield, numerov, shifted, through_play};
use rigproof_model::bench::column;
use rigproof_model::effects::{CurrentPlay, first_order_lag, law};
use rigproof_spec::effect::Mechanism;

/// One signal for each linear parameter of a resistance, as the position sees it: the law with that parameter 1 and the
/// others 0. `None` for a mechanism that acts on the drive.
pub fn resistances(run: &JointRun, mechanism: Mechanism, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    if is_of_brake(mechanism) {
        return Some(vec![of_brake(run, mechanism, shape)?]);
    }
    let own = plant::resistances(&run.motion, run.step_s, mechanism, shape)?;
    Some(own.into_iter().map(|signal| seen(run, signal)).collect())
}

/// Whether a mechanism is something that a brake does with its current or its torque.
pub const fn is_of_brake(mechanism: Mechanism) -> bool {
    matches!(
        mechanism,
        Mechanism::CurrentHysteresis | Mechanism::ReversalOvershoot
    )
}

/// What a brake's mechanism adds to the torque for a linear parameter of 1; `None` on a plant without a brake and its current.
pub fn of_brake(run: &JointRun, mechanism: Mechanism, shape: &[f64]) -> Option<Vec<f64>> {
    let (predicted, current) = run.brake()?;
    let value = *shape.first()?;
    match mechanism {
        Mechanism::CurrentHysteresis => {
            let play = CurrentPlay {
                half_width_a: value,
                closing_a: 0.0,
            };
            let held = through_play(current, play, USUAL_SHARE);
            let change = less(&run.braked(&held)?, &run.braked(current)?);
            Some(change.into_iter().map(|c| c / USUAL_SHARE).collect())
        }
        // The law says which share of the brake's torque.
        Mechanism::ReversalOvershoot => {
            let law = law(mechanism, &[1.0, value])?;
            let share = column(law.as_ref(), &run.motion, run.step_s);
            let pairs = share.iter().zip(predicted);
            Some(pairs.map(|(share, torque)| share * torque.abs()).collect())
        }
        _ => None,
    }
}

/// A resistance as the discrete second difference of the position sees it: on an axis with Numerov's weights,
/// exact to fourth order in the step for a signal that is smooth between samples.
fn seen(run: &JointRun, signal: Vec<f64>) -> Vec<f64> {
    match run.plant {
        PlantKind::Axis => numerov(&signal),
        PlantKind::Bench => signal,
    }
}

/// The effort as the discrete second difference of the position sees it: half of the last value and half of this
/// one for a drive that holds, Numerov's weights for one that was sampled; the metered effort itself on a bench.
pub fn acting_effort(run: &JointRun, effort: &[f64]) -> Vec<f64> {
    match (run.plant, run.held) {
        (PlantKind::Bench, _) => effort.to_vec(),
        (PlantKind::Axis, true) => {
            let before = effort.first().into_iter().chain(effort);
            before.zip(effort).map(|(b, e)| 0.5 * (b + e)).collect()
        }
        (PlantKind::Axis, false) => numerov(effort),
    }
}

/// What a recorded drive has more than the one that acts, as the position sees it.
fn missing_effort(run: &JointRun, acting: &[f64]) -> Vec<f64> {
    acting_effort(run, &less(&run.effort, acting))
}

/// Columns of a mechanism that acts on the drive; `fitted` is what the other terms give.
pub fn drive(
    run: &JointRun,
    mechanism: Mechanism,
    shape: &[f64],
    fitted: &[f64],
) -> Option<Columns> {
    let value = shape.first().copied().unwrap_or(0.0);
    let step_s = run.step_s;
    let inertia_known = !matches!(run.inertia, Inertia::Unknown(_));
    let fixed = |signal| Some(Columns::Fixed(signal));
    match (mechanism, run.plant) {
        // With a known inertia the command itself can be delayed: it has less noise than an acceleration.
        (Mechanism::Lag, PlantKind::Axis) if inertia_known => {
            let acting = first_order_lag(&run.effort, step_s, value);
            fixed(missing_effort(run, &acting))
        }
        (Mechanism::ChannelSkew, PlantKind::Axis) if inertia_known => {
            let acting = shifted(&run.effort, -value / step_s);
            fixed(missing_effort(run, &acting))
        }
        // Else the command is ahead of the effort that moves the joint: gain·u = e + time_constant·de/dt.
        (Mechanism::Lag, PlantKind::Axis) => {
            let slope = gradient(fitted, step_s);
            fixed(slope.into_iter().map(|s| value * s).collect())
        }
        (Mechanism::ChannelSkew, PlantKind::Axis) => {
            fixed(less(&shifted(fitted, value / step_s), fitted))
        }
        // The yield of a brake lags, its sign does not (docs/decisions/0001).
        (Mechanism::Lag, PlantKind::Bench) => match run.brake() {
            Some((predicted, _)) => {
                let lagged = lagged_yield(predicted, step_s, value);
                fixed(less(&lagged, predicted))
            }
            _ => {
                let lagged = first_order_lag(fitted, step_s, value);
                fixed(less(&lagged, fitted))
            }
        },
        (Mechanism::ChannelSkew, PlantKind::Bench) => {
            fixed(less(&shifted(fitted, -value / step_s), fitted))
        }
        (Mechanism::GainError, _) if inertia_known => Some(Columns::Free(vec![run.known()])),
        _ => None,
    }
}
