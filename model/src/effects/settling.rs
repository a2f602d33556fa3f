//! This file is a resistance that rest has built up and motion stirs away: settled particles (§3.4.1 names the scatter).

use super::facts::{
    Alone, Asked, AtRest, End, Facts, Family, Limit, Shapes, Where, Words, first_if_positive,
};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Settling,
    form: Form::Resistance(|p| {
        Box::new(Settled {
            level: parameter(p, 0),
            travel: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "the same resistance in the first turn after a rest as in the tenth",
    equation: "level·(1 − m)·sgn(q̇), travel·dm/dt = |q̇|·(1 − m)",
    facts: Facts {
        turn: 3,
        shapes: Shapes::Geometric {
            low: 0.3,
            high: 30.0,
            count: 5,
        },
        at_rest: AtRest::Dry(first_if_positive),
        limit: Some(Limit {
            of: Mechanism::DryOffset,
            parameter: 1,
            end: End::Everything,
        }),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that changes after it has rested",
                look_for: "particles that settle in the fluid: run it in and repeat",
            },
        )
    },
};

/// The memory is the share that has been stirred since the first sample.
struct Settled {
    level: f64,
    travel: f64,
}

impl Law for Settled {
    // The dry level of a law knows no memory, so that this one acts in motion only; the rig's `parts` hold at rest too.
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        self.level * (1.0 - memory) * now.sense
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        now.speed.abs() * (1.0 - memory) / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        relaxed(memory, 1.0, travel, self.travel)
    }

    fn parts(&self, _now: &Instant, memory: f64) -> (f64, f64) {
        (0.0, self.level * (1.0 - memory))
    }
}
