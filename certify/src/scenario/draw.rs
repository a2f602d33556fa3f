//! This file draws the numbers of a scenario from a seed and an index.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Random numbers that follow from a seed and an index.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw(Pcg64Mcg);

impl Draw {
    /// The stream of a seed and an index: both pass through the mixing function of SplitMix64 (Steele, Lea and Flood 2014).
    pub fn new(seed: u64, index: u64) -> Draw {
        Draw(Pcg64Mcg::seed_from_u64(mixed(mixed(seed) ^ index)))
    }

    /// Uniform from one number to another.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// A whole number from one to another, both included.
    pub fn whole(&mut self, low: i32, high: i32) -> i32 {
        self.0.random_range(low..=high)
    }

    /// A whole number from 0 to below another, which is above 0.
    pub fn below(&mut self, end: u32) -> u32 {
        self.0.random_range(0..end.max(1))
    }

    /// True once in so many times.
    pub fn one_in(&mut self, count: u32) -> bool {
        self.below(count) == 0
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.one_in(2) { 1.0 } else { -1.0 }
    }

    /// One of these; `None` of none.
    pub fn pick<T: Copy>(&mut self, all: &[T]) -> Option<T> {
        let count = u32::try_from(all.len()).ok()?;
        all.get(self.below(count) as usize).copied()
    }

    /// So many of the numbers below another, none twice; all of them where they are fewer.
    pub fn some_of(&mut self, end: usize, count: usize) -> Vec<usize> {
        rand::seq::index::sample(&mut self.0, end, count.min(end)).into_vec()
    }

    /// A seed of its own for something else.
    pub fn seed(&mut self) -> u64 {
        self.0.random()
    }
}

fn mixed(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_of_many_are_drawn_once_each() {
        let mut all = Draw::new(3, 1).some_of(17, 40);
        all.sort_unstable();
        assert!(all.into_iter().eq(0..17));
        let mut some = Draw::new(4, 1).some_of(1000, 300);
        assert_ne!(some, Draw::new(5, 1).some_of(1000, 300));
        some.sort_unstable();
        some.dedup();
        assert_eq!(some.len(), 300);
    }
}
