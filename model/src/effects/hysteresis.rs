//! This file is Bouc-Wen hysteresis with exponent 1 (Bouc 1967, Wen 1976).
//!
//! Of `β`, `γ` and `δ` only the products `β·γ` and `β·δ` enter, so only they can be known.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
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
    facts: Facts {
        usual: Usual::Exceptional,
        has_forms: true,
        shapes: Shapes::Memory,
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a force that depends on the way it came (hysteresis)",
                look_for: "rubber, belts, wire rope, fluid that has to yield",
            },
        )
    },
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

    /// In one sense of travel dz/dx = 1 − rate·z, with one rate while z lies along the travel and another while it lies against it.
    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        let (sense, length) = (travel.signum(), travel.abs());
        // Along the travel z and x count positive; both ways obey the same equation.
        let z = memory * sense;
        let (against, along) = (
            self.beta_gamma - self.beta_delta,
            self.beta_gamma + self.beta_delta,
        );
        if z >= 0.0 {
            return sense * grown(z, along, length);
        }
        // Where z comes through zero the rate changes.
        let to_zero = if against.abs() > 1e-12 {
            libm::log1p(-against * z) / against
        } else {
            -z
        };
        if to_zero < length {
            sense * grown(0.0, along, length - to_zero)
        } else {
            sense * grown(z, against, length)
        }
    }
}

/// z after a length x of dz/dx = 1 − rate·z.
fn grown(z: f64, rate: f64, x: f64) -> f64 {
    if (rate * x).abs() < 1e-12 {
        return z + x * (1.0 - rate * z);
    }
    z - libm::expm1(-rate * x) / rate * (1.0 - rate * z)
}
