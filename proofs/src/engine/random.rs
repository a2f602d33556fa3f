//! This file tests claims on seeded random numbers, and counts what they met.

use std::marker::PhantomData;

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigproof_impl::claim::{Checker, Claim, Held};

use crate::classes::Classes;
use crate::width::Number;

/// What became of a claim.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// How many draws there were.
    pub draws: u64,
    /// How many of them the assumptions let through to the end.
    pub kept: u64,
    /// The numbers of the draw that refuted the claim.
    pub refuted_by: Option<Vec<f64>>,
    /// How many draws met each class.
    pub classes: Classes,
}

/// Numbers of four kinds: any bits, any size, few small whole ones (for ties and zeros), and the ends of ranges.
pub struct Sampler<N = f64> {
    random: Pcg64,
    width: PhantomData<N>,
    kind: u32,
    numbers: Vec<f64>,
    classes: Classes,
    failed: bool,
}

/// Ends of ranges, and what is no number.
const ENDS: [f64; 12] = [
    0.0,
    -0.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    f64::MAX,
    1e6,
    1e-3,
    1.0 + f64::EPSILON,
    -1e-170,
    -1_000_000.000_000_000_1,
];

impl<N: Number> Sampler<N> {
    fn number(&mut self) -> f64 {
        let random = &mut self.random;
        let kind = if random.random_range(0..7) == 0 {
            random.random_range(0..8)
        } else {
            self.kind
        };
        match kind {
            0 => {
                let bits = random.next_u64();
                let wide = N::WIDTH.of_bits(bits);
                wide.or_else(|| N::WIDTH.of_bits(bits >> 32)).unwrap_or(0.0)
            }
            1 => ENDS[random.random_range(0..ENDS.len())],
            2 | 3 => f64::from(random.random_range(-2..3_i8)),
            4 => random.random_range(0.0..1.3),
            _ => {
                // From a thousandth to a thousand, either sign: a random exponent beside a random fraction.
                let exponent = random.random_range(-10..10_i32);
                let fraction: f64 = random.random_range(1.0..2.0);
                let sign = if random.random_bool(0.5) { -1.0 } else { 1.0 };
                sign * fraction * f64::powi(2.0, exponent)
            }
        }
    }
}

impl<N: Number> Checker for Sampler<N> {
    type Number = N;

    fn scalar(&mut self) -> N {
        let number = N::of(self.number());
        self.numbers.push(number.into());
        number
    }

    fn greatest(&self) -> N {
        N::of(N::WIDTH.greatest())
    }

    fn choice(&mut self, count: u8) -> u8 {
        self.random.random_range(0..count)
    }

    fn assume(&mut self, condition: bool) -> Held {
        condition.then_some(())
    }

    fn check(&mut self, condition: bool) -> Held {
        self.failed |= !condition;
        condition.then_some(())
    }

    fn cover(&mut self, class: &'static str, condition: bool) {
        self.classes.count(class, condition);
    }
}

/// Draws until the claim is refuted or this many were made.
pub fn sample<N: Number>(claim: &Claim<Sampler<N>>, seed: u64, draws: u64) -> Sampled {
    let mut sampler = Sampler {
        width: PhantomData,
        random: Pcg64::seed_from_u64(seed),
        kind: 0,
        numbers: Vec::new(),
        classes: Classes::default(),
        failed: false,
    };
    let mut kept = 0;
    for draw in 1..=draws {
        sampler.kind = sampler.random.random_range(0..8);
        sampler.numbers.clear();
        kept += u64::from((claim.body)(&mut sampler).is_some());
        if sampler.failed {
            return Sampled {
                draws: draw,
                kept,
                refuted_by: Some(sampler.numbers),
                classes: sampler.classes,
            };
        }
    }
    Sampled {
        draws,
        kept,
        refuted_by: None,
        classes: sampler.classes,
    }
}
