//! This file computes the regression columns of the five-bar: what each cause would add to the
//! efforts of θA and θB.

use super::encoder::Encoder;
use super::equations::{inertial, stacked};
use super::free_run::length_of;
use super::from_rig::with_angles;
use super::joined::over_parts;
use super::run::{FiveBarRun, joint_at, place, place_of};
use crate::cause::{Cause, Place, Scales};
use crate::plant;
use crate::problem::{add, less};
use crate::rules::SMALL_LENGTH_M;
use crate::signals::{numerov, shifted, unit_parameters};
use rigproof_model::effects::{
    Drive, Form, Law, OfBrake, OfLinkage, OfSensor, entry, facts, first_order_lag_straight, form,
};
use rigproof_model::motion::added_mass;
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_spec::inertia::Inertia;
use rigproof_spec::joint::Joint;

/// The effort of a force on the tip, N, at θA and θB, as the second difference of the angles shows
/// it.
pub fn driving(run: &FiveBarRun, force: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
    seen(&run.at_tip(force))
}

/// The efforts that the nominal model predicts: inertia and brakes.
pub fn known(run: &FiveBarRun) -> Vec<f64> {
    let mut sum = inertial(run, &run.forms);
    for joint in run.parameters.layout.brakes() {
        let torque = run.at_joint(*joint, &run.brake_torque(*joint));
        crate::problem::add(&mut sum, &seen(&torque), 1.0);
    }
    sum
}

/// One column per linear parameter of a cause. `None` if the cause has another form or no meaning
/// here.
pub fn free(run: &FiveBarRun, cause: Cause, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    if cause.at == Place::Every {
        let each = everywhere(run, cause).map(|own| free(run, own, shape));
        let each: Vec<Vec<Vec<f64>>> = each.collect::<Option<_>>()?;
        return each.into_iter().reduce(|sum, own| {
            let pairs = sum.into_iter().zip(own);
            pairs.map(|(sum, own)| both(sum, &own)).collect()
        });
    }
    if let Some(encoder) = Encoder::of(run, cause, shape) {
        return over_parts(run, |part| encoder.signals(part));
    }
    over_parts(run, |part| free_of_one(part, cause, shape))
}

/// The single causes that a cause of every brake stands for.
fn everywhere(run: &FiveBarRun, cause: Cause) -> impl Iterator<Item = Cause> {
    let joints = run.parameters.layout.brakes().iter();
    joints.map(move |joint| Cause {
        at: place_of(Some(*joint)),
        ..cause
    })
}

fn both(mut sum: Vec<f64>, own: &[f64]) -> Vec<f64> {
    add(&mut sum, own, 1.0);
    sum
}

fn free_of_one(run: &FiveBarRun, cause: Cause, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    if let Place::Axis(axis) = cause.at {
        let forces = run.forces();
        let own = forces.map(|[x, y]| if axis == 0 { [x, 0.0] } else { [0.0, y] });
        return match form(cause.mechanism)? {
            Form::Sensor(OfSensor::ForceGain) => Some(vec![driving(run, own)]),
            _ => None,
        };
    }
    match (form(cause.mechanism)?, joint_at(cause.at)) {
        (Form::Drive(Drive::Gain), Some(joint)) => {
            Some(vec![seen(&run.at_joint(joint, &run.brake_torque(joint)))])
        }
        (Form::Brake(kind), Some(joint)) => {
            let is_unit = entry(cause.mechanism).is_some_and(|entry| entry.linear > 0);
            let change = is_unit.then(|| changed(run, kind, joint, shape))??;
            Some(vec![along_motion(run, joint, &change)])
        }
        // A joint spring has an unknown rest angle. The second column is its torque at θ = 0.
        (Form::Resistance(_) | Form::ShareOfBrake(_), Some(joint)) => {
            let mut columns = at_joint(run, cause, joint, shape)?;
            if let Some(zero) = facts(cause.mechanism)?.zero {
                columns.extend(at_joint(run, Cause::of(zero), joint, shape)?);
            }
            Some(columns)
        }
        (Form::Linkage(OfLinkage::LinkLength), Some(joint)) => Some(vec![longer(run, joint)?]),
        (Form::Linkage(OfLinkage::PlaneSpring), None) => anchored(run, shape),
        (Form::Linkage(OfLinkage::Load), Some(joint)) => {
            let loads: Vec<f64> = run.forces().map(|[x, y]| x.hypot(y)).collect();
            Some(vec![along_motion(run, joint, &loads)])
        }
        (Form::Sensor(OfSensor::ForceGain), None) => Some(vec![driving(run, run.forces())]),
        (Form::Sensor(OfSensor::ForceBias), None) => Some(
            [[1.0, 0.0], [0.0, 1.0]]
                .map(|unit| driving(run, core::iter::repeat(unit)))
                .into(),
        ),
        (Form::Linkage(OfLinkage::Weight), None) => {
            Some([0, 1].map(|axis| seen(&weight(run, axis))).into())
        }
        (
            Form::Linkage(
                of @ (OfLinkage::Payload | OfLinkage::Inertias | OfLinkage::InertiaScale),
            ),
            None,
        ) => Some(by_masses(run, of)),
        // These have a fixed column, or belong elsewhere.
        (Form::Drive(_) | Form::Sensor(_) | Form::Linkage(_) | Form::Joint(_), Some(_))
        | (
            Form::Resistance(_)
            | Form::ShareOfBrake(_)
            | Form::Brake(_)
            | Form::Drive(_)
            | Form::Linkage(OfLinkage::Load | OfLinkage::LinkLength)
            | Form::Joint(_)
            | Form::Sensor(
                OfSensor::EncoderScale
                | OfSensor::EncoderOffset
                | OfSensor::Eccentric
                | OfSensor::Clock
                | OfSensor::ForceRotation,
            ),
            None,
        ) => None,
    }
}

/// A column with coefficient 1: a change of a brake, of the clock or of the sensor's direction.
pub fn fixed(run: &FiveBarRun, cause: Cause, shape: &[f64]) -> Option<Vec<f64>> {
    if cause.at == Place::Every {
        let each = everywhere(run, cause).map(|own| fixed(run, own, shape));
        let each: Vec<Vec<f64>> = each.collect::<Option<_>>()?;
        return each.into_iter().reduce(|sum, own| both(sum, &own));
    }
    let own = over_parts(run, |part| Some(vec![fixed_of_one(part, cause, shape)?]))?;
    own.into_iter().next()
}

fn fixed_of_one(run: &FiveBarRun, cause: Cause, shape: &[f64]) -> Option<Vec<f64>> {
    let value = *shape.first()?;
    match (form(cause.mechanism)?, joint_at(cause.at)) {
        // A brake's mechanism changes its yield torque, not the sign of its torque (decision 0001).
        (Form::Brake(kind), Some(joint)) => {
            let change = changed(run, kind, joint, shape)?;
            Some(along_motion(run, joint, &change))
        }
        // The effort lags, as in the library's equation: the whole brake with its own response.
        (Form::Drive(Drive::Lag), Some(joint)) => {
            run.braked(joint)?;
            let own = run.yields.get(place(joint))?;
            let change = less(&first_order_lag_straight(own, run.step_s, value), own);
            Some(along_motion(run, joint, &change))
        }
        // The recorded force is delayed, so the acting force is the recorded one shifted forward.
        (Form::Drive(Drive::Skew), None) => {
            let delay = value / run.step_s;
            let [x, y] = run
                .force
                .each_ref()
                .map(|force| less(force, &shifted(force, delay)));
            Some(driving(run, x.into_iter().zip(y).map(|(x, y)| [x, y])))
        }
        // The full rotation. Its first-order term alone would leave 1 − cos of the force, which
        // looks like a gain error.
        (Form::Sensor(OfSensor::ForceRotation), None) => {
            let (sine, cosine) = libm::sincos(value);
            let too_much = run
                .forces()
                .map(|[x, y]| [x - cosine * x - sine * y, y - cosine * y + sine * x]);
            Some(driving(run, too_much))
        }
        (
            Form::Drive(_)
            | Form::Joint(_)
            | Form::Resistance(_)
            | Form::ShareOfBrake(_)
            | Form::Brake(_)
            | Form::Linkage(_)
            | Form::Sensor(_),
            _,
        ) => None,
    }
}

/// The change that a cause makes to the yield torque of a joint's brake.
fn changed(run: &FiveBarRun, kind: OfBrake, joint: Joint, shape: &[f64]) -> Option<Vec<f64>> {
    let own = run.yields.get(place(joint))?;
    run.braked(joint)?.change(own, kind, shape)
}

/// The efforts of a spring from the tip to an anchor, per unit of stiffness and per unit of
/// tension.
fn anchored(run: &FiveBarRun, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    let [x, y] = *shape else {
        return None;
    };
    let away = || {
        let tips = run.poses.iter().map(|pose| pose.tip_m);
        tips.map(move |[tip_x, tip_y]| [tip_x - x, tip_y - y])
    };
    let unit = away().map(|[x, y]| {
        let length = x.hypot(y).max(1e-9);
        [-x / length, -y / length]
    });
    Some(vec![driving(run, away()), driving(run, unit)])
}

/// The effort per unit of additional arm length, by a finite difference of the balance along the
/// recorded angles.
fn longer(run: &FiveBarRun, joint: Joint) -> Option<Vec<f64>> {
    let mut changed = run.clone();
    *length_of(&mut changed.parameters.arms, joint) += SMALL_LENGTH_M;
    let changed = with_angles(&changed, run.theta.clone()).ok()?;
    let balance = |run: &FiveBarRun| less(&driving(run, run.forces()), &known(run));
    let difference = less(&balance(run), &balance(&changed)).into_iter();
    Some(difference.map(|x| x / SMALL_LENGTH_M).collect())
}

/// A change of yield torque as a torque along the joint's motion.
fn along_motion(run: &FiveBarRun, joint: Joint, change: &[f64]) -> Vec<f64> {
    let pairs = run.motion_of(joint).iter().zip(change);
    let torque: Vec<f64> = pairs.map(|(now, c)| now.sense * c).collect();
    seen(&run.at_joint(joint, &torque))
}

/// The columns of a law at one joint.
fn at_joint(run: &FiveBarRun, cause: Cause, joint: Joint, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    let entry = entry(cause.mechanism)?;
    let is_share = cause.scales == Scales::Torque;
    let of: Option<&Vec<f64>> = match entry.form {
        Form::Resistance(_) if !is_share => None,
        Form::Resistance(_) | Form::ShareOfBrake(_) => Some(run.yields.get(place(joint))?),
        Form::Drive(_) | Form::Brake(_) | Form::Linkage(_) | Form::Sensor(_) | Form::Joint(_) => {
            return None;
        }
    };
    unit_parameters(entry.linear, shape)
        .map(|parameters| {
            let law = cause.law(&parameters)?;
            let mut resistance = along(law.as_ref(), run, joint);
            for (share, torque) in resistance.iter_mut().zip(of.into_iter().flatten()) {
                *share *= torque;
            }
            Some(seen(&run.at_joint(joint, &resistance)))
        })
        .collect()
}

/// The resistance of a law along a joint's motion.
fn along(law: &dyn Law, run: &FiveBarRun, joint: Joint) -> Vec<f64> {
    let known_travel = || run.known_travel(joint);
    plant::along(law, run.motion_of(joint), run.step_s, known_travel)
}

/// The effort of the weight per unit of gravity along x (0) or y (1), N·m.
fn weight(run: &FiveBarRun, axis: usize) -> Vec<f64> {
    let gravity = if axis == 0 { [1.0, 0.0] } else { [0.0, 1.0] };
    let [joint_a, _, joint_b, _] = &run.joints;
    let motion = run.forms.iter().zip(joint_a.iter().zip(joint_b));
    stacked(motion.map(|(form, (a, b))| {
        let inertia = &run.parameters.inertia;
        (-form.weight(inertia, [a.position, b.position], gravity)).into()
    }))
}

/// The efforts per unit of each number by which masses differ from the nominal ones.
fn by_masses(run: &FiveBarRun, of: OfLinkage) -> Vec<Vec<f64>> {
    let by = |more: &Inertia| inertial(run, &forms_of(run, more));
    match of {
        OfLinkage::InertiaScale => vec![inertial(run, &run.forms)],
        OfLinkage::Payload => vec![by(&added_mass::at_tip(1.0))],
        _ => unit_inertias(&run.parameters.inertia)
            .each_ref()
            .map(by)
            .into(),
    }
}

fn forms_of(run: &FiveBarRun, inertia: &Inertia) -> Vec<TwoCoordinate> {
    let arms = &run.parameters.arms;
    let [joint_a, _, joint_b, _] = &run.joints;
    let motion = joint_a.iter().zip(joint_b).zip(&run.poses);
    motion
        .map(|((a, b), pose)| two_coordinate(arms, inertia, pose, [a.speed, b.speed]))
        .collect()
}

/// A unit of each parameter of an inertia error: AE, BC, ED, CD, tip.
fn unit_inertias(nominal: &Inertia) -> [Inertia; 5] {
    [0, 1, 2, 3, 4].map(|own| {
        let unit = [0, 1, 2, 3, 4].map(|k| f64::from(u8::from(k == own)));
        added_mass::in_all(nominal, unit)
    })
}

/// An effort as the second difference of the angles shows it: Numerov's weights on both outputs.
fn seen(signal: &[f64]) -> Vec<f64> {
    let (a, b) = signal.split_at(signal.len() / 2);
    let mut out = numerov(a);
    out.extend(numerov(b));
    out
}
