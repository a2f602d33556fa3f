//! This file computes the regression columns of a plant of one joint: resistances along its motion,
//! and changes of its drive.

use super::drive::{changed, driven, lagging};
use super::inertia::Inertia;
use super::laws::own_law;
use super::run::{JointRun, PlantKind};
use crate::cause::{Cause, Scales};
use crate::effect::Effect;
use crate::filter::gradient;
use crate::plant::{self, Columns, Run};
use crate::problem::{add, less};
use crate::rules::STILL_NOISES;
use crate::signals::{known_travel, lagged_yield, numerov, second_difference, shifted};
use rigproof_model::axis::Trailing;
use rigproof_model::effects::facts::{AtRest, Family};
use rigproof_model::effects::{
    Drive, Form, Instant, Law, OfJoint, OfSensor, behind_shown, entry, facts, form, law,
    load_friction, shown_too_much,
};
use rigproof_spec::effect::Mechanism;

/// One column per linear parameter of a resistance: the law with that parameter 1 and the others 0,
/// filtered as the position shows it. `None` for a mechanism of the drive.
pub fn resistances(run: &JointRun, cause: Cause, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    let own = match is_of_brake(cause) {
        true => of_brake(run, cause, shape)?,
        false => plant::resistances(cause, shape, |law| along(run, law))?,
    };
    Some(own.into_iter().map(|signal| seen(run, signal)).collect())
}

/// The resistance of a law along the motion.
fn along(run: &JointRun, law: &dyn Law) -> Vec<f64> {
    let half = 0.5 * STILL_NOISES * run.position_noise;
    let known_travel = || known_travel(run.position.iter().copied(), half);
    plant::along(law, &run.motion, run.step_s, known_travel)
}

/// The torque that an effect adds to a brake, sample by sample.
pub fn of_effect(run: &JointRun, effect: &Effect) -> Option<Vec<f64>> {
    let linear = entry(effect.mechanism())?.linear;
    let (coefficients, shape) = effect
        .parameters
        .split_at(linear.min(effect.parameters.len()));
    let mut sum = vec![0.0; run.motion.len()];
    for (k, signal) in of_brake(run, effect.cause, shape)?.iter().enumerate() {
        add(
            &mut sum,
            signal,
            coefficients.get(k).copied().unwrap_or(1.0),
        );
    }
    Some(sum)
}

/// Whether a cause belongs to a brake's current or torque, or is a share of its torque.
pub fn is_of_brake(cause: Cause) -> bool {
    let is_share = cause.scales == Scales::Torque;
    is_share
        || matches!(
            form(cause.mechanism),
            Some(Form::Brake(_) | Form::ShareOfBrake(_))
        )
}

/// The torque that a cause adds to a brake, one signal per linear parameter. `None` on a plant
/// without a brake and its current.
pub fn of_brake(run: &JointRun, cause: Cause, shape: &[f64]) -> Option<Vec<Vec<f64>>> {
    let (predicted, current) = run.brake()?;
    if let Some(Form::Brake(kind)) = form(cause.mechanism) {
        let brake = run.brake_along(current)?;
        let change = brake.change(&brake.yields(), kind, shape)?;
        let along = run.motion.iter().zip(change);
        return Some(vec![
            along.map(|(now, change)| now.sense * change).collect(),
        ]);
    }
    // The law gives a share of the brake's torque.
    let mut shares = plant::resistances(cause, shape, |law| along(run, law))?;
    for share in shares
        .iter_mut()
        .flat_map(|own| own.iter_mut().zip(predicted))
    {
        *share.0 *= share.1.abs();
    }
    Some(shares)
}

/// A resistance as the discrete second difference of the position shows it. On an axis this applies
/// Numerov's weights, which are exact to fourth order in the step for a smooth signal.
fn seen(run: &JointRun, signal: Vec<f64>) -> Vec<f64> {
    match run.plant {
        PlantKind::Axis => numerov(&signal),
        PlantKind::Bench => metered(run, signal),
    }
}

/// A resistance as a bench meters it, with the sensor effects that the description states.
pub fn metered(run: &JointRun, signal: Vec<f64>) -> Vec<f64> {
    match run.metered_by.is_empty() {
        true => signal,
        false => driven(&run.metered_by, &signal, run, 0),
    }
}

/// The effort as the discrete second difference of the position shows it. A held drive counts half
/// the previous and half the present value; a sampled smooth one gets Numerov's weights. On a bench
/// it is the metered effort itself.
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

/// The recorded effort less the acting one, as the position shows it.
fn missing_effort(run: &JointRun, acting: &[f64]) -> Vec<f64> {
    acting_effort(run, &less(&run.effort, acting))
}

/// The described resistance along the motion, with the stated parameters. With `known_only`,
/// parameters that are to be estimated are left out.
fn described(run: &JointRun, known_only: bool) -> Vec<f64> {
    let effects = run.described.iter();
    sum_of(run, effects.filter(|own| !(known_only && own.unknown)))
}

/// The summed resistance of effects along the motion, with their stated parameters.
fn sum_of<'a>(run: &JointRun, effects: impl Iterator<Item = &'a Effect>) -> Vec<f64> {
    let mut sum = vec![0.0; run.motion.len()];
    for effect in effects {
        let own = match is_of_brake(effect.cause) {
            true => of_effect(run, effect),
            false => {
                law(effect.mechanism(), &effect.parameters).map(|law| along(run, law.as_ref()))
            }
        };
        let Some(own) = own else {
            continue;
        };
        let begins = effect.first_sample(run.clock());
        for (sum, own) in sum.iter_mut().zip(own).skip(begins) {
            *sum += own;
        }
    }
    sum
}

/// The described friction that fades at one of the rates of a fade. A description that states a fade
/// lists the faded effects before it.
fn faded_by_time(run: &JointRun, rate: usize) -> Vec<f64> {
    let is_fade = |own: &Effect| matches!(form(own.mechanism()), Some(Form::Joint(OfJoint::Fade)));
    let before = run.described.iter().position(is_fade);
    let before = before.unwrap_or(run.described.len());
    let own = run.described.iter().take(before);
    sum_of(run, own.filter(|own| fades_at(own) == Some(rate)))
}

/// The index of the rate at which a friction fades: one for what holds at rest and one for drag.
/// `None` for what is no friction.
pub(super) fn fades_at(effect: &Effect) -> Option<usize> {
    let facts = facts(effect.mechanism())?;
    match (facts.family, facts.at_rest) {
        (Family::FrictionOfMotion, AtRest::Nothing) => Some(1),
        (Family::FrictionOfMotion | Family::MemoryOfMotion, _) => Some(0),
        _ => None,
    }
}

/// The described viscous coefficient. The rest of the described resistance depends on the direction
/// of motion only.
fn described_viscous(run: &JointRun) -> f64 {
    let own = run.described.iter();
    let own = own.filter(|e| e.cause.mechanism == Mechanism::Viscous && !e.unknown);
    own.filter_map(|e| e.parameters.first()).sum()
}

fn acceleration(run: &JointRun) -> Vec<f64> {
    let speeds: Vec<f64> = run.motion.iter().map(|now| now.speed).collect();
    gradient(&speeds, run.step_s)
}

/// The known part of the equation, with the described resistance: what a changed drive scales.
fn known_effort(run: &JointRun) -> Vec<f64> {
    let mut known = run.known();
    add(&mut known, &seen(run, described(run, true)), 1.0);
    known
}

/// Friction by a power of the load of an axis, which is its drive's effort, friction included.
fn under_effort(run: &JointRun, numbers: &[f64]) -> Vec<f64> {
    let loads = run.effort.iter().zip(&run.motion);
    let signal = loads.map(|(load, now)| load_friction(*load, numbers) * now.sense);
    acting_effort(run, &signal.collect::<Vec<f64>>())
}

/// Friction by the load of a bench. `None` where no load is simulated.
pub fn under_load(run: &JointRun, numbers: &[f64]) -> Option<Vec<f64>> {
    let along = run.load()?.iter().zip(&run.motion);
    Some(
        along
            .map(|(load, now)| load_friction(*load, numbers) * now.sense)
            .collect(),
    )
}

/// The columns of a mechanism of the whole joint or of its encoder.
fn of_joint(run: &JointRun, form: Form, shape: &[f64]) -> Option<Columns> {
    let free = |signal: Vec<f64>| Some(Columns::Free(vec![signal]));
    let inertia = run.inertia.start();
    match (run.plant, form) {
        (PlantKind::Axis, _) | (_, Form::Joint(OfJoint::Fade)) => {}
        (_, Form::Joint(OfJoint::Load)) => {
            let signal = under_load(run, shape)?;
            return Some(Columns::Fixed(seen(run, signal)));
        }
        _ => return None,
    }
    match form {
        Form::Joint(OfJoint::Load) => {
            if shape.len() > 1 {
                return Some(Columns::Fixed(under_effort(run, shape)));
            }
            let share = *shape.first()?;
            let mut effort = described(run, false);
            add(&mut effort, &acceleration(run), inertia);
            let loads = effort.iter().zip(&run.motion);
            // Friction in proportion to the load depends on the load that includes it: e = rest +
            // share·|e|·sgn(q̇).
            let signal = loads.map(|(rest, now)| {
                let along = rest.signum() * now.sense;
                share * rest.abs() / (1.0 - share * along) * now.sense
            });
            Some(Columns::Fixed(seen(run, signal.collect())))
        }
        Form::Joint(OfJoint::Fade) => {
            let signals = [0, 1].map(|rate| {
                let friction = faded_by_time(run, rate);
                let faded = friction.iter().zip(&run.motion);
                let signal = faded.map(|(friction, now)| -friction * now.time_s);
                seen(run, signal.collect())
            });
            Some(Columns::Free(signals.into()))
        }
        Form::Joint(OfJoint::Inertia) => free(second_difference(&run.position, run.step_s)),
        Form::Joint(OfJoint::Compliance) => {
            let [_, _, ..] = *shape else {
                return None;
            };
            let part = Trailing::of(&[&[1.0], shape].concat());
            let apart = trailing(&acceleration(run), &part, run.step_s);
            free(seen(run, apart.into_iter().map(|a| inertia * a).collect()))
        }
        Form::Joint(OfJoint::Gap) => {
            let part = Trailing::in_a_gap(1.0, *shape.first()?);
            free(seen(run, trailing(&acceleration(run), &part, run.step_s)))
        }
        Form::Sensor(OfSensor::EncoderScale) => {
            let mut signal = run.known();
            let drag = described_viscous(run);
            let slow: Vec<f64> = run.motion.iter().map(|now| drag * now.speed).collect();
            add(&mut signal, &seen(run, slow), 1.0);
            free(signal)
        }
        Form::Sensor(OfSensor::Eccentric) => Some(Columns::Free(
            [[1.0, 0.0], [0.0, 1.0]]
                .map(|wave| shown_by(run, wave, shape, inertia))
                .into(),
        )),
        _ => None,
    }
}

/// The effort that an encoder's error adds, of so much sine and cosine: its second difference times
/// the inertia, and what the described laws take it for.
///
/// The shape is the pitch, if it is not a turn, and the error already known there: what the encoder
/// adds goes by the true position.
fn shown_by(run: &JointRun, wave: [f64; 2], shape: &[f64], inertia: f64) -> Vec<f64> {
    let pitch = shape.get(..1).unwrap_or_default();
    let known = [shape.get(1..).unwrap_or_default(), pitch].concat();
    let numbers = [&wave, pitch].concat();
    let there = |shown: f64| match shape.len() > 1 {
        true => behind_shown(shown, &known),
        false => shown,
    };
    let along = run.motion.iter();
    let more: Vec<f64> = along
        .map(|now| shown_too_much(there(now.position), &numbers))
        .collect();
    let mut signal = second_difference(&more, run.step_s);
    signal.iter_mut().for_each(|x| *x *= inertia);
    let laws: Vec<Box<dyn Law>> = run.described.iter().filter_map(own_law).collect();
    let moved = run
        .motion
        .iter()
        .zip(more.iter().zip(gradient(&more, run.step_s)));
    let taken = moved.map(|(now, (more, faster))| {
        let moved = Instant {
            position: now.position + SMALL * more,
            speed: now.speed + SMALL * faster,
            ..*now
        };
        let own = laws.iter().filter(|law| !law.remembers());
        own.map(|law| (law.smooth(&moved, 0.0) - law.smooth(now, 0.0)) / SMALL)
            .sum()
    });
    add(&mut signal, &seen(run, taken.collect()), 1.0);
    signal
}

/// The share of an encoder's error for which a law is a straight line.
const SMALL: f64 = 1e-6;

/// The acceleration of a trailing part relative to a joint that has the given acceleration.
fn trailing(acceleration: &[f64], part: &Trailing, step_s: f64) -> Vec<f64> {
    let turned = (part.resonance_rad_s * step_s).max(1.0);
    let substeps = (SUBSTEPS as f64 * turned).ceil() as usize;
    let h = step_s / substeps as f64;
    let mut moved = [0.0; 2];
    let next = acceleration.iter().skip(1).chain(acceleration.last());
    let each = acceleration.iter().zip(next).map(|(base, next)| {
        let now = part.pull(moved) - base;
        for sub in 0..substeps {
            // The midpoint of a substep, so that the mean is right.
            let share = (sub as f64 + 0.5) / substeps as f64;
            moved[1] += h * (part.pull(moved) - base - share * (next - base));
            moved[0] += h * moved[1];
        }
        now
    });
    each.collect()
}

/// Integration steps of a trailing part in one sample, and in a radian of its oscillation.
const SUBSTEPS: usize = 8;

/// The columns of a mechanism.
///
/// A change of the drive is linearised about the effort `beside`, which the other terms give. If
/// that is empty, the recorded drive is changed instead.
pub fn columns(
    run: &JointRun,
    cause: Cause,
    shape: &[f64],
    beside: Option<&[f64]>,
) -> Option<Columns> {
    let mechanism = cause.mechanism;
    match entry(mechanism)?.form {
        Form::Drive(what) => match beside? {
            [] => drive(run, what, shape),
            fitted => linearised(run, what, shape, fitted),
        },
        _ if beside.is_some() => None,
        form @ (Form::Joint(_) | Form::Sensor(_)) => of_joint(run, form, shape),
        Form::Brake(_) if entry(mechanism)?.linear == 0 => {
            let own = of_brake(run, cause, shape)?.pop()?;
            Some(Columns::Fixed(seen(run, own)))
        }
        _ => {
            let mut signals = resistances(run, cause, shape)?;
            // A law with an unknown zero gets a second coefficient for it.
            if let Some(zero) = facts(mechanism).and_then(|facts| facts.zero) {
                signals.extend(resistances(run, Cause::of(zero), &[])?);
            }
            Some(Columns::Free(signals))
        }
    }
}

/// The columns of a change of the recorded drive: the recorded effort less the acting one.
fn drive(run: &JointRun, what: Drive, shape: &[f64]) -> Option<Columns> {
    let value = shape.first().copied().unwrap_or(0.0);
    let step_s = run.step_s;
    let fixed = |signal| Some(Columns::Fixed(signal));
    let changed = |effort: &[f64]| changed(what, shape, effort, run);
    match (what, run.plant, run.brake()) {
        // Of a bench the brake or simulated effort alone is weaker: its stated friction is beside it.
        (Drive::Gain, PlantKind::Bench, _) => Some(Columns::Free(vec![run.known()])),
        (Drive::Gain, ..) => Some(Columns::Free(vec![known_effort(run)])),
        (_, PlantKind::Axis, _) => fixed(missing_effort(run, &changed(&run.effort))),
        // The yield torque of a brake lags, the sign of its torque does not (decision 0001).
        (Drive::Lag, PlantKind::Bench, Some((predicted, _))) => {
            fixed(less(&lagged_yield(predicted, step_s, value), predicted))
        }
        // The whole metered effort is late, the described friction included.
        (Drive::Skew, PlantKind::Bench, _) => {
            let mut known = run.known();
            add(&mut known, &seen(run, described(run, false)), 1.0);
            fixed(less(&changed(&known), &known))
        }
        (_, PlantKind::Bench, Some((predicted, _))) => fixed(less(&changed(predicted), predicted)),
        (_, PlantKind::Bench, None) => None,
    }
}

/// The columns of a change of the drive, linearised about the effort that the other terms give.
fn linearised(run: &JointRun, what: Drive, shape: &[f64], fitted: &[f64]) -> Option<Columns> {
    let value = shape.first().copied().unwrap_or(0.0);
    let step_s = run.step_s;
    let is_known = !matches!(run.inertia, Inertia::Unknown(_));
    let fixed = |signal| Some(Columns::Fixed(signal));
    match (what, run.plant) {
        (Drive::Limit | Drive::Rate, _) => None,
        (Drive::Gain, _) if is_known => drive(run, what, shape),
        (Drive::Gain, _) => None,
        // With a known inertia the command itself is delayed. It is less noisy than an
        // acceleration.
        (_, PlantKind::Axis) if is_known => drive(run, what, shape),
        // Otherwise the command leads the effort that moves the joint: gain·u = e +
        // time_constant·de/dt.
        (Drive::Lag, PlantKind::Axis) => {
            let slope = gradient(fitted, step_s);
            fixed(slope.into_iter().map(|s| value * s).collect())
        }
        (Drive::Skew, PlantKind::Axis) => fixed(less(&shifted(fitted, value / step_s), fitted)),
        (Drive::Lag, PlantKind::Bench) if run.brake().is_some() => drive(run, what, shape),
        (Drive::Lag, PlantKind::Bench) => fixed(less(&lagging(run, fitted, value), fitted)),
        (Drive::Skew, PlantKind::Bench) => fixed(less(&shifted(fitted, -value / step_s), fitted)),
    }
}
