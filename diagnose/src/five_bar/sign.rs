//! This file finds a component of the force that was recorded with the wrong sign.

use super::columns::driving;
use super::run::FiveBarRun;
use crate::align::Fault;
use crate::problem::{Problem, less};
use crate::select::usable_rms;

/// What the other sign must leave of the unexplained effort to be believed. With the right sign turning a component adds twice its effort.
const LEFT: f64 = 0.5;

/// # Errors
/// The model balances a component of the force far better when its sign is turned.
pub fn check(run: &FiveBarRun, problem: &Problem) -> Result<(), Fault> {
    let left = |run: &FiveBarRun| {
        let target = less(&driving(run), &problem.known);
        usable_rms(problem, &problem.windows.average(&target))
    };
    let own = left(run);
    for (axis, channel) in ["force_x", "force_y"].into_iter().enumerate() {
        let mut turned = run.clone();
        for force in turned.force.iter_mut().skip(axis).take(1).flatten() {
            *force = -*force;
        }
        let other = left(&turned);
        if other < LEFT * own {
            return Err(Fault {
                channel,
                from_s: 0.0,
                to_s: run.duration_s(),
                reason: format!(
                    "with the other sign {other:.3e} N·m stay unexplained, with this one {own:.3e} N·m: the channel has the wrong sign (set `sign = -1`)"
                ),
            });
        }
    }
    Ok(())
}
