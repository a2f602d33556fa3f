//! This file adds up what balances say of all numbers together: the sums of weighted least squares.

use super::constants::NUMBERS;
use crate::number::{least, most};

/// A balance: what is left of it, what each number would add, and its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// What is left, N·m·s.
    pub left: f64,
    /// What one unit of each number adds.
    pub of: [f64; NUMBERS],
    /// Variance, (N·m·s)².
    pub variance: f64,
}

/// Most standard deviations by which a row counts that is off from what the last look expects: farther is as far (Huber's score), so that one
/// row says little alone. Rows of a right model are seldom off by more than one.
const MOST_SIGMAS: f64 = 3.0;
/// Most information of one row, 1 over the square of its numbers' units: a row with more is none.
const MOST_INFORMATION: f64 = 1e18;

/// The sums over rows: with x what each number would add, y what is left and v the variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Information {
    /// Σ x·xᵀ/v: 17×17, both in the order of the numbers.
    pub of: [[f64; NUMBERS]; NUMBERS],
    /// Σ x·y/v.
    pub score: [f64; NUMBERS],
    /// Σ y²/v.
    pub square: f64,
    /// How many rows.
    pub rows: f64,
}

impl Information {
    /// Nothing seen.
    pub const NONE: Information = Information {
        of: [[0.0; NUMBERS]; NUMBERS],
        score: [0.0; NUMBERS],
        square: 0.0,
        rows: 0.0,
    };

    /// Takes a row in, of which so much is expected to be left. One that is no number changes nothing.
    pub fn take(&mut self, row: &Row, expected: f64) {
        let inverse = 1.0 / row.variance;
        let size = dot(&row.of, &row.of) * inverse;
        if !(row.variance > 0.0 && size < MOST_INFORMATION && row.left.is_finite()) {
            return;
        }
        let most_left = MOST_SIGMAS * libm::sqrt(row.variance);
        let left = expected + most(-most_left, least(most_left, row.left - expected));
        for (sums, own) in self.of.iter_mut().zip(row.of) {
            along(sums, own * inverse, &row.of);
        }
        along(&mut self.score, left * inverse, &row.of);
        self.square += left * left * inverse;
        self.rows += 1.0;
    }

    /// Adds what others say.
    pub fn add(&mut self, other: &Information) {
        self.fade(1.0, other);
    }

    /// Keeps a share of what was there, and adds what others say.
    pub fn fade(&mut self, kept: f64, other: &Information) {
        let vectors = self.of.iter_mut().zip(&other.of);
        for (own, other) in vectors.chain([(&mut self.score, &other.score)]) {
            for (own, other) in own.iter_mut().zip(other) {
                *own = *own * kept + other;
            }
        }
        self.square = self.square * kept + other.square;
        self.rows = self.rows * kept + other.rows;
    }
}

/// Goes along a vector by a step.
#[inline(always)]
pub fn along(own: &mut [f64; NUMBERS], step: f64, way: &[f64; NUMBERS]) {
    for (own, way) in own.iter_mut().zip(way) {
        *own += step * way;
    }
}

/// The scalar product.
#[inline(always)]
pub fn dot(one: &[f64; NUMBERS], other: &[f64; NUMBERS]) -> f64 {
    let mut sums = [0.0; 2];
    let (pairs, last) = one.as_chunks();
    let (other_pairs, other_last) = other.as_chunks();
    for ([a, b], [c, d]) in pairs.iter().zip(other_pairs) {
        let [even, odd] = &mut sums;
        *even += a * c;
        *odd += b * d;
    }
    let [even, odd] = sums;
    let rest: f64 = last.iter().zip(other_last).map(|(a, b)| a * b).sum();
    even + odd + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_row_says_at_most_three_deviations_more_than_was_expected() {
        let row = |left: f64| Row {
            left,
            of: [0.37; NUMBERS],
            variance: 0.0169,
        };
        let taken = |left: f64| {
            let mut sums = Information::NONE;
            sums.take(&row(left), 0.71);
            sums
        };
        // 0.71 and three times 0.13.
        let most = taken(1.1);
        for far in [1.2, 3.9, 1e9] {
            assert!((taken(far).score[4] - most.score[4]).abs() < 1e-12);
            assert!((taken(far).square - most.square).abs() < 1e-9);
        }
        let nearer = taken(1.05);
        assert!((nearer.score[4] - 0.37 * 1.05 / 0.0169).abs() < 1e-12);
        // What is no number changes nothing.
        for left in [f64::NAN, f64::INFINITY] {
            assert_eq!(taken(left), Information::NONE);
        }
    }
}
