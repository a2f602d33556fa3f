//! This file says what impedance control may answer where the wanted force lies along one brake's push.
//!
//! That brake makes the force alone, and rounding decides whether a pair of it and an idle brake makes it too, which brake is the idle one,
//! or whether no pair does. What such a pair asks for exists on that line alone, where a nudge hardly ever comes.

use nalgebra::Vector2;
use rigproof_model::brake::current_gain;
use rigproof_model::control::path::Nearest;
use rigproof_model::control::torque_translation::{Share, translate};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::{STANDING, STANDING_TIP_M_S};
use rigproof_spec::tables::brake_table;

use super::both::reference_rows;
use super::permitted::LAST_DIGITS;
use super::tick::Tick;
use crate::built_in::Kind;

/// Sine of the angle between force and push, and share of one torque in another, that count as none.
const NONE: f64 = 1e-12;
/// A force that is small beside every brake's, so that the shares of a pair are not scaled down, N.
const SMALL_N: f64 = 1e-6;

/// A brake and its row of the Jacobian, 1/m.
type Row = (Joint, Vector2<f64>);

/// What impedance control may answer where a brake makes a wanted force alone; nothing elsewhere. A joint that all but stands may turn
/// either way; `nearest` is how the tip lies to the path, of several points as near as told.
pub fn answers(tick: &Tick, nearest: &Nearest) -> Vec<Command> {
    let length_m_s = Vector2::from(tick.velocity_m_s).norm();
    let rows = reference_rows(tick).unwrap_or_default();
    let units = rows.iter().map(|row| row.normalize());
    let moves = units.flat_map(|unit| [unit, -unit]);
    let moves = moves.map(|unit| unit * (LAST_DIGITS * length_m_s));
    let all = core::iter::once(Vector2::zeros()).chain(moves);
    all.flat_map(|moved_m_s| {
        let mut tick = tick.clone();
        tick.velocity_m_s = (Vector2::from(tick.velocity_m_s) + moved_m_s).into();
        answers_as_told(&tick, nearest)
    })
    .collect()
}

fn answers_as_told(tick: &Tick, nearest: &Nearest) -> Vec<Command> {
    let (Some(wanted_n), Some(rows)) = (wanted_n(tick, nearest), reference_rows(tick)) else {
        return Vec::new();
    };
    let braked = |(joint, _): &Row| tick.layout.brakes().contains(joint);
    let rows: Vec<Row> = Joint::ALL.into_iter().zip(rows).filter(braked).collect();
    let mut answers = Vec::new();
    let mut otherwise = Command::none(Reason::NoneHelps);
    for force_n in wanted_n {
        let clear = clear_pair(&rows, tick, force_n);
        let least_nm = clear.map_or(f64::INFINITY, |(sum_nm, _)| sum_nm);
        let alone = rows.iter().filter(|(_, row)| {
            is_alone(row, tick, force_n) && SMALL_N / row.norm() <= least_nm * (1.0 + NONE)
        });
        for (joint, row) in alone {
            answers.extend(beside_an_idle_one(&rows, tick, (*joint, *row), force_n));
        }
        if let Some((_, joints)) = clear
            && let Some(shares) = pair(&rows, tick, joints, force_n)
        {
            otherwise = command(shares);
            break;
        }
    }
    if !answers.is_empty() {
        answers.push(otherwise);
    }
    answers
}

/// The commands to a brake that makes a force alone, each beside another idle one that does not stand and is not parallel.
fn beside_an_idle_one(
    rows: &[Row],
    tick: &Tick,
    (joint, row): Row,
    force_n: Vector2<f64>,
) -> Vec<Command> {
    let torque_nm = force_n.norm() / row.norm();
    let all = rows.iter().filter_map(|(other, _)| {
        // Exactly along the push, so that the other brake has exactly nothing to do.
        let shares = pair(rows, tick, [joint, *other], push(&row, tick))?;
        Some(command(shares.map(|share| Share {
            torque_nm: if share.joint == joint { torque_nm } else { 0.0 },
            ..share
        })))
    });
    all.collect()
}

/// The forces that are tried, N, as decision 0044 has them; `None` for another law, or where nothing is wanted.
fn wanted_n(tick: &Tick, nearest: &Nearest) -> Option<Vec<Vector2<f64>>> {
    let Kind::Impedance {
        stiffness_n_per_m,
        damping_across_n_s_per_m,
        damping_along_n_s_per_m,
    } = tick.law
    else {
        return None;
    };
    let velocity_m_s = velocity_m_s(tick);
    let tangent = nearest.tangent;
    let left = Vector2::new(-tangent.y, tangent.x);
    let across_n =
        stiffness_n_per_m * nearest.offset_m + damping_across_n_s_per_m * left.dot(&velocity_m_s);
    let across_n = left * -across_n;
    let along_n = tangent * (-damping_along_n_s_per_m * tangent.dot(&velocity_m_s));
    let all = [across_n + along_n, across_n, along_n];
    Some(
        all.into_iter()
            .filter(|force_n| force_n.norm() > 0.0)
            .collect(),
    )
}

/// The velocity of the tip, m/s; none of one that stands.
fn velocity_m_s(tick: &Tick) -> Vector2<f64> {
    let velocity_m_s = Vector2::from(tick.velocity_m_s);
    if velocity_m_s.norm() < STANDING_TIP_M_S {
        Vector2::zeros()
    } else {
        velocity_m_s
    }
}

/// The force of 1 N·m of a brake against its joint's motion, N; none of a joint at rest.
fn push(row: &Vector2<f64>, tick: &Tick) -> Vector2<f64> {
    let velocity_m_s = velocity_m_s(tick);
    let rate_rad_s = row.dot(&velocity_m_s);
    if rate_rad_s.abs() <= STANDING * row.norm() * velocity_m_s.norm() {
        Vector2::zeros()
    } else {
        row * -rate_rad_s.signum()
    }
}

/// Whether a brake's push is along a force.
fn is_alone(row: &Vector2<f64>, tick: &Tick, force_n: Vector2<f64>) -> bool {
    let push_n = push(row, tick);
    let product = push_n.norm() * force_n.norm();
    push_n.dot(&force_n) > 0.0 && push_n.perp(&force_n).abs() <= NONE * product
}

/// The shares of two brakes that make a force together, as the reference has them.
fn pair(
    rows: &[Row],
    tick: &Tick,
    joints: [Joint; 2],
    force_n: Vector2<f64>,
) -> Option<[Share; 2]> {
    let two: Vec<Row> = rows
        .iter()
        .filter(|(joint, _)| joints.contains(joint))
        .copied()
        .collect();
    translate(&two, velocity_m_s(tick), force_n)
}

/// The pair of which neither brake is idle with the least sum of torques, that sum, N·m, for a small force.
fn clear_pair(rows: &[Row], tick: &Tick, force_n: Vector2<f64>) -> Option<(f64, [Joint; 2])> {
    let small_n = force_n * (SMALL_N / force_n.norm());
    let joints = rows.iter().map(|(joint, _)| *joint);
    let twos = joints
        .clone()
        .flat_map(|one| joints.clone().map(move |other| [one, other]));
    let pairs = twos.filter_map(|joints| {
        let [one_nm, other_nm] = pair(rows, tick, joints, small_n)?.map(|share| share.torque_nm);
        let is_clear = one_nm.min(other_nm) > NONE * one_nm.max(other_nm);
        is_clear.then_some((one_nm + other_nm, joints))
    });
    pairs.min_by(|(one_nm, _), (other_nm, _)| one_nm.total_cmp(other_nm))
}

/// The command for two torques, N·m.
fn command(shares: [Share; 2]) -> Command {
    let [first, second] = shares.map(|share| share.joint);
    let mut command = Command::none(Reason::ChosenPair(first, second));
    for (joint, current_a) in Joint::ALL.into_iter().zip(&mut command.currents_a) {
        for share in shares.iter().filter(|share| share.joint == joint) {
            *current_a = current_gain(&brake_table(joint), share.torque_nm);
        }
    }
    command
}
