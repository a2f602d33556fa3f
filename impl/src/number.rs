//! This file says which numbers the rig's code computes with: f64, f32, and whatever a proof puts in their place.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// What a selection may use: sums, products and order, each exactly rounded by IEEE 754; nothing else.
pub trait Scalar:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest number to a constant.
    fn of(constant: f64) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::of(0.0)
    }

    /// The magnitude; what is no number stays none.
    #[inline(always)]
    fn magnitude(self) -> Self {
        if self < Self::zero() { -self } else { self }
    }

    /// Whether it is a number of at most this magnitude. Nothing undefined or infinite is.
    #[inline(always)]
    fn is_within(self, bound: Self) -> bool {
        (-bound <= self) & (self <= bound)
    }
}

/// What the rest of a tick may use besides.
pub trait Real: Scalar + Div<Output = Self> {
    /// The square root.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle, rad.
    fn sine_cosine(self) -> (Self, Self);
    /// The angle of the vector (`x`, `self`), rad.
    fn atan2(self, x: Self) -> Self;
    /// As an f64.
    fn to_f64(self) -> f64;

    /// Whether it is a finite number.
    fn is_finite(self) -> bool;
}

/// The smaller of two numbers; the second if the first is none.
pub(crate) fn least<S: Scalar>(one: S, other: S) -> S {
    if one < other { one } else { other }
}

impl Scalar for f64 {
    #[inline(always)]
    fn of(constant: f64) -> f64 {
        constant
    }

    // The same answers as the trait's, each in one comparison.
    fn magnitude(self) -> f64 {
        self.abs()
    }

    fn is_within(self, bound: f64) -> bool {
        self.abs() <= bound
    }
}

impl Real for f64 {
    fn sqrt(self) -> f64 {
        libm::sqrt(self)
    }

    fn sine_cosine(self) -> (f64, f64) {
        libm::sincos(self)
    }

    fn atan2(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }

    fn to_f64(self) -> f64 {
        self
    }
}

impl Scalar for f32 {
    #[inline(always)]
    fn of(constant: f64) -> f32 {
        constant as f32
    }

    fn magnitude(self) -> f32 {
        self.abs()
    }

    fn is_within(self, bound: f32) -> bool {
        self.abs() <= bound
    }
}

impl Real for f32 {
    fn sqrt(self) -> f32 {
        libm::sqrtf(self)
    }

    fn sine_cosine(self) -> (f32, f32) {
        libm::sincosf(self)
    }

    fn atan2(self, x: f32) -> f32 {
        libm::atan2f(self, x)
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_undefined_is_within_a_bound() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 3.1, -3.1] {
            assert!(!value.is_within(3.0));
        }
        assert!((-2.9).is_within(3.0) && 3.0.is_within(3.0));
        assert!(!f32::NAN.is_within(f32::MAX) && !f32::INFINITY.is_within(f32::MAX));
    }

    #[test]
    fn only_finite_numbers_are_finite() {
        assert!(Real::is_finite(1.7e308_f64) && Real::is_finite(-3.4e38_f32));
        assert!(!Real::is_finite(f64::NAN) && !Real::is_finite(f32::NEG_INFINITY));
    }
}
