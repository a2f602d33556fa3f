//! This file says which causes are tried on a recording of the five-bar, where, and in which shapes.

use super::run::{FiveBarRun, at, joint_at, place};
use crate::candidates::{fastest, geometric, periods, stribeck_shapes};
use crate::cause::Cause;
use crate::plant::Run;
use crate::weak::Windows;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;

/// What can be left out at a joint with a brake.
const AT_BRAKES: [Mechanism; 17] = [
    Mechanism::DryOffset,
    Mechanism::ConstantBias,
    Mechanism::Viscous,
    Mechanism::GainError,
    Mechanism::DirectionAsymmetry,
    Mechanism::Stribeck,
    Mechanism::Presliding,
    Mechanism::ReversalOvershoot,
    Mechanism::Settling,
    Mechanism::Lag,
    Mechanism::DeadTime,
    Mechanism::Saturation,
    Mechanism::CurrentHysteresis,
    Mechanism::ThermalFade,
    Mechanism::LoadDependent,
    Mechanism::BacklashWidth,
    Mechanism::Ripple,
];

/// What can be left out of the linkage as a whole, and of its sensors.
const OF_THE_WHOLE: [Mechanism; 7] = [
    Mechanism::Gravity,
    Mechanism::Payload,
    Mechanism::InertiaError,
    Mechanism::ForceGain,
    Mechanism::ForceBias,
    Mechanism::ForceRotation,
    Mechanism::ChannelSkew,
];

/// Travels within which friction comes to the level of its speed, rad.
const DELAYS_RAD: [f64; 4] = [0.001, 0.01, 0.05, 0.2];

/// The angle by which a force sensor may be mounted askew, rad: a quarter of a right angle.
const MOST_TURNED_RAD: f64 = 0.39;

/// An encoder's scale may be off by this share, its zero by this angle in rad: what more it was is seen before anything is recorded.
const MOST_OF_AN_ENCODER: f64 = 0.1;

/// Share of the fastest speed up to which a peak near standstill is one: at the fastest a sixteenth of it is left.
const WIDEST_PEAK: f64 = 0.6;

/// Share of the travel over which a bristle may bend: over the whole of it all but a twentieth of its level is reached.
const SOFTEST_BRISTLE: f64 = 0.33;

/// The causes that have a meaning on this layout.
pub fn causes(run: &FiveBarRun) -> Vec<Cause> {
    let braked = run.parameters.layout.brakes();
    let brakes = AT_BRAKES
        .into_iter()
        .flat_map(|mechanism| braked.iter().map(move |joint| at(mechanism, *joint)));
    let bearings = Joint::ALL
        .into_iter()
        .filter(|joint| !braked.contains(joint))
        .map(|joint| at(Mechanism::BearingFriction, joint));
    let springs = Joint::ALL.map(|joint| at(Mechanism::Spring, joint));
    let encoders = [Mechanism::EncoderScale, Mechanism::EncoderOffset]
        .into_iter()
        .flat_map(|mechanism| [Joint::A, Joint::B].map(|joint| at(mechanism, joint)));
    brakes
        .chain(bearings)
        .chain(springs)
        .chain(encoders)
        .chain(OF_THE_WHOLE.map(Cause::of))
        .collect()
}

/// How far the first number of a cause's shape may go where that is beyond what is tried first.
pub fn reach(run: &FiveBarRun, cause: Cause) -> Option<(f64, f64)> {
    match cause.mechanism {
        Mechanism::EncoderScale | Mechanism::EncoderOffset => {
            Some((-MOST_OF_AN_ENCODER, MOST_OF_AN_ENCODER))
        }
        Mechanism::Stribeck => {
            let fastest = fastest(run.motion(cause.at));
            let slowest = stribeck_shapes(run.speed_floor, fastest)
                .into_iter()
                .next()?;
            Some((slowest.first().copied()?, WIDEST_PEAK * fastest))
        }
        Mechanism::Presliding | Mechanism::AsymmetricPresliding => {
            let travel = run.travel(cause.at).max(1e-12);
            Some((least_bending(run, travel), SOFTEST_BRISTLE * travel))
        }
        _ => None,
    }
}

/// The least angle over which a bristle is seen to bend, rad.
fn least_bending(run: &FiveBarRun, travel: f64) -> f64 {
    (3.0 * run.theta_noise).max(1e-4 * travel)
}

/// The angle of a cause's joint at each usable window, and the residual as a torque there.
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
            Some((now.position, along))
        })
        .collect()
}

/// Currents below the greatest one that a brake was given, A: where its amplifier may have stopped.
fn limits(run: &FiveBarRun, cause: Cause) -> Vec<f64> {
    let joint = joint_at(cause.at);
    let current = joint.and_then(|joint| run.currents.get(place(joint)));
    let given = current.into_iter().flatten().flatten().copied();
    let greatest = given.fold(0.0, f64::max);
    if greatest < 0.05 {
        return Vec::new();
    }
    geometric(0.3 * greatest, 0.97 * greatest, 8)
}

/// Half widths of a play, A, and the currents below which its sides come together, where they do.
fn plays() -> Vec<Vec<f64>> {
    let widths = geometric(0.01, 0.5, 7).into_iter();
    let open = widths.clone().map(|width| vec![width]);
    let closing = widths.flat_map(|width| CLOSING_A.map(|below| vec![width, below]));
    closing.chain(open).collect()
}

/// Currents below which the sides of a play come together, A: a little, most of the range, and beyond all that flows.
const CLOSING_A: [f64; 3] = [0.1, 0.4, 1.5];

/// The shapes of a cause that are tried.
pub fn shapes(
    run: &FiveBarRun,
    cause: Cause,
    windows: &Windows,
    residual: &[f64],
) -> Vec<Vec<f64>> {
    let motion = run.motion(cause.at);
    let one = |values: Vec<f64>| values.into_iter().map(|v| vec![v]).collect();
    match cause.mechanism {
        Mechanism::Stribeck => stribeck_shapes(run.speed_floor, fastest(motion))
            .into_iter()
            .flat_map(|shape| DELAYS_RAD.map(|travel| [&shape[..], &[travel]].concat()))
            .collect(),
        Mechanism::Presliding | Mechanism::AsymmetricPresliding => {
            let travel = run.travel(cause.at).max(1e-12);
            one(geometric(least_bending(run, travel), 0.2 * travel, 10))
        }
        Mechanism::Ripple => one(periods(
            &points(run, cause, windows, residual),
            run.travel(cause.at),
        )),
        Mechanism::ReversalOvershoot => one(geometric(0.01, 1.5, 6)),
        Mechanism::Settling => one(geometric(0.3, 30.0, 5)),
        Mechanism::Lag => one(geometric(0.5 * run.step_s, 0.25, 12)),
        Mechanism::DeadTime => one(geometric(run.step_s, 0.08, 8)),
        Mechanism::Saturation => one(limits(run, cause)),
        Mechanism::CurrentHysteresis => plays(),
        Mechanism::BacklashWidth => one(geometric(0.003, 0.12, 8)),
        Mechanism::ThermalFade => one(geometric(3.0, 300.0, 4)),
        Mechanism::ChannelSkew => {
            let sizes = geometric(0.25 * run.step_s, 0.04f64.max(4.0 * run.step_s), 10);
            one(sizes.iter().flat_map(|&s| [s, -s]).collect())
        }
        Mechanism::EncoderOffset => one(vec![0.01, -0.01, 0.06, -0.06]),
        Mechanism::EncoderScale => one(vec![0.005, -0.005, 0.04, -0.04]),
        Mechanism::ForceRotation => {
            let angles = geometric(0.003, MOST_TURNED_RAD, 8);
            one(angles.iter().flat_map(|&a| [a, -a]).collect())
        }
        _ => vec![vec![]],
    }
}
