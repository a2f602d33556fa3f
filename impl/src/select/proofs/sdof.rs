//! This file holds what is claimed about one brake under SDOF control (§6.2).

use rigproof_spec::laws;

use super::gated;
use crate::claims;
use crate::number::Scalar;
use crate::select::sdof::classify;
use crate::select::{GREATEST_INPUT, LEAST_ROW_SQUARED_PER_M2};

claims! {
    /// A brake may act if one way along its local path lies in the quarter turn between the path's direction and the one towards it, and
    /// only then; it is compared by that way.
    /// Source: §6.2, (6.10). Assumes the gate.
    //= thesis (6.10) proof
    Numbers fn the_local_path_lies_in_the_quarter_turn(c) {
        let (row, _, desired) = gated(c)?;
        let towards = desired.towards?;
        let admissible = |path: crate::vector::Vector<C::Number>| {
            laws::in_quarter_turn(path.into(), desired.along.into(), towards.into())
        };
        let (forth, back) = (row.left(), -row.left());
        let candidate = classify(row, &desired, towards);
        c.cover("forth", admissible(forth));
        c.cover("back", admissible(back));
        c.cover("neither", !admissible(forth) && !admissible(back));
        match candidate {
            None => c.check(!admissible(forth) && !admissible(back))?,
            Some(candidate) => {
                let way = if admissible(forth) { forth } else { back };
                c.check(admissible(way))?;
                c.check(candidate.component == way.dot(desired.direction))?;
            }
        }
    }

    /// Moving along a brake's local path does not turn its joint: the computed rate is zero exactly. Nor has a row a part beside itself.
    /// Source: (6.10). Assumes the gate.
    Numbers fn the_local_path_leaves_its_joint_alone(c) {
        let (row, _, _) = gated(c)?;
        c.cover("any row", true);
        c.check(row.dot(row.left()) == C::Number::zero())?;
        c.check(row.cross(row) == C::Number::zero())?;
    }

    /// What a brake is compared by is finite, and its length is not nothing.
    /// Source: none in the thesis. Assumes the gate.
    Numbers fn a_local_path_is_compared_by_finite_numbers(c) {
        let (row, _, desired) = gated(c)?;
        let candidate = classify(row, &desired, desired.towards?);
        c.cover("a brake that may act", candidate.is_some());
        if let Some(candidate) = candidate {
            let greatest = C::Number::of(4.0 * GREATEST_INPUT * GREATEST_INPUT);
            c.check(candidate.rank == 0)?;
            c.check(candidate.component.is_within(greatest))?;
            c.check(candidate.length_squared.is_within(greatest))?;
            c.check(candidate.length_squared >= C::Number::of(LEAST_ROW_SQUARED_PER_M2))?;
        }
    }
}
