//! This file finds descriptions of a plant of one joint that its recording contradicts: a brake that is none, a drive of another unit or sign.

use super::columns::is_of_brake;
use super::from_rig;
use super::run::JointRun;
use crate::align::Fault;
use crate::evidence::coefficients_by_term;
use crate::problem::Problem;
use crate::rules::ANOTHER_UNIT;
use crate::select::{Selection, refs};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::Rig;

/// Something that only a brake does in the description of a plant without a brake and its current.
pub fn without_brake(rig: &Rig, run: &JointRun) -> Option<Fault> {
    let effects = from_rig::nominal(rig);
    let effect = effects
        .iter()
        .find(|n| is_of_brake(n.cause.mechanism) && run.brake().is_none())?;
    Some(Fault {
        channel: "effect",
        from_s: 0.0,
        to_s: 0.0,
        reason: format!(
            "`{}` is something that a brake does; take it out, or describe the brake and its current",
            effect.cause.mechanism.name()
        ),
    })
}

/// A gain error of more than the whole gain is a channel with the wrong sign; a gain of another size is no physics.
pub fn another_drive(problem: &Problem, selection: &Selection) -> Option<Fault> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let terms = refs(&selection.nominal, &selection.found);
    let fraction = terms
        .iter()
        .zip(&coefficients)
        .find(|(term, _)| term.cause.mechanism == Mechanism::GainError)
        .and_then(|(_, own)| own.first().copied())?;
    // The column is the known effort: y = e + c·e, so that the applied gain is 1/(1 + c) of the stated one.
    let gain = 1.0 - fraction / (1.0 + fraction);
    let reason = if gain < 0.0 {
        "the plant answers against its drive: the command, the force or the position has the wrong sign (set `sign = -1`), or the two channels are swapped".to_owned()
    } else if !(1.0 / ANOTHER_UNIT..ANOTHER_UNIT).contains(&gain) {
        format!(
            "the plant answers as if its drive were {gain:.3} times what is described: the unit of the position or of the command is another one (degrees for radians make 57.3 or 0.0175, thousandths 1000 or 0.001), or the two channels are swapped; correct the description"
        )
    } else {
        return None;
    };
    let clock = problem.run.clock();
    Some(Fault {
        channel: "drive",
        from_s: clock.start_s,
        to_s: clock.start_s + clock.duration_s(),
        reason,
    })
}
