//! This file turns vectors by small angles and finds the small angle between two: polynomials, so that no step needs a sine.

use crate::number::Real;
use crate::vector::Vector;

/// Greatest angle, rad, that [`turned`] and [`angles_between`] are exact to rounding for.
pub const GREATEST_TURN_RAD: f64 = 0.0625;

/// A vector turned by a small angle, rad, to the left: sine to the 7th power, cosine to the 8th.
///
/// What is left out is at most 4e-17 of the length at [`GREATEST_TURN_RAD`].
#[inline(always)]
pub fn turned<R: Real>(vector: Vector<R>, angle_rad: R) -> Vector<R> {
    let square = angle_rad * angle_rad;
    // Sine and cosine side by side: what is done to one is done to the other.
    let power = |[of_sine, of_cosine]: [f64; 2]| [R::of(of_sine), R::of(of_cosine)];
    let [zeroth, first, second, third] = [
        [1.0, -1.0 / 2.0],
        [-1.0 / 6.0, 1.0 / 24.0],
        [1.0 / 120.0, -1.0 / 720.0],
        [-1.0 / 5_040.0, 1.0 / 40_320.0],
    ]
    .map(power);
    let low = plus(zeroth, first, [square; 2]);
    let high = plus(second, third, [square; 2]);
    let [sine, less] = plus(low, high, [square * square; 2]);
    vector + vector * (square * less) + vector.left() * (angle_rad * sine)
}

/// Two sums, each of a number and a product.
#[inline(always)]
fn plus<R: Real>([a, b]: [R; 2], [of_a, of_b]: [R; 2], [by_a, by_b]: [R; 2]) -> [R; 2] {
    [a + of_a * by_a, b + of_b * by_b]
}

/// A vector of nearly length one with length one: a Newton step.
#[inline(always)]
pub fn renormalised<R: Real>(vector: Vector<R>) -> Vector<R> {
    vector * (R::of(1.5) - R::of(0.5) * vector.norm_squared())
}

/// The small angles from two vectors to two others of the same lengths, rad: twice the arc tangent of half of each, side by side.
///
/// What is left out is at most 5e-18 rad at [`GREATEST_TURN_RAD`].
#[inline(always)]
pub fn angles_between<R: Real>(from: [Vector<R>; 2], to: [Vector<R>; 2]) -> [R; 2] {
    let half =
        |from: Vector<R>, to: Vector<R>| from.cross(to) / (from.norm_squared() + from.dot(to));
    let ([from_one, from_other], [to_one, to_other]) = (from, to);
    let [one, other] = [half(from_one, to_one), half(from_other, to_other)];
    let of = |power: f64| [R::of(power); 2];
    let square = [one * one, other * other];
    let [first, second] = square;
    let fourth = [first * first, second * second];
    let [first, second] = fourth;
    let zeroth = plus(of(2.0), of(2.0 / 9.0), [first * first, second * second]);
    let low = plus(zeroth, of(-2.0 / 3.0), square);
    let high = plus(of(2.0 / 5.0), of(-2.0 / 7.0), square);
    let [by_one, by_other] = plus(low, high, fourth);
    [one * by_one, other * by_other]
}

/// Whether the angle between two vectors is one that [`angles_between`] is exact for.
#[inline]
pub fn is_small<R: Real>(from: Vector<R>, to: Vector<R>) -> bool {
    from.cross(to)
        .is_within(from.dot(to) * R::of(GREATEST_TURN_RAD))
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
            let [there_rad, back_rad] = angles_between([start, turned], [turned, start]);
            let apart_rad = (there_rad - angle_rad)
                .abs()
                .max((back_rad + angle_rad).abs());
            worst = (worst.0.max(off.norm()), worst.1.max(apart_rad));
        }
        assert!(worst.0 < 4e-16 && worst.1 < 4e-16, "{worst:?}");
    }

    #[test]
    fn renormalising_squares_what_is_wrong() {
        let off: f64 = renormalised(Vector::new(0.6, 0.8) * (1.0 + 3e-8)).norm() - 1.0;
        assert!(off.abs() < 3e-15, "{off:e}");
    }
}
