//! This file says which numbers the balances speak for, and how surely: recursive least squares that falls back to what is certified.
//!
//! The numbers θ follow θ' = a·θ + w about the middle of what is certified, with the variance P₀ at rest, so that
//! P ≤ P₀ whatever is seen: without excitation the estimate comes back to the middle and cannot grow.

use super::constants::{NUMBERS, WATCHED};
use crate::number::{Scalar, least, most};

/// Mean and covariance of the numbers, what the last rows say of a change, and how surprising they were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    mean: [f64; NUMBERS],
    covariance: [[f64; NUMBERS]; NUMBERS],
    at_rest: [f64; NUMBERS],
    ends: [[f64; NUMBERS]; 2],
    changes: [Change; WATCHED],
    surprise: f64,
}

/// What the last rows say of one number if it alone has changed: the least squares of one unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Change {
    information: f64,
    score: f64,
}

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

/// A watched number, as the last rows say if it alone has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// What was learned of it: how far it is from the middle of what is certified.
    pub learned: f64,
    /// The variance of that.
    pub doubt: f64,
    /// What the last rows say it has changed by since.
    pub change: f64,
    /// The variance of that.
    pub variance: f64,
}

impl Number {
    /// How far it is surely beyond one of its ends, in standard deviations of the change: wherever it was before within what was
    /// learned, by two standard deviations, and within its interval.
    pub fn beyond(&self, low: f64, high: f64) -> f64 {
        let (end, before) = if self.change > 0.0 {
            (high - self.learned, self.learned - low)
        } else {
            (self.learned - low, high - self.learned)
        };
        let doubt = least(2.0 * libm::sqrt(self.doubt), most(before, 0.0));
        (self.change.magnitude() - end - doubt) * (1.0 / libm::sqrt(self.variance))
    }
}

/// Share of the newest row in the mean square of the surprise: a quarter of a second of blocks of 32 ms with two rows each.
const SURPRISE_SHARE: f64 = 1.0 / 16.0;
/// Information of a change before anything is seen, 1 over the square of its unit: none, but above zero.
const LEAST_INFORMATION: f64 = 1e-6;

impl Estimate {
    /// Nothing seen yet: spreads about the middle, between ends about it.
    pub fn new(spread: &[f64; NUMBERS], ends: [[f64; NUMBERS]; 2]) -> Estimate {
        let at_rest = spread.map(|spread| spread * spread);
        let mut covariance = [[0.0; NUMBERS]; NUMBERS];
        for (place, (row, variance)) in covariance.iter_mut().zip(at_rest).enumerate() {
            if let Some(own) = row.get_mut(place) {
                *own = variance;
            }
        }
        Estimate {
            mean: [0.0; NUMBERS],
            covariance,
            at_rest,
            ends,
            changes: [Change::default(); WATCHED],
            surprise: 0.0,
        }
    }

    /// Forgets: what is kept of what was learned, and of the last rows, are shares.
    pub fn forget(&mut self, [of_learned, of_last]: [f64; 2]) {
        let square = of_learned * of_learned;
        for (place, (row, at_rest)) in self.covariance.iter_mut().zip(self.at_rest).enumerate() {
            for own in row.iter_mut() {
                *own *= square;
            }
            if let Some(own) = row.get_mut(place) {
                *own += (1.0 - square) * at_rest;
            }
        }
        for mean in &mut self.mean {
            *mean *= of_learned;
        }
        for change in &mut self.changes {
            change.information *= of_last;
            change.score *= of_last;
        }
    }

    /// Takes a row in. One that is no number changes nothing.
    pub fn take(&mut self, row: &Row) {
        let mut along = [0.0; NUMBERS];
        for (along, covariance) in along.iter_mut().zip(&self.covariance) {
            *along = dot(covariance, &row.of);
        }
        let variance = dot(&along, &row.of) + row.variance;
        let unforeseen = row.left - dot(&self.mean, &row.of);
        if !(variance > 0.0 && variance.is_finite() && unforeseen.is_finite()) {
            return;
        }
        let inverse = 1.0 / variance;
        let step = unforeseen * inverse;
        for (change, of) in self.changes.iter_mut().zip(row.of) {
            change.information += of * of * inverse;
            change.score += of * step;
        }
        let [low, high] = &self.ends;
        let ends = along.iter().zip(low).zip(high);
        for (mean, ((along, low), high)) in self.mean.iter_mut().zip(ends) {
            // What was certified lies between its ends: what does not, is no thing to learn but a change.
            *mean = most(*low, least(*high, *mean + along * step));
        }
        for (covariance, one) in self.covariance.iter_mut().zip(&along) {
            let share = one * inverse;
            for (own, other) in covariance.iter_mut().zip(&along) {
                *own -= share * other;
            }
        }
        self.surprise += SURPRISE_SHARE * (unforeseen * step - self.surprise);
    }

    /// The watched numbers, each as if it alone had changed.
    pub fn numbers(&self) -> impl Iterator<Item = Number> + '_ {
        let learned = self.mean.iter().zip(self.covariance.iter().enumerate());
        let all = self.changes.iter().zip(learned);
        all.map(|(change, (mean, (place, row)))| {
            let inverse = 1.0 / (change.information + LEAST_INFORMATION);
            Number {
                learned: *mean,
                doubt: row.get(place).copied().unwrap_or(0.0),
                change: change.score * inverse,
                variance: inverse,
            }
        })
    }

    /// Mean square of the normalised surprise of the last rows: 1 where the model is right.
    pub fn surprise(&self) -> f64 {
        self.surprise
    }
}

fn dot(one: &[f64; NUMBERS], other: &[f64; NUMBERS]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
