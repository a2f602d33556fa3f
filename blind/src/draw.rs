//! This file draws random numbers that depend only on a case's seed and on what they are for.

use crate::plant::Plant;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use sha2::{Digest, Sha256};

/// A stream of random numbers.
pub struct Draw(Pcg64);

impl Draw {
    /// The stream of a seed for one purpose; two purposes never share numbers.
    pub fn new(plant: Plant, seed: u64, purpose: &str) -> Draw {
        let digest = Sha256::new()
            .chain_update(plant.name())
            .chain_update(seed.to_le_bytes())
            .chain_update(purpose)
            .finalize();
        Draw(Pcg64::from_seed(digest.into()))
    }

    /// Uniform in `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Uniform in the logarithm; both ends positive.
    pub fn log_uniform(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.uniform(libm::log(low), libm::log(high)))
    }

    /// True with the given probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    /// A whole number in `0..below`.
    pub fn below(&mut self, below: usize) -> usize {
        self.0.random_range(0..below)
    }

    /// One of the items of a list that is not empty.
    #[expect(
        clippy::indexing_slicing,
        reason = "the index is drawn below the length"
    )]
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len())]
    }

    /// Gaussian with mean zero.
    pub fn normal(&mut self, standard_deviation: f64) -> f64 {
        let unit: f64 = StandardNormal.sample(&mut self.0);
        standard_deviation * unit
    }
}

/// A value rounded to three significant digits, as a technician writes it down.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_purpose_has_its_own_numbers() {
        let first = |purpose| Draw::new(Plant::Axis, 29, purpose).uniform(0.0, 1.0);
        assert_eq!(first("noise"), first("noise"));
        assert_ne!(first("noise"), first("setup"));
    }

    #[test]
    fn three_digits_are_kept() {
        assert_eq!(rounded(0.012_345), 0.0123);
        assert_eq!(rounded(-98_765.0), -98_800.0);
    }
}
