//! This file holds what is claimed about one brake under proportional control (§6.3).

use rigproof_spec::laws;
use rigproof_spec::methods::{NO_INFLUENCE, STANDING};

use super::gated;
use crate::claims;
use crate::number::Scalar;
use crate::select::proportional::{classify, opposing};
use crate::select::{GREATEST_INPUT, LEAST_ROW_SQUARED_PER_M2};

claims! {
    /// The force of a brake takes power from the tip, as computed and exactly, and that power is finite.
    /// Source: §6.3, (6.11). Assumes the gate.
    //= thesis (6.11) proof
    Numbers fn the_force_of_a_brake_opposes_the_velocity(c) {
        let (row, velocity, _) = gated(c)?;
        let force = opposing(row, velocity);
        c.cover("a joint that turns", force.is_some());
        c.cover("a joint that stands", force.is_none());
        if let Some(force) = force {
            c.check(laws::opposes(force.into(), velocity.into()))?;
            let greatest = c.greatest();
            c.check(force.dot(velocity).is_within(greatest))?;
        }
    }

    /// Any torque up to 10 N·m against its joint's rate takes power from the joint: τ·ω ≤ 0, rounding included.
    /// Source: §5.3.4. Assumes a finite rate.
    Numbers fn a_torque_against_the_rate_gives_no_power(c) {
        let (torque, rate) = (c.scalar(), c.scalar());
        let zero = C::Number::zero();
        c.assume(zero <= torque && torque <= Scalar::of(10.0))?;
        let greatest = c.greatest();
        c.assume(rate.is_within(greatest))?;
        let on_shaft = if rate > zero { -torque } else { torque };
        c.cover("forwards", rate > zero);
        c.cover("backwards", rate < zero);
        c.check(on_shaft * rate <= zero)?;
    }

    /// A joint that stands, its rate at most a ten-thousandth of the greatest that it can have at this speed, is never actuated.
    /// Source: (6.11) and its gap. Assumes the gate.
    Numbers fn a_standing_joint_is_not_actuated(c) {
        let (row, velocity, desired) = gated(c)?;
        let rate = row.dot(velocity);
        let least = C::Number::of(STANDING * STANDING) * row.norm_squared();
        let turns = rate * rate > least * velocity.norm_squared();
        c.cover("a joint that stands", !turns);
        c.cover("a joint that turns", turns);
        c.check(turns || classify(row, velocity, desired.direction).is_none())?;
    }

    /// A brake that may act takes from the unwanted component of velocity, and its rank tells what it does to the desired one:
    /// [1, −1], [0, −1] or [−1, −1], never another pair.
    /// Source: (6.12). Assumes the gate.
    //= thesis (6.12) proof
    Numbers fn only_the_three_printed_influences_act(c) {
        let (row, velocity, desired) = gated(c)?;
        let candidate = classify(row, velocity, desired.direction);
        c.cover("nothing", candidate.is_none());
        for (class, rank) in [("[1, -1]", 0), ("[0, -1]", 1), ("[-1, -1]", 2)] {
            c.cover(class, candidate.is_some_and(|candidate| candidate.rank == rank));
        }
        let (Some(candidate), Some(force)) = (candidate, opposing(row, velocity)) else {
            c.check(candidate.is_none())?;
            return Some(());
        };
        let zero = C::Number::zero();
        let (along, across) = (desired.direction.dot(force), desired.direction.cross(force));
        let wanted = desired.direction.dot(velocity);
        let unwanted = desired.direction.cross(velocity);
        c.check((across < zero && unwanted > zero) || (across > zero && unwanted < zero))?;
        let increases = (along > zero) == (wanted >= zero);
        let none = along * along < C::Number::of(NO_INFLUENCE * NO_INFLUENCE) * row.norm_squared();
        c.check(candidate.rank == if none { 1 } else if increases { 0 } else { 2 })?;
    }

    /// A brake that turns and takes from the unwanted component clearly is never passed over.
    /// Source: (6.12). Assumes the gate.
    Numbers fn no_brake_that_helps_is_passed_over(c) {
        let (row, velocity, desired) = gated(c)?;
        let zero = C::Number::zero();
        let force = opposing(row, velocity);
        let helps = force.is_some_and(|force| {
            let across = desired.direction.cross(force);
            let unwanted = desired.direction.cross(velocity);
            across * across >= row.norm_squared()
                && ((across < zero && unwanted > zero) || (across > zero && unwanted < zero))
        });
        c.cover("a brake that helps", helps);
        c.cover("a brake that does not", !helps);
        c.check(!helps || classify(row, velocity, desired.direction).is_some())?;
    }

    /// What a brake is compared by is finite, and its length is not nothing.
    /// Source: none in the thesis. Assumes the gate.
    Numbers fn a_brake_that_may_act_is_compared_by_finite_numbers(c) {
        let (row, velocity, desired) = gated(c)?;
        let candidate = classify(row, velocity, desired.direction);
        c.cover("a brake that may act", candidate.is_some());
        if let Some(candidate) = candidate {
            let greatest = C::Number::of(4.0 * GREATEST_INPUT * GREATEST_INPUT);
            c.check(candidate.component.is_within(greatest))?;
            c.check(candidate.length_squared.is_within(greatest))?;
            c.check(candidate.length_squared >= C::Number::of(LEAST_ROW_SQUARED_PER_M2))?;
        }
    }
}
