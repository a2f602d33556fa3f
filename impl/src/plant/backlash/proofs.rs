//! This file holds what is claimed about the backlash: a window as wide as it was, that only a shaft at its edge moves.

use super::{Backlash, target_nm};
use crate::claim::Checker;
use crate::claims;
use crate::number::Scalar;

/// Greatest angle and greatest width that the claims speak of, rad: a hundred turns, and one.
const GREATEST_RAD: f64 = 628.4;
const WIDEST_RAD: f64 = 6.3;
/// What rounding may cost at such angles, rad: f32 tells angles below 1024 rad apart by 6.2e-5 at most.
const SLACK_RAD: f64 = 2e-4;

/// A window after a turn of its shaft.
struct Turned<S> {
    before: Backlash<S>,
    after: Backlash<S>,
    to_rad: S,
    entry_rad: S,
}

/// Any window, entered after any travel, and any turn of its shaft.
fn turned<C: Checker>(c: &mut C) -> Option<Turned<C::Number>> {
    let (theta_1_rad, from_rad, to_rad) = (c.scalar(), c.scalar(), c.scalar());
    let (width_rad, entry_rad) = (c.scalar(), c.scalar());
    let (zero, greatest) = (C::Number::zero(), C::Number::of(GREATEST_RAD));
    c.assume(theta_1_rad.is_within(greatest))?;
    c.assume(from_rad.is_within(greatest) && to_rad.is_within(greatest))?;
    c.assume(zero <= width_rad && width_rad <= C::Number::of(WIDEST_RAD))?;
    c.assume(zero <= entry_rad && entry_rad <= width_rad)?;
    let before = Backlash {
        theta_1_rad,
        width_rad,
        inside: c.choice(2) == 1,
    };
    let mut after = before;
    after.pass(from_rad, to_rad, entry_rad);
    Some(Turned {
        before,
        after,
        to_rad,
        entry_rad,
    })
}

claims! {
    /// A shaft between its boundaries leaves both where they are, to the bit. It is inside once it is further than the travel of entry from
    /// both, and within that travel what it was.
    /// Source: §3.4.3, law `backlash_travel`, decision 0004. Assumes angles up to a hundred turns, a width up to one.
    Numbers fn between_the_boundaries_nothing_moves(c) {
        let Turned { before, after, to_rad, entry_rad } = turned(c)?;
        let [low, high] = before.boundaries_rad();
        c.cover("between", low < to_rad && to_rad < high);
        c.assume(low < to_rad && to_rad < high)?;
        c.check(after.theta_1_rad == low)?;
        let clear = to_rad - low > entry_rad && high - to_rad > entry_rad;
        c.check(after.inside == (clear || before.inside))?;
    }

    /// A shaft that reaches a boundary is not inside, and takes the window along the way it turns, never against it: the lower boundary then is
    /// at the shaft, or a width below it, as computed.
    /// Source: §3.4.3, laws `backlash_window` and `backlash_travel`. Assumes as above.
    Numbers fn a_shaft_at_a_boundary_takes_it_along(c) {
        let Turned { before, after, to_rad, .. } = turned(c)?;
        let [low, high] = before.boundaries_rad();
        c.cover("upwards", to_rad >= high);
        c.cover("downwards", to_rad <= low);
        c.assume(to_rad >= high || to_rad <= low)?;
        c.check(!after.inside)?;
        let [new_low, _] = after.boundaries_rad();
        if to_rad >= high {
            c.check(new_low == to_rad - before.width_rad)?;
            c.check(new_low >= high - before.width_rad)?;
        } else {
            c.check(new_low == to_rad && new_low <= low)?;
        }
    }

    /// However a shaft turns, its window stays a width wide, as computed, and it is inside only strictly between the boundaries.
    /// Source: §3.4.3, laws `backlash_width` and `backlash_window`. Assumes as above.
    Numbers fn a_shaft_is_inside_between_its_boundaries_only(c) {
        let Turned { before, after, to_rad, .. } = turned(c)?;
        let [low, high] = after.boundaries_rad();
        c.cover("inside", after.inside);
        c.cover("outside", !after.inside);
        c.check(after.width_rad == before.width_rad)?;
        c.check(high == low + before.width_rad)?;
        c.check(!after.inside || low < to_rad && to_rad < high)?;
    }

    /// What is so as computed is so of the angles, to rounding: the boundaries are a width apart, with the shaft between them.
    /// Source: §3.4.3, laws `backlash_width` and `backlash_window`. Assumes as above. Only sampled: of the error of three sums in a row the
    /// solver came to no end in 60 s.
    Sampled fn a_window_keeps_its_width_and_its_shaft(c) {
        let Turned { before, after, to_rad, .. } = turned(c)?;
        let ([low, high], slack) = (after.boundaries_rad(), C::Number::of(SLACK_RAD));
        c.cover("inside", after.inside);
        c.cover("outside", !after.inside);
        c.check((high - low - before.width_rad).is_within(slack))?;
        c.check(low - slack <= to_rad && to_rad <= high + slack)?;
    }

    /// Inside the backlash a brake is asked for its off-state torque, whatever its current asks for; outside for what its current asks for,
    /// within the off-state torque and the greatest.
    /// Source: §3.4.3, laws `backlash_torque` and `yield_limit`. Assumes an off-state torque of at most the greatest.
    Numbers fn inside_only_the_off_state_torque_is_asked_for(c) {
        let (asked, off_state, greatest) = (c.scalar(), c.scalar(), c.scalar());
        c.assume(C::Number::zero() <= off_state && off_state <= greatest)?;
        let inside = c.choice(2) == 1;
        let target = target_nm(inside, asked, [off_state, greatest]);
        c.cover("inside", inside);
        c.cover("outside", !inside);
        if inside {
            c.check(target == off_state)?;
        } else {
            let defined = asked <= greatest || asked > greatest;
            let between = off_state <= asked && asked <= greatest;
            c.check(!defined || off_state <= target && target <= greatest)?;
            c.check(!between || target == asked)?;
        }
    }
}
