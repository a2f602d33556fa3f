//! This file finds channels that are not what the description takes them for: a force component
//! with the wrong sign, swapped components, currents of brakes in another order.

use super::columns::{driving, known};
use super::from_rig::nominal_yields;
use super::run::{FiveBarRun, place};
use crate::align::Fault;
use crate::evidence::{coefficients_by_term, parameters};
use crate::plant::Run;
use crate::problem::{Problem, less};
use crate::rules::{ANOTHER_UNIT, READING_LEFT, READING_ODD};
use crate::selection::{Selection, usable_rms};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;

/// # Errors
/// The model balances the recording far better when channels are read in another way.
pub fn check(run: &FiveBarRun, problem: &Problem) -> Result<(), Fault> {
    let driving = driving(run, run.forces());
    let own = left(problem, &driving, &problem.known);
    force(run, problem, own)?;
    currents(run, problem, own, &driving)
}

/// # Errors
/// The found gain of the force sensor is beyond any real sensor's.
pub fn check_found(problem: &Problem, selection: &Selection) -> Result<(), Fault> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let found = coefficients.iter().skip(selection.nominal.len());
    let gains = selection
        .found
        .iter()
        .zip(found)
        .filter_map(|(found, own)| {
            let is_gain = found.term.cause.mechanism == Mechanism::ForceGain;
            let numbers = parameters(problem, &found.term, own);
            is_gain.then(|| numbers.first().copied().unwrap_or(0.0))
        });
    let mut impossible =
        gains.filter(|gain| !(1.0 / ANOTHER_UNIT..ANOTHER_UNIT).contains(&(1.0 + gain)));
    let Some(gain) = impossible.next() else {
        return Ok(());
    };
    let clock = problem.run.clock();
    Err(Fault {
        channel: "force_x",
        from_s: clock.start_s,
        to_s: clock.start_s + clock.duration_s(),
        reason: format!(
            "the recorded force is {:.4} times what the brakes and the masses ask for: it is in another unit than described (mN for N make 1000), has the wrong sign, or is another channel; correct the description",
            1.0 + gain
        ),
    })
}

fn left(problem: &Problem, driving: &[f64], known: &[f64]) -> f64 {
    usable_rms(problem, &problem.windows.average(&less(driving, known)))
}

fn fault(channel: &'static str, run: &FiveBarRun, reason: String) -> Result<(), Fault> {
    Err(Fault {
        channel,
        from_s: 0.0,
        to_s: run.clock().duration_s(),
        reason,
    })
}

/// One way to read the components of the force.
struct Reading {
    channel: &'static str,
    how: &'static str,
    cure: &'static str,
    of: fn([f64; 2]) -> [f64; 2],
}

const WRONG_SIGN: &str = "the channel has the wrong sign (set `sign = -1`)";

/// The readings that are tried beside the described one.
const READINGS: [Reading; 3] = [
    Reading {
        channel: "force_x",
        how: "with the other sign",
        cure: WRONG_SIGN,
        of: |[x, y]| [-x, y],
    },
    Reading {
        channel: "force_y",
        how: "with the other sign",
        cure: WRONG_SIGN,
        of: |[x, y]| [x, -y],
    },
    Reading {
        channel: "force_x",
        how: "with force_x and force_y swapped",
        cure: "give each its own column in the description",
        of: |[x, y]| [y, x],
    },
];

/// `own` is the residual as described.
fn force(run: &FiveBarRun, problem: &Problem, own: f64) -> Result<(), Fault> {
    let readings = READINGS.iter().map(|reading| {
        let driving = driving(run, run.forces().map(reading.of));
        (left(problem, &driving, &problem.known), reading)
    });
    match readings.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
        Some((other, reading)) if other < READING_LEFT * own => {
            let Reading {
                channel, how, cure, ..
            } = reading;
            let reason = format!(
                "{how} {other:.3e} N·m stay unexplained, as described {own:.3e} N·m: {cure}"
            );
            fault(channel, run, reason)
        }
        _ => Ok(()),
    }
}

/// Tries the currents in other orders, if the residual is large.
fn currents(run: &FiveBarRun, problem: &Problem, own: f64, driving: &[f64]) -> Result<(), Fault> {
    let size = usable_rms(problem, &problem.windows.average(driving));
    if own < READING_ODD * size {
        return Ok(());
    }
    let brakes = run.parameters.layout.brakes();
    let best = orders(brakes)
        .into_iter()
        .map(|order| {
            (
                left(problem, driving, &known(&with_order(run, brakes, &order))),
                order,
            )
        })
        .min_by(|(a, _), (b, _)| a.total_cmp(b));
    match best {
        Some((other, order)) if other < READING_LEFT * own => {
            let letters = |joints: &[Joint]| {
                joints
                    .iter()
                    .map(|j| j.letter())
                    .collect::<Vec<_>>()
                    .join(", ")
            };
            let reason = format!(
                "taken for those of {} the currents leave {own:.3e} N·m unexplained, taken for those of {} {other:.3e} N·m: correct the columns of the currents in the description",
                letters(brakes),
                letters(&order)
            );
            fault("current", run, reason)
        }
        _ => Ok(()),
    }
}

/// The run with the current of brake `brakes[i]` given to `order[i]`.
fn with_order(run: &FiveBarRun, brakes: &[Joint], order: &[Joint]) -> FiveBarRun {
    let mut other = run.clone();
    for (from, to) in brakes.iter().zip(order) {
        let current = run.currents.get(place(*from)).cloned().flatten();
        if let Some(slot) = other.currents.get_mut(place(*to)) {
            *slot = current;
        }
    }
    for joint in brakes {
        let yields = nominal_yields(&other, *joint);
        if let (Some(slot), Some(yields)) = (other.yields.get_mut(place(*joint)), yields) {
            *slot = yields;
        }
    }
    other
}

/// Every permutation of the joints but the identity.
fn orders(joints: &[Joint]) -> Vec<Vec<Joint>> {
    let mut all = vec![Vec::new()];
    for _ in joints {
        all = all
            .iter()
            .flat_map(|begun: &Vec<Joint>| {
                let rest = joints.iter().filter(|joint| !begun.contains(joint));
                rest.map(|joint| [begun.as_slice(), &[*joint]].concat())
            })
            .collect();
    }
    all.retain(|order| order != joints);
    all
}
