//! This file is what a brake may do with its current other than the nominal model says, as changes of its yield torque.

use super::run::{FiveBarRun, place, yields};
use crate::problem::less;
use crate::signals::{USUAL_SHARE, shifted, through_play};
use rigproof_model::brake::{Brake, slowed};
use rigproof_model::effects::{CurrentPlay, Drive, Form, OfBrake, first_order_lag_straight, form};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::brake_table;
use rigproof_spec::units::RAD_PER_DEG;

/// What a cause with coefficient 1 adds to a brake's yield torque, sample by sample, N·m.
pub fn change(
    run: &FiveBarRun,
    mechanism: Mechanism,
    joint: Joint,
    value: f64,
) -> Option<Vec<f64>> {
    let own = run.yields.get(place(joint))?;
    let current = run.currents.get(place(joint))?.as_ref()?;
    let again = |brake: Brake, current: &[f64]| {
        let changed = yields(brake, run.motion_of(joint), current, run.step_s);
        Some(less(&changed, own))
    };
    let start = run.motion_of(joint).first()?.position;
    match form(mechanism)? {
        // What lags is the effort, as the equation of the library has it: the whole brake, its own response included.
        Form::Drive(Drive::Lag) => {
            Some(less(&first_order_lag_straight(own, run.step_s, value), own))
        }
        Form::Brake(OfBrake::DeadTime) => {
            let late = shifted(current, -value / run.step_s);
            again(Brake::new(joint, start), &late)
        }
        Form::Brake(OfBrake::Saturation) => {
            let limited: Vec<f64> = current.iter().map(|i| i.min(value)).collect();
            again(Brake::new(joint, start), &limited)
        }
        Form::Brake(OfBrake::BacklashWidth) => {
            let mut table = brake_table(joint);
            table.backlash_width_deg = value / RAD_PER_DEG;
            again(Brake::of(table, start), current)
        }
        Form::Brake(OfBrake::CurrentGain) => {
            let given: Vec<f64> = current.iter().map(|i| value * i).collect();
            again(Brake::new(joint, start), &given)
        }
        Form::Brake(OfBrake::TimeConstant) => {
            again(Brake::of(slowed(brake_table(joint), value), start), current)
        }
        Form::Brake(OfBrake::CurrentHysteresis | OfBrake::ThermalFade)
        | Form::Drive(Drive::Gain | Drive::Skew | Drive::Limit)
        | Form::Resistance(_)
        | Form::ShareOfBrake(_)
        | Form::Linkage(_)
        | Form::Sensor(_)
        | Form::Joint(_) => None,
    }
}

/// What a linear cause adds to a brake's yield torque for a coefficient of 1, sample by sample.
pub fn unit(run: &FiveBarRun, kind: OfBrake, joint: Joint, shape: &[f64]) -> Option<Vec<f64>> {
    let own = run.yields.get(place(joint))?;
    let current = run.currents.get(place(joint))?.as_ref()?;
    let value = *shape.first()?;
    match kind {
        // The torque is not linear in the current: a share of the size that is expected stands for the slope.
        OfBrake::CurrentHysteresis => {
            let play = CurrentPlay {
                half_width_a: value,
                closing_a: shape.get(1).copied().unwrap_or(0.0),
            };
            let held = through_play(current, play, USUAL_SHARE);
            let start = run.motion_of(joint).first()?.position;
            let changed = yields(
                Brake::new(joint, start),
                run.motion_of(joint),
                &held,
                run.step_s,
            );
            let change = less(&changed, own);
            Some(change.into_iter().map(|c| c / USUAL_SHARE).collect())
        }
        OfBrake::ThermalFade => {
            let mut heat_j = 0.0;
            let pairs = own.iter().zip(run.motion_of(joint));
            let fade = pairs.map(|(torque, now)| {
                let lost = torque * heat_j;
                heat_j += run.step_s * (torque * now.speed.abs() - heat_j / value);
                -lost
            });
            Some(fade.collect())
        }
        OfBrake::BacklashWidth
        | OfBrake::DeadTime
        | OfBrake::Saturation
        | OfBrake::TimeConstant
        | OfBrake::CurrentGain => None,
    }
}
