//! This file is a cause with its parameters: what a description states, a fit estimates, and a free
//! run simulates.

use crate::cause::Cause;
use crate::plant::Clock;
use rigproof_spec::effect::Mechanism;

/// A mechanism at a place, with its parameters and its onset.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The mechanism, and where it acts.
    pub cause: Cause,
    /// Its parameters in the vocabulary's order, SI units.
    pub parameters: Vec<f64>,
    /// Whether its linear parameters are to be estimated.
    pub unknown: bool,
    /// The time from which it acts, s; `None` from the start.
    pub onset_s: Option<f64>,
}

impl Effect {
    /// A known effect of the whole plant that acts from the start.
    pub fn of(mechanism: Mechanism, parameters: &[f64]) -> Effect {
        Effect {
            cause: Cause::of(mechanism),
            parameters: parameters.to_vec(),
            unknown: false,
            onset_s: None,
        }
    }

    /// The mechanism of its cause.
    pub const fn mechanism(&self) -> Mechanism {
        self.cause.mechanism
    }

    /// A parameter by index; 0 if there is none.
    pub fn value(&self, place: usize) -> f64 {
        self.parameters.get(place).copied().unwrap_or(0.0)
    }

    /// The first sample at which it acts.
    pub fn first_sample(&self, clock: Clock) -> usize {
        self.onset_s.map_or(0, |onset_s| clock.sample_at(onset_s))
    }
}
