//! This file is Bouc-Wen hysteresis with exponent 1 (Bouc 1967, Wen 1976).
//!
//! Of `β`, `γ` and `δ` only the products `β·γ` and `β·δ` enter, so only they can be known.

use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Hysteresis,
    form: Form::Resistance(|p| {
        Box::new(BoucWen {
            alpha: parameter(p, 0),
            beta_gamma: parameter(p, 1),
            beta_delta: parameter(p, 2),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "equal force on the way out and on the way back at every amplitude",
    equation: "alpha·z, dz/dt = q̇ − beta_gamma·|q̇|·z − beta_delta·q̇·|z|",
};

struct BoucWen {
    alpha: f64,
    beta_gamma: f64,
    beta_delta: f64,
}

impl Law for BoucWen {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        self.alpha * memory
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        now.speed
            - self.beta_gamma * now.speed.abs() * memory
            - self.beta_delta * now.speed * memory.abs()
    }
}
