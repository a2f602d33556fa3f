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
