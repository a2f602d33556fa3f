//! This file is a brake whose torque changes with the time since the start: in proportion to it, or ever slower to an end, as what
//! warms does (Newton's law of cooling, 1701).

use super::bias_drift::{self, drifted};
use super::facts::{Alone, Asked, Facts, Family, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::TorqueDrift,
    form: Form::ShareOfBrake(|p| {
        Box::new(Drift {
            rate: parameter(p, 0),
            settling: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "the same torque at the start and at the end of the recording",
    equation: "τ·rate·t, or τ·rate·settling·(1 − exp(−t/settling)) where it settles",
    facts: Facts {
        turn: 6,
        has_forms: true,
        shapes: bias_drift::ENTRY.facts.shapes,
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that weakens or grows stronger as the recording goes on",
                look_for: "its temperature and its supply: let it rest and repeat",
            },
        )
    },
};

struct Drift {
    rate: f64,
    /// 0 where it does not settle.
    settling: f64,
}

impl Law for Drift {
    fn dry(&self, now: &Instant) -> f64 {
        drifted(self.rate, self.settling, now.time_s)
    }
}
