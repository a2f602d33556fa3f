//! This file is a cause with its numbers: what a description states, what a fit gives, and what a free run computes.

use crate::cause::Cause;
use crate::plant::Clock;
use rigproof_spec::effect::Mechanism;

/// A mechanism, where it acts, its numbers, and when it begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The mechanism, and where it acts.
    pub cause: Cause,
    /// Its parameters in the vocabulary's order, SI.
    pub parameters: Vec<f64>,
    /// Whether its linear parameters are to be estimated.
    pub unknown: bool,
    /// When it begins, s.
    pub onset_s: Option<f64>,
}

impl Effect {
    /// A mechanism of the whole from the start, its numbers as they are.
    pub fn of(mechanism: Mechanism, parameters: &[f64]) -> Effect {
        Effect {
            cause: Cause::of(mechanism),
            parameters: parameters.to_vec(),
            unknown: false,
            onset_s: None,
        }
    }

    /// The mechanism.
    pub const fn mechanism(&self) -> Mechanism {
        self.cause.mechanism
    }

    /// A parameter by its place, 0 where it has none.
    pub fn value(&self, place: usize) -> f64 {
        self.parameters.get(place).copied().unwrap_or(0.0)
    }

    /// The first sample at which it acts.
    pub fn first_sample(&self, clock: Clock) -> usize {
        self.onset_s.map_or(0, |onset_s| clock.sample_at(onset_s))
    }
}
