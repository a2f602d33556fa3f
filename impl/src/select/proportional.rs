//! This file says which brake takes an unwanted velocity away: the selection of §6.3.

use rigproof_spec::command::Reason;
use rigproof_spec::laws::influence_rank;
use rigproof_spec::methods::NO_INFLUENCE;

use super::{Candidate, Decision, Desired, Rows, best, is_sound, joint_rate, pushes_away};
use crate::number::Scalar;
use crate::vector::Vector;

/// What proportional control decides: a lock if the tip moves against the desired direction; else the brake with the best influence,
/// of those the one whose force points closest to the desired direction; else a lock if the operator pushes away.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | J_i | `rows` | 1/m |
/// | v | `velocity_m_s` | m/s |
/// | F | `force_n`: the operator's | N |
///
/// What [`is_sound`] refuses decides for no brake.
//= thesis (6.12)
#[inline]
pub fn decide<S: Scalar>(
    rows: &Rows<S>,
    velocity_m_s: Vector<S>,
    force_n: Vector<S>,
    desired: &Desired<S>,
) -> Decision {
    if !is_sound(rows, &[velocity_m_s, force_n], desired) {
        return Decision::Rest(Reason::UndefinedInput);
    }
    if desired.direction.dot(velocity_m_s) < S::zero() {
        return Decision::Lock(Reason::LockedMovingBack);
    }
    let [a, e, b, c] = *rows;
    let candidate = |row: Option<Vector<S>>| classify(row?, velocity_m_s, desired.direction);
    match best([candidate(a), candidate(e), candidate(b), candidate(c)]) {
        Some(joint) => Decision::Act(joint),
        None if pushes_away(desired, force_n) => Decision::Lock(Reason::LockedPushedAway),
        None => Decision::Rest(Reason::NoneHelps),
    }
}

/// Whether a brake may act, and how it compares; the vector compared is its force at the tip.
///
/// # Differs from the thesis
///
/// A brake whose joint stands is not actuated, where (6.11) takes the force of a joint that turns forwards: a rate beside zero is
/// rounding, with a sign that cannot be trusted (gap `joint-at-rest`).
#[inline]
pub fn classify<S: Scalar>(
    row: Vector<S>,
    velocity_m_s: Vector<S>,
    direction: Vector<S>,
) -> Option<Candidate<S>> {
    let unwanted = direction.cross(velocity_m_s);
    // No force takes from a component that is not there.
    if unwanted == S::zero() {
        return None;
    }
    let force = opposing(row, velocity_m_s)?;
    let length_squared = row.norm_squared();
    let on_across = sign(direction.cross(force), unwanted, length_squared);
    // Nothing else has a rank: about half of the brakes are out before the other component is computed.
    if on_across != -1 {
        return None;
    }
    let along = direction.dot(force);
    let on_along = sign(along, direction.dot(velocity_m_s), length_squared);
    influence_rank([on_along, on_across]).map(|rank| Candidate {
        rank,
        component: along,
        length_squared,
    })
}

/// The force of 1 N·m of a brake against its joint's rate, N; `None` where the joint stands.
//= thesis (6.11)
#[inline]
pub fn opposing<S: Scalar>(row: Vector<S>, velocity_m_s: Vector<S>) -> Option<Vector<S>> {
    let rate = joint_rate(row, velocity_m_s);
    if rate < S::zero() {
        Some(row)
    } else if rate > S::zero() {
        Some(-row)
    } else {
        None
    }
}

/// What a component of a force does to the magnitude of a velocity component: 1 increases it, −1 decreases it, 0 has no effect.
fn sign<S: Scalar>(component: S, speed: S, length_squared: S) -> i8 {
    let negligible = S::of(NO_INFLUENCE * NO_INFLUENCE) * length_squared;
    if component * component < negligible {
        0
    } else if (component > S::zero()) == (speed >= S::zero()) {
        1
    } else {
        -1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::joint::Joint;

    const DESIRED: Desired<f64> = Desired {
        direction: Vector::new(1.0, 0.0),
        along: Vector::new(1.0, 0.0),
        towards: Some(Vector::new(0.0, -1.0)),
    };

    #[test]
    fn the_brake_against_the_unwanted_component_acts() {
        let velocity = Vector::new(0.11, 0.07);
        // Forces (0.3, −0.7), (−0.4, −0.6), (−0.8, 0.3): [1, −1], [−1, −1], and none that may act.
        let rows = [
            Some(Vector::new(-0.4, -0.6)),
            Some(Vector::new(-0.8, 0.3)),
            None,
            Some(Vector::new(-0.3, 0.7)),
        ];
        let push = Vector::new(1.7, 0.9);
        assert_eq!(
            decide(&rows, velocity, push, &DESIRED),
            Decision::Act(Joint::C)
        );
    }

    #[test]
    fn a_tip_that_moves_back_is_locked() {
        let rows = [Some(Vector::new(-0.4, -0.6)); 4];
        let decision = decide(
            &rows,
            Vector::new(-0.03, 0.2),
            Vector::new(1.7, 0.9),
            &DESIRED,
        );
        assert_eq!(decision, Decision::Lock(Reason::LockedMovingBack));
    }

    #[test]
    fn a_joint_at_rest_has_no_opposing_force() {
        assert_eq!(
            opposing(Vector::new(2.0, -3.0), Vector::new(0.75, 0.5)),
            None
        );
        assert_eq!(
            opposing(Vector::new(2.0, -3.0), Vector::new(f64::NAN, 0.2)),
            None
        );
    }

    #[test]
    fn a_component_counts_from_a_billionth_of_its_force_on() {
        for (component, counts) in [(0.9e-9, 0), (1.1e-9, 1), (-1.1e-9, -1), (-3.7e-7, -1)] {
            assert_eq!(
                sign(component * 2.3, 0.7, 2.3 * 2.3),
                counts,
                "{component:e}"
            );
        }
    }
}
