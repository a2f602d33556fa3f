//! This file lists the causes that are candidates on a recording of the five-bar, with their places
//! and shapes.

use super::run::{FiveBarRun, at, joint_at, place};
use crate::candidates::{
    both_signs, current_limits, fastest, geometric, in_numbers, longest_period, of_a_turn,
    periodic_part, periods, plays, stops, stribeck_shapes,
};
use crate::cause::{Cause, Place};
use crate::filter::ends;
use crate::plant::Run;
use crate::rules::{
    ANCHORS, BENDS_FIVE_BAR, CLOSING_A, DELAYS, DELAYS_RAD, LAGS_FIVE_BAR, LEAST_BEND,
    LEAST_BEND_SIGMAS, LEAST_LAG_STEPS, LEAST_SHIFT_STEPS_FIVE_BAR, MOST_BEND, MOST_DELAY_S,
    MOST_LAG_S_FIVE_BAR, MOST_OF_AN_ENCODER, MOST_SHIFT_S_FIVE_BAR, MOST_SHIFT_STEPS,
    NEAREST_ANCHOR, PEAK_EXPONENTS_FIVE_BAR, SHIFTS_FIVE_BAR, SOFTEST_BRISTLE, WIDEST_PEAK,
};
use crate::weak::Windows;
use rigproof_model::effects::facts::{Family, Shapes, Where};
use rigproof_model::effects::{Entry, Form, LIBRARY, OfSensor, entry, facts, form};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use std::f64::consts::TAU;

/// The causes that have a meaning on this layout.
pub fn causes(run: &FiveBarRun) -> Vec<Cause> {
    let braked = run.parameters.layout.brakes();
    let places = [
        Where::Brakes,
        Where::Bearings,
        Where::Joints,
        Where::Encoders,
        Where::Whole,
    ];
    let bearings: Vec<Joint> = Joint::ALL
        .into_iter()
        .filter(|joint| !braked.contains(joint))
        .collect();
    let asked = |place: Where, mechanism| -> Vec<Cause> {
        let joints = match place {
            Where::Nowhere => return Vec::new(),
            Where::Whole => return vec![Cause::of(mechanism)],
            Where::Brakes => braked,
            Where::Bearings => &bearings,
            Where::Joints => &Joint::ALL,
            Where::Encoders => &[Joint::A, Joint::B],
        };
        joints.iter().map(|joint| at(mechanism, *joint)).collect()
    };
    let of = |place| {
        let entries = LIBRARY.iter();
        let mut own: Vec<&Entry> = entries
            .filter(|entry| entry.facts.asked.five_bar == place)
            .collect();
        own.sort_by_key(|entry| entry.facts.turn);
        own.into_iter()
            .flat_map(move |entry| asked(place, entry.mechanism))
    };
    let single: Vec<Cause> = places.into_iter().flat_map(of).collect();
    single.iter().copied().chain(composed(&single)).collect()
}

/// Variants of the causes at single places: shared by every brake, as a share of a brake's torque,
/// or on one axis of a sensor.
fn composed(single: &[Cause]) -> Vec<Cause> {
    let mut all: Vec<Cause> = Vec::new();
    // Brakes of one make have one friction; a constant force is each joint's own, in size and sign.
    let of_a_make = |cause: &&Cause| {
        facts(cause.mechanism).is_some_and(|facts| {
            facts.asked.five_bar == Where::Brakes && facts.family != Family::Constant
        })
    };
    for cause in single.iter().filter(of_a_make) {
        let shared = Cause::at(cause.mechanism, Place::Every);
        if !all.contains(&shared) {
            all.push(shared);
        }
    }
    let is_share = |own: &&Cause| facts(own.mechanism).is_some_and(|facts| facts.of_torque);
    let shares = single.iter().chain(&all).filter(is_share);
    let shares: Vec<Cause> = shares.map(|own| own.of_torque()).collect();
    all.extend(shares);
    let gains = single
        .iter()
        .filter(|own| matches!(form(own.mechanism), Some(Form::Sensor(OfSensor::ForceGain))));
    let gains =
        gains.flat_map(|own| [0, 1].map(|axis| Cause::at(own.mechanism, Place::Axis(axis))));
    all.extend(gains);
    all
}

/// The place whose motion is used for the shapes of a cause. For a cause of every brake it is the
/// joint that travels most.
fn standing_for(run: &FiveBarRun, at: Place) -> Place {
    match at {
        Place::Every => {
            let brakes = run.parameters.layout.brakes().iter();
            let places = brakes.map(|joint| super::run::place_of(Some(*joint)));
            let most = places.max_by(|a, b| run.travel(*a).total_cmp(&run.travel(*b)));
            most.unwrap_or(Place::Whole)
        }
        other => other,
    }
}

/// Trial anchors of a spring on circles around the middle of the tip's motion, m.
fn anchors(run: &FiveBarRun) -> Vec<Vec<f64>> {
    let [(x, wide), (y, high)] = [0, 1].map(|axis| {
        let tips = run.poses.iter();
        let [low, high] = ends(tips.filter_map(|pose| pose.tip_m.get(axis).copied()));
        (0.5 * (low + high), high - low)
    });
    let [distances, directions] = ANCHORS;
    let arms = run.parameters.arms;
    let nearest = NEAREST_ANCHOR * wide.max(high);
    let farthest = (arms.l_ae_m + arms.l_ed_m).max(nearest);
    let around = (0..directions).map(|k| TAU * k as f64 / directions as f64);
    around
        .flat_map(|angle| {
            let distances = geometric(nearest, farthest, distances);
            let (sine, cosine) = libm::sincos(angle);
            distances
                .into_iter()
                .map(move |far| vec![x + far * cosine, y + far * sine])
        })
        .collect()
}

/// The bounds of the first shape parameter, where they lie beyond the grid.
pub fn reach(run: &FiveBarRun, cause: Cause) -> Option<(f64, f64)> {
    let cause = Cause {
        at: standing_for(run, cause.at),
        ..cause
    };
    let entry = entry(cause.mechanism)?;
    if entry.form.is_of_encoder() {
        return Some((-MOST_OF_AN_ENCODER, MOST_OF_AN_ENCODER));
    }
    match entry.facts.shapes {
        Shapes::Peak => {
            let fastest = fastest(run.motion(cause.at));
            let slowest = stribeck_shapes(run.speed_floor, fastest, &PEAK_EXPONENTS_FIVE_BAR)
                .into_iter()
                .next()?;
            Some((slowest.first().copied()?, WIDEST_PEAK * fastest))
        }
        Shapes::Bristle => {
            let travel = run.travel(cause.at).max(1e-12);
            Some((least_bending(run, travel), SOFTEST_BRISTLE * travel))
        }
        _ => None,
    }
}

/// The least angle of presliding that can be observed, rad.
fn least_bending(run: &FiveBarRun, travel: f64) -> f64 {
    (LEAST_BEND_SIGMAS * run.theta_noise).max(LEAST_BEND * travel)
}

/// The angle of a cause's joint at each usable window, and the residual there as a torque of that
/// joint.
fn points(run: &FiveBarRun, cause: Cause, windows: &Windows, residual: &[f64]) -> Vec<(f64, f64)> {
    let Some(joint) = joint_at(cause.at) else {
        return Vec::new();
    };
    let rows: Vec<[f64; 2]> = run.joint_rows(joint).collect();
    let pairs = windows.centres.chunks(2).zip(residual.chunks(2));
    let pairs = pairs.zip(windows.usable.chunks(2));
    pairs
        .filter(|(_, usable)| usable.iter().all(|u| *u))
        .filter_map(|((centres, residual), _)| {
            let centre = *centres.first()?;
            let (row, now) = (rows.get(centre)?, run.motion_of(joint).get(centre)?);
            let along: f64 = row.iter().zip(residual).map(|(g, r)| g * r).sum();
            Some((now.position, periodic_part(cause, now, along)))
        })
        .collect()
}

/// Trial limits of the current of a cause's brake, A.
fn limits(run: &FiveBarRun, cause: Cause) -> Vec<Vec<f64>> {
    let joint = joint_at(cause.at);
    let current = joint.and_then(|joint| run.currents.get(place(joint))?.as_ref());
    current.map_or(Vec::new(), |current| {
        current_limits(current, GREATEST_CURRENT_A)
    })
}

/// The trial shapes of a cause.
pub fn shapes(
    run: &FiveBarRun,
    cause: Cause,
    windows: &Windows,
    residual: &[f64],
) -> Vec<Vec<f64>> {
    let cause = Cause {
        at: standing_for(run, cause.at),
        ..cause
    };
    let motion = run.motion(cause.at);
    let one = |values: Vec<f64>| values.into_iter().map(|v| vec![v]).collect();
    match facts(cause.mechanism).map_or(Shapes::None, |facts| facts.shapes) {
        Shapes::Peak => stribeck_shapes(run.speed_floor, fastest(motion), &PEAK_EXPONENTS_FIVE_BAR)
            .into_iter()
            .flat_map(|shape| {
                let behind = DELAYS_RAD.map(|travel| [&shape[..], &[travel]].concat());
                core::iter::once(shape).chain(behind)
            })
            .collect(),
        Shapes::Bristle => {
            let travel = run.travel(cause.at).max(1e-12);
            one(geometric(
                least_bending(run, travel),
                MOST_BEND * travel,
                BENDS_FIVE_BAR,
            ))
        }
        Shapes::Period => {
            let travel = run.travel(cause.at);
            let mut all = periods(cause, &points(run, cause, windows, residual), travel);
            all.extend(of_a_turn(longest_period(travel, cause)));
            one(all)
        }
        Shapes::Lag => one(geometric(
            LEAST_LAG_STEPS * run.step_s,
            MOST_LAG_S_FIVE_BAR,
            LAGS_FIVE_BAR,
        )),
        Shapes::Delay => one(geometric(run.step_s, MOST_DELAY_S, DELAYS)),
        Shapes::CurrentLimit => limits(run, cause),
        Shapes::CurrentPlay { low, high, count } => {
            plays(&geometric(low, high, count), &CLOSING_A, GREATEST_CURRENT_A)
        }
        Shapes::Shift => one(both_signs(geometric(
            LEAST_SHIFT_STEPS_FIVE_BAR * run.step_s,
            MOST_SHIFT_S_FIVE_BAR.max(MOST_SHIFT_STEPS * run.step_s),
            SHIFTS_FIVE_BAR,
        ))),
        // Not candidates on this plant.
        Shapes::Memory
        | Shapes::CommandExponent(_)
        | Shapes::EffortLimit
        | Shapes::EffortRate
        | Shapes::Pitch
        | Shapes::Gap
        | Shapes::OfTravel { .. }
        | Shapes::OfLoad { .. }
        | Shapes::Resonance
        | Shapes::BristleCurve => vec![vec![]],
        Shapes::Stop => stops(motion),
        Shapes::Anchor => anchors(run),
        own @ (Shapes::None
        | Shapes::Values(_)
        | Shapes::Geometric { .. }
        | Shapes::Edges { .. }
        | Shapes::Optional { .. }
        | Shapes::BothSigns { .. }) => in_numbers(own),
    }
}
