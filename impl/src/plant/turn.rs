//! This file turns vectors by small angles and finds the small angle between two: polynomials, so that no step needs a sine.

use crate::number::Real;
use crate::vector::Vector;

/// Greatest angle, rad, that [`turned`] and [`angle_between`] are exact to rounding for.
pub const GREATEST_TURN_RAD: f64 = 0.0625;

/// A vector turned by a small angle, rad, to the left: sine to the 7th power, cosine to the 8th.
///
/// What is left out is at most 4e-17 of the length at [`GREATEST_TURN_RAD`].
#[inline(always)]
pub fn turned<R: Real>(vector: Vector<R>, angle_rad: R) -> Vector<R> {
    let square = angle_rad * angle_rad;
    let sine = series(square, [1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5_040.0]);
    let less = series(
        square,
        [-1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0],
    );
    vector + vector * (square * less) + vector.left() * (angle_rad * sine)
}

/// A vector of nearly length one with length one: a Newton step.
#[inline(always)]
pub fn renormalised<R: Real>(vector: Vector<R>) -> Vector<R> {
    vector * (R::of(1.5) - R::of(0.5) * vector.norm_squared())
}

/// The small angle from one vector to another of the same length, rad: twice the arc tangent of half of it.
///
/// What is left out is at most 5e-18 rad at [`GREATEST_TURN_RAD`].
#[inline(always)]
pub fn angle_between<R: Real>(from: Vector<R>, to: Vector<R>) -> R {
    let half = from.cross(to) / (from.norm_squared() + from.dot(to));
    let powers = [2.0, -2.0 / 3.0, 2.0 / 5.0, -2.0 / 7.0, 2.0 / 9.0];
    half * series(half * half, powers)
}

/// Whether the angle between two vectors is one that [`angle_between`] is exact for.
#[inline]
pub fn is_small<R: Real>(from: Vector<R>, to: Vector<R>) -> bool {
    from.cross(to)
        .is_within(from.dot(to) * R::of(GREATEST_TURN_RAD))
}

/// A polynomial, lowest power first: four by Horner's rule in x⁴ side by side, which is twice as fast as one in x.
#[inline(always)]
pub fn series<R: Real, const N: usize>(x: R, coefficients: [f64; N]) -> R {
    let square = x * x;
    let fourth = square * square;
    let mut sums = [R::zero(); 4];
    for four in coefficients.chunks(4).rev() {
        sums = sums.map(|sum| sum * fourth);
        for (sum, coefficient) in sums.iter_mut().zip(four) {
            *sum = *sum + R::of(*coefficient);
        }
    }
    let [one, two, three, four] = sums;
    (one + two * x) + (three + four * x) * square
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_turn_is_exact_to_rounding() {
        let mut worst: (f64, f64) = (0.0, 0.0);
        for k in -997..=997_i32 {
            let angle_rad = GREATEST_TURN_RAD * f64::from(k) / 997.0;
            let (sine, cosine) = libm::sincos(0.83);
            let start = Vector::new(cosine, sine);
            let (sine, cosine) = libm::sincos(0.83 + angle_rad);
            let turned = turned(start, angle_rad);
            let off = turned - Vector::new(cosine, sine);
            let apart_rad = angle_between(start, turned) - angle_rad;
            worst = (worst.0.max(off.norm()), worst.1.max(apart_rad.abs()));
        }
        assert!(worst.0 < 4e-16 && worst.1 < 4e-16, "{worst:?}");
    }

    #[test]
    fn renormalising_squares_what_is_wrong() {
        let off: f64 = renormalised(Vector::new(0.6, 0.8) * (1.0 + 3e-8)).norm() - 1.0;
        assert!(off.abs() < 3e-15, "{off:e}");
    }
}
