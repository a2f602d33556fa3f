//! This file is one dry brake as the friction of a step sees it.

use crate::vector::Vector;

/// Square of the sine below which two brakes count as parallel: they hold and release the same motion.
const PARALLEL_SQUARED: f64 = 1e-24;

type Plane = Vector<f64>;

/// One dry brake on two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryBrake {
    /// How its torque acts on the coordinates.
    pub force_row: Plane,
    /// The rate of its joint by the coordinates' rates.
    pub rate_row: Plane,
    /// Greatest impulse of the brake, N·m·s, 0 or more; 0 is no brake.
    pub bound: f64,
    /// The rate of its joint at the start, rad/s.
    pub start_rad_s: f64,
}

impl DryBrake {
    /// None.
    pub fn absent() -> DryBrake {
        DryBrake {
            force_row: Vector::zero(),
            rate_row: Vector::zero(),
            bound: 0.0,
            start_rad_s: 0.0,
        }
    }

    pub(super) fn acts(&self) -> bool {
        self.bound > 0.0
    }

    /// The rate of the joint along a direction; exactly zero where they are at right angles.
    #[inline]
    pub(super) fn rate(&self, along: Plane) -> f64 {
        exact_zero(self.rate_row, along)
    }
}

/// The dot product; exactly zero where the two are at right angles.
#[inline]
pub(super) fn exact_zero(one: Plane, other: Plane) -> f64 {
    let product = one.dot(other);
    if product * product <= PARALLEL_SQUARED * one.norm_squared() * other.norm_squared() {
        0.0
    } else {
        product
    }
}
