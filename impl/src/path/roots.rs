//! This file says where a polynomial of at most the fifth degree changes its sign between 0 and 1, in bounded work.

use crate::number::Real;

/// Steps that halve a bracket, then steps of Newton's method that stay inside it.
const HALVINGS: u32 = 6;
const STEPS: u32 = 16;

/// Shares in ascending order: 0, up to five inner ones, then 1 in every place that is left.
pub(super) type Shares<R> = [R; 7];

/// The shares between which a polynomial (constant coefficient first) changes its sign at most once; none where it does not at all.
///
/// Mostly its Bernstein coefficients tell: it has at most as many roots as they have changes of sign.
pub(super) fn bracketed<R: Real>(coefficients: [R; 6]) -> Shares<R> {
    match sign_changes(bernstein(coefficients)) {
        0 => [R::of(1.0); 7],
        1 => whole(),
        _ => monotonic(coefficients),
    }
}

/// The coefficients in the Bernstein basis of the fifth degree: b_i is the sum of C(i, k)/C(5, k)·c_k over k up to i.
fn bernstein<R: Real>([c_0, c_1, c_2, c_3, c_4, c_5]: [R; 6]) -> [R; 6] {
    let times = |factor: f64, c: R| R::of(factor) * c;
    let (d_1, d_2, d_3, d_4) = (
        times(0.2, c_1),
        times(0.1, c_2),
        times(0.1, c_3),
        times(0.2, c_4),
    );
    [
        c_0,
        c_0 + d_1,
        c_0 + times(2.0, d_1) + d_2,
        c_0 + times(3.0, d_1) + times(3.0, d_2) + d_3,
        c_0 + times(4.0, d_1) + times(6.0, d_2) + times(4.0, d_3) + d_4,
        c_0 + c_1 + c_2 + c_3 + c_4 + c_5,
    ]
}

fn sign_changes<R: Real>(coefficients: [R; 6]) -> usize {
    let negative = coefficients.map(|coefficient| coefficient < R::zero());
    let pairs = negative.iter().zip(negative.iter().skip(1));
    pairs.filter(|(one, next)| one != next).count()
}

/// 0 and 1, with nothing in between.
fn whole<R: Real>() -> Shares<R> {
    let one = R::of(1.0);
    [R::zero(), one, one, one, one, one, one]
}

/// Where the derivative of a polynomial (constant coefficient first) changes its sign: the shares between which the polynomial is monotonic.
///
/// At most 1 + 2 + 3 + 4 crossings of [`STEPS`] steps each: those of the fourth derivative, of the third between them, and so on up.
fn monotonic<R: Real>(coefficients: [R; 6]) -> Shares<R> {
    let first = derivative(coefficients);
    let second = derivative(first);
    let third = derivative(second);
    let fourth = derivative(third);
    [fourth, third, second, first]
        .iter()
        .fold(whole(), |between, polynomial| {
            let mut found = whole();
            let mut places = found.iter_mut().skip(1);
            for (low, high) in pairs(&between) {
                if let Some(share) = crossing(polynomial, low, high)
                    && let Some(place) = places.next()
                {
                    *place = share;
                }
            }
            found
        })
}

/// Neighbouring shares with something between them.
pub(super) fn pairs<R: Real>(shares: &Shares<R>) -> impl Iterator<Item = (R, R)> {
    let neighbours = shares.iter().zip(shares.iter().skip(1));
    neighbours
        .map(|(low, high)| (*low, *high))
        .filter(|(low, high)| low < high)
}

/// Where a polynomial changes its sign between two shares, if it does.
pub(super) fn crossing<R: Real>(coefficients: &[R; 6], mut low: R, mut high: R) -> Option<R> {
    let negative = |share: R| value_and_slope(coefficients, share).0 < R::zero();
    let rising = negative(low);
    if rising == negative(high) {
        return None;
    }
    let half = R::of(0.5);
    let mut share = half * (low + high);
    for step in 0..STEPS {
        let (value, slope) = value_and_slope(coefficients, share);
        if (value < R::zero()) == rising {
            low = share;
        } else {
            high = share;
        }
        let newton = share - value / slope;
        let inside = low <= newton && newton <= high;
        share = if step >= HALVINGS && inside {
            newton
        } else {
            half * (low + high)
        };
    }
    Some(share)
}

/// A polynomial and its derivative at a share.
fn value_and_slope<R: Real>(coefficients: &[R; 6], share: R) -> (R, R) {
    let start = (R::zero(), R::zero());
    coefficients
        .iter()
        .rev()
        .fold(start, |(value, slope), coefficient| {
            (value * share + *coefficient, slope * share + value)
        })
}

fn derivative<R: Real>([_, c_1, c_2, c_3, c_4, c_5]: [R; 6]) -> [R; 6] {
    let times = |factor: f64, c: R| R::of(factor) * c;
    [
        c_1,
        times(2.0, c_2),
        times(3.0, c_3),
        times(4.0, c_4),
        times(5.0, c_5),
        R::zero(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_crossings_of_a_quintic_are_found() {
        // (x − 0.11)(x − 0.23)(x − 0.47)(x − 0.61)(x − 0.93), multiplied out.
        let roots: [f64; 5] = [0.11, 0.23, 0.47, 0.61, 0.93];
        let mut coefficients = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for root in roots {
            let shifted = coefficients;
            for (place, coefficient) in coefficients.iter_mut().enumerate() {
                let below = if place > 0 { shifted[place - 1] } else { 0.0 };
                *coefficient = below - root * shifted[place];
            }
        }
        let between = bracketed(coefficients);
        let found = pairs(&between)
            .filter_map(|(low, high)| crossing(&coefficients, low, high))
            .zip(roots)
            .map(|(found, root)| (found - root).abs())
            .fold([0, 0], |[count, wrong], error: f64| {
                [count + 1, wrong + i32::from(error > 1e-12)]
            });
        assert_eq!(found, [5, 0]);
    }

    #[test]
    fn one_change_of_sign_brackets_one_root_and_none_brackets_none() {
        // 0.3 + 0.1·x² has no root; x³ + x − 0.7 has one, at 0.5897.
        let empty = bracketed([0.3, 0.0, 0.1, 0.0, 0.0, 0.0]);
        assert_eq!(pairs(&empty).count(), 0);
        let cubic = [-0.7_f64, 1.0, 0.0, 1.0, 0.0, 0.0];
        assert_eq!(bracketed(cubic), whole());
        let share = crossing(&cubic, 0.0, 1.0).unwrap_or(f64::NAN);
        assert!((share * share * share + share - 0.7).abs() < 1e-15);
        // −0.1 + 2·x − 3.5·x² + 2·x³ turns twice but has one root and one change of sign.
        let turning = [-0.1, 2.0, -3.5, 2.0, 0.0, 0.0];
        assert_eq!(bracketed(turning), whole());
    }

    #[test]
    fn bernstein_coefficients_add_up_to_the_polynomial() {
        // Σ C(5, i)·bᵢ·xⁱ·(1 − x)⁵⁻ⁱ at 0.37, against Horner's rule.
        let coefficients = [0.31, -1.7, 2.3, 0.9, -3.1, 1.3];
        let (x, binomials) = (0.37_f64, [1.0, 5.0, 10.0, 10.0, 5.0, 1.0]);
        let mut sum = 0.0;
        for (i, (b, binomial)) in bernstein(coefficients)
            .into_iter()
            .zip(binomials)
            .enumerate()
        {
            let i = i as i32;
            sum += binomial * b * libm::pow(x, f64::from(i)) * libm::pow(1.0 - x, f64::from(5 - i));
        }
        assert!((sum - value_and_slope(&coefficients, x).0).abs() < 1e-15);
    }

    #[test]
    fn a_crossing_lies_between_the_shares_it_was_looked_for_between() {
        // Five roots that all but coincide: Newton's method alone goes elsewhere.
        for (polynomial, low, high) in [
            (
                [
                    -0.985_538_954_671_224_5,
                    4.942_071_895_731_245,
                    -9.912_981_715_925_536,
                    9.941_903_562_990_454,
                    -4.985_454_788_124_736,
                    1.0,
                ],
                0.997_224_677_089_616_3,
                0.997_433_427_962_159_7,
            ),
            (
                [
                    -0.004_538_316_980_522_644_6,
                    0.066_755_452_544_392_79,
                    -0.392_769_915_389_964_9,
                    1.155_471_533_814_656,
                    -1.699_612_240_525_003_6,
                    1.0,
                ],
                0.339_373_518_305_024_1,
                0.339_612_889_610_511_5,
            ),
        ] {
            let share: f64 = crossing(&polynomial, low, high).unwrap();
            assert!((low..=high).contains(&share), "{share}");
        }
    }
}
