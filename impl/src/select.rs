//! This file is selection: which brake acts, decided by the signs of sums of products alone.
//!
//! Nothing here divides, takes a root or an angle, so that every decision is one of exactly rounded arithmetic: what it claims can be
//! proved on the numbers the rig computes with.

mod best;
#[cfg(any(kani, feature = "claims"))]
pub mod proofs;
pub mod proportional;
pub mod sdof;

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::STANDING;

use crate::number::Scalar;
use crate::vector::Vector;

pub use best::{Candidate, best, closer};

/// Greatest magnitude of a number that a selection takes, in its SI unit; beyond it nothing of this rig lies.
pub const GREATEST_INPUT: f64 = 1e6;
/// Least square of a Jacobian row's length that a selection takes, 1/m²: a joint a kilometre away.
pub const LEAST_ROW_SQUARED_PER_M2: f64 = 1e-6;

/// The rows of the Jacobian, 1/m, in the order A, E, B, C: the force at the tip of 1 N·m on the joint, N. A joint without a brake has
/// none.
pub type Rows<S> = [Option<Vector<S>>; 4];

/// Where the tip should move (§6.1.1). The three directions are of length one, to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Desired<S> {
    /// Direction of the desired velocity.
    pub direction: Vector<S>,
    /// Direction of the path, with the sign of the operator's force along it.
    pub along: Vector<S>,
    /// Direction towards the path; `None` on it.
    pub towards: Option<Vector<S>>,
}

/// What a selection comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Decision {
    /// This brake acts.
    Act(Joint),
    /// Every brake holds.
    Lock(Reason),
    /// No brake acts.
    Rest(Reason),
}

impl Decision {
    /// The decision in the command's words.
    pub const fn reason(self) -> Reason {
        match self {
            Decision::Act(joint) => Reason::Chosen(joint),
            Decision::Lock(reason) | Decision::Rest(reason) => reason,
        }
    }
}

/// Whether every number is one that a selection takes: finite, not beyond [`GREATEST_INPUT`], no row shorter than
/// [`LEAST_ROW_SQUARED_PER_M2`] allows.
#[inline]
pub fn is_sound<S: Scalar>(rows: &Rows<S>, vectors: &[Vector<S>], desired: &Desired<S>) -> bool {
    let [a, e, b, c] = rows;
    let sound = |row: &Option<Vector<S>>| row.as_ref().is_none_or(sound_row);
    vectors.iter().all(bounded)
        && bounded(&desired.direction)
        && bounded(&desired.along)
        && desired.towards.iter().all(bounded)
        && sound(a)
        && sound(e)
        && sound(b)
        && sound(c)
}

/// Whether both components are numbers not beyond [`GREATEST_INPUT`].
#[inline]
pub fn bounded<S: Scalar>(vector: &Vector<S>) -> bool {
    let greatest = S::of(GREATEST_INPUT);
    vector.x.is_within(greatest) && vector.y.is_within(greatest)
}

/// Whether a row of the Jacobian is bounded and no shorter than [`LEAST_ROW_SQUARED_PER_M2`] allows.
#[inline]
pub fn sound_row<S: Scalar>(row: &Vector<S>) -> bool {
    bounded(row) && row.norm_squared() >= S::of(LEAST_ROW_SQUARED_PER_M2)
}

/// The rate of a joint whose row of the Jacobian is `row`, rad/s; exactly zero where the joint stands: at [`STANDING`] of the greatest rate
/// that it can have at this speed, or below, by squares.
#[inline]
pub fn joint_rate<S: Scalar>(row: Vector<S>, velocity_m_s: Vector<S>) -> S {
    let rate = row.dot(velocity_m_s);
    let least = S::of(STANDING * STANDING) * row.norm_squared();
    if rate * rate <= least * velocity_m_s.norm_squared() {
        S::zero()
    } else {
        rate
    }
}

/// Whether the operator pushes away from the path; never on it.
fn pushes_away<S: Scalar>(desired: &Desired<S>, force_n: Vector<S>) -> bool {
    match desired.towards {
        Some(towards) => towards.dot(force_n) < S::zero(),
        None => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows, velocity, force, direction, along, towards: sound ones.
    const SOUND: [[f64; 2]; 9] = [
        [1.3, -2.1],
        [-0.7, 1.9],
        [2.3, 0.9],
        [-1.1, -0.4],
        [0.11, -0.07],
        [3.1, -1.7],
        [0.8, 0.6],
        [1.0, 0.1],
        [-0.1, 1.0],
    ];

    fn takes(numbers: [[f64; 2]; 9]) -> bool {
        let [a, e, b, c, velocity, force, direction, along, towards] = numbers.map(Vector::from);
        let desired = Desired {
            direction,
            along,
            towards: Some(towards),
        };
        is_sound(&[a, e, b, c].map(Some), &[velocity, force], &desired)
    }

    #[test]
    fn a_number_of_no_rig_is_refused_wherever_it_stands() {
        assert!(takes(SOUND));
        for bad in [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1.000_1e6,
            -1e300,
        ] {
            for place in 0..SOUND.len() {
                for component in 0..2 {
                    let mut numbers = SOUND;
                    numbers[place][component] = bad;
                    assert!(!takes(numbers), "{numbers:?}");
                }
            }
        }
    }

    #[test]
    fn a_row_as_of_a_joint_a_kilometre_away_is_refused() {
        for place in 0..4 {
            for (row, is_taken) in [([0.7e-3, 0.7e-3], false), ([-0.8e-3, 0.7e-3], true)] {
                let mut numbers = SOUND;
                numbers[place] = row;
                assert_eq!(takes(numbers), is_taken);
            }
        }
    }
}
