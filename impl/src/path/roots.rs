//! This file says where a polynomial of at most the fifth degree changes its sign between 0 and 1, in bounded work.

use crate::number::Real;

/// Steps that halve a bracket, then steps of Newton's method that stay inside it.
const HALVINGS: u32 = 6;
const STEPS: u32 = 16;

/// Shares in ascending order: 0, up to five inner ones, then 1 in every place that is left.
pub(super) type Shares<R> = [R; 7];

/// 0 and 1, with nothing in between.
fn whole<R: Real>() -> Shares<R> {
    let one = R::of(1.0);
    [R::zero(), one, one, one, one, one, one]
}

/// Where the derivative of a polynomial (constant coefficient first) changes its sign: the shares between which the polynomial is monotonic.
///
/// At most 1 + 2 + 3 + 4 crossings of [`STEPS`] steps each: those of the fourth derivative, of the third between them, and so on up.
pub(super) fn monotonic<R: Real>(coefficients: [R; 6]) -> Shares<R> {
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
        let between = monotonic(coefficients);
        let found = pairs(&between)
            .filter_map(|(low, high)| crossing(&coefficients, low, high))
            .zip(roots)
            .map(|(found, root)| (found - root).abs())
            .fold([0, 0], |[count, wrong], error: f64| {
                [count + 1, wrong + i32::from(error > 1e-12)]
            });
        assert_eq!(found, [5, 0]);
    }
}
