//! This file holds what is claimed about what leaves a tick.

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::claim::Checker;
use crate::claims;
use crate::command::Command;
use crate::guard::{SLACK_A, release};
use crate::number::Scalar;

/// Any reason that a law may give, of each kind one or more.
fn reason<C: Checker>(c: &mut C) -> Reason {
    let joint = |choice: u8| {
        Joint::ALL
            .into_iter()
            .nth(usize::from(choice))
            .unwrap_or(Joint::A)
    };
    match c.choice(4) {
        0 => Reason::Chosen(joint(c.choice(4))),
        1 => Reason::ChosenPair(joint(c.choice(4)), joint(c.choice(4))),
        2 => Reason::LockedPushedAway,
        _ => Reason::NoneHelps,
    }
}

/// Any command at all, and which joints have brakes.
fn asked<C: Checker>(c: &mut C) -> (Command<C::Number>, [bool; 4]) {
    let braked = [0; 4].map(|_| c.choice(2) == 1);
    let command = Command {
        currents_a: [0; 4].map(|_| c.scalar()),
        reason: reason(c),
    };
    (command, braked)
}

/// Whether a reason lets this joint's brake have current.
fn names(reason: Reason, joint: Joint) -> bool {
    match reason {
        Reason::Chosen(one) => one == joint,
        Reason::ChosenPair(one, other) => one == joint || other == joint,
        _ => reason.is_lock(),
    }
}

claims! {
    /// Whatever a law asks for, what leaves the tick is between none and the greatest current, on every brake.
    /// Source: §3.2, law `current_limit`. Assumes nothing.
    Numbers fn what_leaves_is_within_the_amplifiers(c) {
        let (command, braked) = asked(c);
        let released = release(command, braked);
        c.cover("refused", released.reason == Reason::RefusedCommand);
        c.cover("released", released.reason != Reason::RefusedCommand);
        for current_a in released.currents_a {
            c.check(C::Number::zero() <= current_a && current_a <= C::Number::of(GREATEST_CURRENT_A))?;
        }
    }

    /// A command that is not refused leaves as it was asked, clamped current by current, for the same reason.
    /// Source: law `clamped`. Assumes nothing.
    Numbers fn what_is_released_is_what_was_asked_clamped(c) {
        let (command, braked) = asked(c);
        let released = release(command, braked);
        let greatest_a = C::Number::of(GREATEST_CURRENT_A);
        c.cover("released", released.reason == command.reason);
        c.check(released.reason == command.reason || released.reason == Reason::RefusedCommand)?;
        for (asked_a, given_a) in command.currents_a.into_iter().zip(released.currents_a) {
            let expected_a = if released.reason == command.reason { asked_a } else { C::Number::zero() };
            c.check(laws::clamped(expected_a, given_a, greatest_a))?;
        }
    }

    /// An infinite or undefined current, wherever it stands, lets every brake go.
    /// Source: none in the thesis: law `undefined_input`. Assumes one such current.
    Numbers fn an_undefined_current_lets_every_brake_go(c) {
        let (mut command, braked) = asked(c);
        let place = c.choice(4);
        let value = c.scalar();
        let greatest = c.greatest();
        c.assume(!value.is_within(greatest))?;
        for (index, current_a) in (0..).zip(&mut command.currents_a) {
            if index == place {
                *current_a = value;
            }
        }
        c.cover("any place", true);
        let released = release(command, braked);
        c.check(released.reason == Reason::RefusedCommand)?;
        for current_a in released.currents_a {
            c.check(current_a == C::Number::zero())?;
        }
    }

    /// A current that lies beside the range by more than the slack, wherever it stands, lets every brake go.
    /// Source: none in the thesis: decision 0101. Assumes one such current.
    Numbers fn a_current_far_beside_the_range_lets_every_brake_go(c) {
        let (mut command, braked) = asked(c);
        let place = c.choice(4);
        let value = c.scalar();
        let (below, above) = (C::Number::of(-SLACK_A), C::Number::of(GREATEST_CURRENT_A + SLACK_A));
        c.assume(value < below || above < value)?;
        for (index, current_a) in (0..).zip(&mut command.currents_a) {
            if index == place {
                *current_a = value;
            }
        }
        c.cover("below", value < below);
        c.cover("above", above < value);
        let released = release(command, braked);
        c.check(released.reason == Reason::RefusedCommand)?;
        for current_a in released.currents_a {
            c.check(current_a == C::Number::zero())?;
        }
    }

    /// Current leaves only for brakes that are there and that the reason names: one, a pair, or all in a lock.
    /// Source: §6.1.2, laws `brake_count` and `braked_joints`. Assumes nothing.
    Numbers fn only_brakes_that_are_named_get_current(c) {
        let (command, braked) = asked(c);
        let released = release(command, braked);
        let silent = released.currents_a.map(|current_a| current_a == C::Number::zero());
        c.cover("current", silent.contains(&false));
        c.cover("none", !silent.contains(&false));
        for ((joint, braked), silent) in Joint::ALL.into_iter().zip(braked).zip(silent) {
            c.check(silent || braked && names(released.reason, joint))?;
        }
    }
}
