//! This file is the number of a lane: an f64 whose root the compiler may take for several lanes at once.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::{Real, Scalar};

/// An f64. `libm`'s square root is a single instruction that the compiler cannot widen; std's is the same number and can be.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[repr(transparent)]
pub struct Lane(pub f64);

impl Add for Lane {
    type Output = Lane;
    #[inline(always)]
    fn add(self, other: Lane) -> Lane {
        Lane(self.0 + other.0)
    }
}

impl Sub for Lane {
    type Output = Lane;
    #[inline(always)]
    fn sub(self, other: Lane) -> Lane {
        Lane(self.0 - other.0)
    }
}

impl Mul for Lane {
    type Output = Lane;
    #[inline(always)]
    fn mul(self, other: Lane) -> Lane {
        Lane(self.0 * other.0)
    }
}

impl Div for Lane {
    type Output = Lane;
    #[inline(always)]
    fn div(self, other: Lane) -> Lane {
        Lane(self.0 / other.0)
    }
}

impl Neg for Lane {
    type Output = Lane;
    #[inline(always)]
    fn neg(self) -> Lane {
        Lane(-self.0)
    }
}

impl Scalar for Lane {
    #[inline(always)]
    fn of(constant: f64) -> Lane {
        Lane(constant)
    }
}

impl Real for Lane {
    #[inline(always)]
    fn sqrt(self) -> Lane {
        Lane(self.0.sqrt())
    }

    fn sine_cosine(self) -> (Lane, Lane) {
        let (sine, cosine) = self.0.sine_cosine();
        (Lane(sine), Lane(cosine))
    }

    fn atan2(self, x: Lane) -> Lane {
        Lane(Real::atan2(self.0, x.0))
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_is_the_number_it_holds() {
        for value in [-0.73, 5e-324, 1.9e17, f64::INFINITY] {
            assert_eq!(Lane(value).to_f64(), value);
            assert_eq!(Real::is_finite(Lane(value)), value < f64::INFINITY);
        }
        assert!(!Real::is_finite(Lane(f64::NAN)));
    }
}
