//! This file is a bristle with drag beside it, as in the model of Canudas de Wit, Olsson, Åström and Lischinsky (1995) without its peak.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::LugreBristle,
    form: Form::Resistance(|p| {
        Box::new(Lugre {
            level: parameter(p, 0),
            viscous: parameter(p, 1),
            travel: parameter(p, 2),
        })
    }),
    linear: 2,
    passive: true,
    refuted_by: "a full change of force at a reversal without any travel, or the same force at every speed",
    equation: "level·w + viscous·q̇, travel·dw/dt = q̇ − |q̇|·w",
    facts: Facts {
        in_sets: true,
        usual: Usual::Frequent,
        has_forms: true,
        shapes: Shapes::Bristle,
        form_of: Some(Mechanism::Presliding),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a contact that bends before it slides, with drag that grows with speed",
                look_for: "greased or sealed contacts, belts, a preloaded gear",
            },
        )
    },
};

struct Lugre {
    level: f64,
    viscous: f64,
    travel: f64,
}

impl Law for Lugre {
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        self.level * memory + self.viscous * now.speed
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
