//! This file runs a claim again on the numbers that a solver found.

use std::marker::PhantomData;

use rigproof_impl::claim::{Checker, Claim, Held};

use crate::width::Number;

/// Given numbers and choices, in the order of asking; what was not given is a small number that nothing else is.
pub struct Replay<N = f64> {
    numbers: std::vec::IntoIter<f64>,
    choices: std::vec::IntoIter<u8>,
    failed: bool,
    width: PhantomData<N>,
}

impl<N: Number> Checker for Replay<N> {
    type Number = N;

    fn scalar(&mut self) -> N {
        N::of(self.numbers.next().unwrap_or(0.372_951))
    }

    fn greatest(&self) -> N {
        N::of(N::WIDTH.greatest())
    }

    fn choice(&mut self, _: u8) -> u8 {
        self.choices.next().unwrap_or(0)
    }

    fn assume(&mut self, condition: bool) -> Held {
        condition.then_some(())
    }

    fn check(&mut self, condition: bool) -> Held {
        self.failed |= !condition;
        condition.then_some(())
    }

    fn cover(&mut self, _: &'static str, _: bool) {}
}

/// Whether the claim fails on these numbers and choices.
pub fn replay<N: Number>(claim: &Claim<Replay<N>>, numbers: &[f64], choices: &[u8]) -> bool {
    let mut replay = Replay {
        numbers: Vec::from(numbers).into_iter(),
        choices: Vec::from(choices).into_iter(),
        failed: false,
        width: PhantomData,
    };
    let _ = (claim.body)(&mut replay);
    replay.failed
}
