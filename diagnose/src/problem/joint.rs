//! This file is the columns of a plant of one joint: resistances along its motion, and changes of its drive.

use super::{Problem, USUAL_SHARE, lagged_yield, less, numerov, shifted, through_play};
use crate::filter::gradient;
use crate::run::{PlantKind, Run};
use rigproof_model::bench::column;
use rigproof_model::effects::{
    CurrentPlay, Drive, Form, OfBrake, entry, first_order_lag, form, law,
};
use rigproof_spec::effect::Mechanism;

/// A free column, and one with coefficient 1.
pub type DriveColumns = (Option<Vec<f64>>, Option<Vec<f64>>);

/// One signal for each linear parameter of a resistance, as the position sees it: the law with that parameter 1 and the
/// others 0. `None` for a mechanism that acts on the drive.
pub fn resistances(run: &Run, mechanism: Mechanism, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    let entry = entry(mechanism)?;
    if is_of_brake(mechanism) {
        return Some(vec![of_brake(run, mechanism, shape)?]);
    }
    if let Form::Drive(_) = entry.form {
        return None;
    }
    unit_parameters(entry.linear, shape)
        .map(|parameters| {
            let law = law(mechanism, &parameters)?;
            Some(seen(run, column(law.as_ref(), &run.motion, run.step_s)))
        })
        .collect()
}

/// Whether a mechanism is something that a brake does with its current or its torque.
pub fn is_of_brake(mechanism: Mechanism) -> bool {
    matches!(
        form(mechanism),
        Some(Form::ShareOfBrake(_) | Form::Brake(OfBrake::CurrentHysteresis))
    )
}

/// What a brake's mechanism adds to the torque for a linear parameter of 1; `None` on a plant without a brake and its current.
pub fn of_brake(run: &Run, mechanism: Mechanism, shape: &[f64]) -> Option<Vec<f64>> {
    let (predicted, current) = run.brake()?;
    let value = *shape.first()?;
    match form(mechanism)? {
        Form::Brake(OfBrake::CurrentHysteresis) => {
            let play = CurrentPlay {
                half_width_a: value,
                closing_a: 0.0,
            };
            let held = through_play(current, play, USUAL_SHARE);
            let change = less(&run.braked(&held)?, &run.braked(current)?);
            Some(change.into_iter().map(|c| c / USUAL_SHARE).collect())
        }
        // The law says which share of the brake's torque.
        Form::ShareOfBrake(law) => {
            let law = law(&[1.0, value]);
            let share = column(law.as_ref(), &run.motion, run.step_s);
            let pairs = share.iter().zip(predicted);
            Some(pairs.map(|(share, torque)| share * torque.abs()).collect())
        }
        // Its backlash is taken as known on a bench, and so is when and how much of the current it gets.
        Form::Brake(
            OfBrake::BacklashWidth | OfBrake::DeadTime | OfBrake::Saturation | OfBrake::ThermalFade,
        )
        | Form::Resistance(_)
        | Form::Drive(_)
        | Form::Linkage(_)
        | Form::Sensor(_) => None,
    }
}

/// The parameters of a law with each of its linear ones 1 in turn and the others 0.
pub fn unit_parameters(linear: usize, shape: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    (0..linear).map(move |index| {
        let unit = (0..linear).map(|k| if k == index { 1.0 } else { 0.0 });
        unit.chain(shape.iter().copied()).collect()
    })
}

/// A resistance as the discrete second difference of the position sees it: on an axis with Numerov's weights,
/// exact to fourth order in the step for a signal that is smooth between samples.
fn seen(run: &Run, signal: Vec<f64>) -> Vec<f64> {
    match run.plant {
        PlantKind::Axis => numerov(&signal),
        PlantKind::Bench => signal,
    }
}

/// The effort as the discrete second difference of the position sees it: half of the last value and half of this
/// one for a drive that holds, Numerov's weights for one that was sampled; the metered effort itself on a bench.
pub fn acting_effort(run: &Run, effort: &[f64]) -> Vec<f64> {
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
fn missing_effort(run: &Run, acting: &[f64]) -> Vec<f64> {
    acting_effort(run, &less(&run.effort, acting))
}

/// Columns of a mechanism that acts on the drive; `fitted` is what the other terms give.
pub fn drive(
    problem: &Problem,
    run: &Run,
    mechanism: Mechanism,
    shape: &[f64],
    fitted: &[f64],
) -> Option<DriveColumns> {
    let value = shape.first().copied().unwrap_or(0.0);
    let step_s = run.step_s;
    let inertia_known = problem.inertia_column.is_none();
    let Form::Drive(change) = form(mechanism)? else {
        return None;
    };
    match (change, run.plant) {
        // With a known inertia the command itself can be delayed: it has less noise than an acceleration.
        (Drive::Lag, PlantKind::Axis) if inertia_known => {
            let acting = first_order_lag(&run.effort, step_s, value);
            Some((None, Some(missing_effort(run, &acting))))
        }
        (Drive::Skew, PlantKind::Axis) if inertia_known => {
            let acting = shifted(&run.effort, -value / step_s);
            Some((None, Some(missing_effort(run, &acting))))
        }
        // Else the command is ahead of the effort that moves the joint: gain·u = e + time_constant·de/dt.
        (Drive::Lag, PlantKind::Axis) => {
            let slope = gradient(fitted, step_s);
            Some((None, Some(slope.into_iter().map(|s| value * s).collect())))
        }
        (Drive::Skew, PlantKind::Axis) => {
            Some((None, Some(less(&shifted(fitted, value / step_s), fitted))))
        }
        // The yield of a brake lags, its sign does not (docs/decisions/0001).
        (Drive::Lag, PlantKind::Bench) => match run.brake() {
            Some((predicted, _)) => {
                let lagged = lagged_yield(predicted, step_s, value);
                Some((None, Some(less(&lagged, predicted))))
            }
            _ => {
                let lagged = first_order_lag(fitted, step_s, value);
                Some((None, Some(less(&lagged, fitted))))
            }
        },
        (Drive::Skew, PlantKind::Bench) => {
            Some((None, Some(less(&shifted(fitted, -value / step_s), fitted))))
        }
        (Drive::Gain, _) => inertia_known.then(|| (Some(problem.known.clone()), None)),
    }
}
