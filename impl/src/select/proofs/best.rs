//! This file holds what is claimed about the finite core: which of four brakes comes first.

use rigproof_spec::joint::Joint;
use rigproof_spec::laws::influence_rank;

use crate::claim::Checker;
use crate::claims;
use crate::number::Scalar;
use crate::select::{Candidate, GREATEST_INPUT, best, closer};

/// Four candidates, each absent or of one of three ranks and one of four closenesses: every order that four brakes can have.
fn four<C: Checker>(c: &mut C) -> [Option<Candidate<C::Number>>; 4] {
    [0; 4].map(|_| {
        let (rank, level) = (c.choice(4), c.choice(4));
        (rank < 3).then(|| Candidate {
            rank,
            component: C::Number::of(f64::from(level) - 1.0),
            length_squared: C::Number::of(1.0),
        })
    })
}

/// What a gated selection compares.
fn compared<C: Checker>(c: &mut C) -> Option<Candidate<C::Number>> {
    let (component, length_squared) = (c.scalar(), c.scalar());
    let greatest = C::Number::of(4.0 * GREATEST_INPUT * GREATEST_INPUT);
    c.assume(component.is_within(greatest) && length_squared.is_within(greatest))?;
    c.assume(length_squared >= C::Number::of(crate::select::LEAST_ROW_SQUARED_PER_M2))?;
    Some(Candidate {
        rank: 0,
        component,
        length_squared,
    })
}

claims! {
    /// Of four brakes the one of the lowest rank comes first, among those the closest, among those the first in the order A, E, B, C; none
    /// comes first where none may act.
    /// Source: §6.3, decision 0041. Assumes nothing: ranks, absences and orders are all there are.
    Finite fn the_first_brake_is_the_best_of_four(c) {
        let four = four(c);
        let first = best(four);
        c.cover("none", first.is_none());
        c.cover("the last", first == Some(Joint::C));
        let ranked = |candidate: &Candidate<C::Number>| (candidate.rank, candidate.component);
        let before = |one: &Candidate<C::Number>, other: &Candidate<C::Number>| {
            let ((rank, component), (other_rank, other_component)) = (ranked(one), ranked(other));
            rank < other_rank || (rank == other_rank && component > other_component)
        };
        let mut passed = false;
        for (joint, candidate) in Joint::ALL.into_iter().zip(four) {
            let is_first = first == Some(joint);
            let Some(candidate) = candidate else {
                c.check(!is_first)?;
                continue;
            };
            c.check(first.is_some())?;
            for (other_joint, other) in Joint::ALL.into_iter().zip(four) {
                let Some(other) = other else { continue };
                let tied = !before(&candidate, &other) && !before(&other, &candidate);
                c.check(!is_first || !before(&other, &candidate))?;
                c.check(!is_first || !tied || joint <= other_joint)?;
            }
            passed |= is_first;
        }
        c.check(passed == first.is_some())?;
    }

    /// The three printed pairs of influence come in the printed order, and no other pair of the nine may act.
    /// Source: §6.3, (6.12).
    Finite fn influences_rank_as_printed(c) {
        let sign = |choice: u8| [-1_i8, 0, 1].into_iter().nth(usize::from(choice)).unwrap_or(0);
        let (along, across) = (sign(c.choice(3)), sign(c.choice(3)));
        let rank = influence_rank([along, across]);
        c.cover("may act", rank.is_some());
        c.cover("may not", rank.is_none());
        c.check(rank.is_some() == (across == -1))?;
        c.check(rank.is_none_or(|rank| i8::try_from(rank) == Ok(1 - along)))?;
    }

    /// Of two vectors of any small whole components and squares of lengths the one of the greater cosine is closer, whatever their lengths.
    /// Source: §6.3. Assumes numbers that are computed exactly.
    Finite fn closeness_is_the_cosine(c) {
        let (one, other) = (i32::from(c.choice(9)) - 4, i32::from(c.choice(9)) - 4);
        let (one_squared, other_squared) = (1 + i32::from(c.choice(5)), 1 + i32::from(c.choice(5)));
        let of = |component: i32, squared: i32| Candidate {
            rank: 0,
            component: C::Number::of(f64::from(component)),
            length_squared: C::Number::of(f64::from(squared)),
        };
        let (left, right) = (one * one * other_squared, other * other * one_squared);
        let expected = match (one.signum(), other.signum()) {
            (1, 1) => left > right,
            (-1, -1) => left < right,
            (sign, other_sign) => sign > other_sign,
        };
        c.cover("closer", expected);
        c.cover("not closer", !expected);
        c.check(closer(&of(one, one_squared), &of(other, other_squared)) == expected)?;
    }

    /// No brake is closer than itself, and of two brakes at most one is closer.
    /// Source: none in the thesis. Assumes what the gate leaves.
    Numbers fn closeness_is_an_order_of_two(c) {
        let (one, other) = (compared(c)?, compared(c)?);
        let (forth, back) = (closer(&one, &other), closer(&other, &one));
        c.cover("the one is closer", forth);
        c.cover("neither is", !forth && !back);
        c.check(!(forth && back))?;
        c.check(!closer(&one, &one))?;
    }

    /// A force that points along the desired direction is never less close than one that points against it.
    /// Source: §6.3. Assumes what the gate leaves.
    Numbers fn against_is_never_closer_than_along(c) {
        let (one, other) = (compared(c)?, compared(c)?);
        let zero = C::Number::zero();
        c.assume(one.component >= zero && other.component <= zero)?;
        c.cover("clearly", closer(&one, &other));
        c.check(!closer(&other, &one))?;
    }

    /// Of two vectors of one length the one that reaches less far along the desired direction is never the closer one.
    /// Source: §6.3. Assumes what the gate leaves. That rounded products keep the order of their factors is the engine's (`order.rs`), not the
    /// solver's, which took more than 100 s of a single one.
    Numbers fn less_far_is_never_closer(c) {
        let (one, mut other) = (compared(c)?, compared(c)?);
        other.length_squared = one.length_squared;
        c.assume(one.component >= other.component)?;
        c.cover("clearly", closer(&one, &other));
        c.check(!closer(&other, &one))?;
    }

    /// The squares by which closeness is compared neither overflow nor become undefined.
    /// Source: none in the thesis. Assumes what the gate leaves.
    Numbers fn closeness_is_finite(c) {
        let (one, other) = (compared(c)?, compared(c)?);
        let square = one.component * one.component.magnitude();
        c.cover("against", square < C::Number::zero());
        c.cover("along", square > C::Number::zero());
        let greatest = c.greatest();
        c.check((square * other.length_squared).is_within(greatest))?;
    }
}
