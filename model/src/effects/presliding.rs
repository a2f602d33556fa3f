//! This file is elastic motion before sliding: Dahl's bristle (P. R. Dahl, 1968).

use super::facts::{
    Alone, Asked, AtRest, End, Facts, Family, Limit, Refit, Shapes, Usual, Where, Words,
    first_if_positive,
};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Presliding,
    form: Form::Resistance(|p| {
        Box::new(Dahl {
            level: parameter(p, 0),
            travel: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a full change of force at a reversal without any travel",
    equation: "level·w, travel·dw/dt = q̇ − |q̇|·w",
    facts: Facts {
        of_torque: true,
        at_arm: true,
        usual: Usual::Frequent,
        turn: 2,
        has_forms: true,
        shapes: Shapes::Bristle,
        at_rest: AtRest::Level(first_if_positive),
        limit: Some(Limit {
            of: Mechanism::DryOffset,
            parameter: 1,
            end: End::Nothing,
        }),
        refit: Refit {
            leads: true,
            sizes: &[1.0, 1.0],
        },
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "springy give before sliding begins",
                look_for: "friction surfaces that bend before they slip: seals, belts, brakes that hold",
            },
        )
    },
};

struct Dahl {
    level: f64,
    travel: f64,
}

impl Law for Dahl {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        self.level * memory
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        (now.speed - now.speed.abs() * memory) / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        relaxed(memory, travel.signum(), travel, self.travel)
    }
}
