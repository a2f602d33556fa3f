//! This file says which brake leads the tip along its own local path: the selection of §6.2.

use rigproof_spec::command::Reason;

use super::{Candidate, Decision, Desired, Rows, best, is_sound, pushes_away};
use crate::number::Scalar;
use crate::vector::Vector;

/// What SDOF control decides: nothing on the path or inside its gap; else the brake whose local path of a single degree of freedom lies closest
/// to the desired direction, between the direction of the path and the one towards it; else a lock if the operator pushes away.
///
/// `in_gap` is whether the tip is inside the gap; the other symbols are those of [`super::proportional::decide`].
#[inline]
pub fn decide<S: Scalar>(
    rows: &Rows<S>,
    force_n: Vector<S>,
    desired: &Desired<S>,
    in_gap: bool,
) -> Decision {
    if !is_sound(rows, &[force_n], desired) {
        return Decision::Rest(Reason::UndefinedInput);
    }
    let Some(towards) = desired.towards.filter(|_| !in_gap) else {
        return Decision::Rest(Reason::InsideGap);
    };
    let [a, e, b, c] = *rows;
    let candidate = |row: Option<Vector<S>>| classify(row?, desired, towards);
    match best([candidate(a), candidate(e), candidate(b), candidate(c)]) {
        Some(joint) => Decision::Act(joint),
        None if pushes_away(desired, force_n) => Decision::Lock(Reason::LockedPushedAway),
        None => Decision::Rest(Reason::NoneHelps),
    }
}

/// Whether a brake's local path is admissible, and how it compares; the vector compared is the path's direction (6.10).
//= thesis (6.10)
pub fn classify<S: Scalar>(
    row: Vector<S>,
    desired: &Desired<S>,
    towards: Vector<S>,
) -> Option<Candidate<S>> {
    let admissible =
        |path: Vector<S>| path.dot(desired.along) >= S::zero() && path.dot(towards) >= S::zero();
    let left = row.left();
    let path = if admissible(left) {
        left
    } else if admissible(-left) {
        -left
    } else {
        return None;
    };
    Some(Candidate {
        rank: 0,
        component: path.dot(desired.direction),
        length_squared: row.norm_squared(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::joint::Joint;

    const DESIRED: Desired<f64> = Desired {
        direction: Vector::new(0.6, 0.8),
        along: Vector::new(1.0, 0.0),
        towards: Some(Vector::new(0.0, 1.0)),
    };

    #[test]
    fn the_closest_path_in_the_quarter_turn_is_taken() {
        // Local paths (3, 1), (2, 2.9) and (−1, 2): the second lies closest to (0.6, 0.8), the third is not admissible.
        let rows = [
            Some(Vector::new(1.0, -3.0)),
            Some(Vector::new(-2.9, 2.0)),
            Some(Vector::new(2.0, 1.0)),
            None,
        ];
        let push = Vector::new(1.7, -0.9);
        assert_eq!(
            decide(&rows, push, &DESIRED, false),
            Decision::Act(Joint::E)
        );
        assert_eq!(
            decide(&rows, push, &DESIRED, true),
            Decision::Rest(Reason::InsideGap)
        );
    }

    #[test]
    fn without_an_admissible_path_pushing_away_locks() {
        let rows = [Some(Vector::new(2.0, 1.0)), None, None, None];
        let decision = |push| decide(&rows, push, &DESIRED, false);
        assert_eq!(
            decision(Vector::new(1.7, -0.9)),
            Decision::Lock(Reason::LockedPushedAway)
        );
        assert_eq!(
            decision(Vector::new(1.7, 0.9)),
            Decision::Rest(Reason::NoneHelps)
        );
    }
}
