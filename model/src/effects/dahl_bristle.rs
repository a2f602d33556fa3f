//! This file is elastic motion before sliding on Dahl's own curve: an exponent says how it bends (P. R. Dahl, 1968).

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DahlBristle,
    form: Form::Resistance(|p| {
        Box::new(Curve {
            level: parameter(p, 0),
            travel: parameter(p, 1),
            exponent: parameter(p, 2),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a full change of force at a reversal without any travel",
    equation: "level·w, travel·dw/dt = q̇·(1 − w·sgn(q̇))^exponent",
    facts: Facts {
        in_sets: true,
        usual: Usual::Frequent,
        has_forms: true,
        shapes: Shapes::BristleCurve,
        form_of: Some(Mechanism::Presliding),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a contact that bends before it slides, on a curve of its own",
                look_for: "preloaded balls, seals, a tendon that is stretched",
            },
        )
    },
};

struct Curve {
    level: f64,
    travel: f64,
    exponent: f64,
}

impl Curve {
    /// What is left to bend after a travel, from what was left, both as shares.
    fn left(&self, left: f64, travel: f64) -> f64 {
        let travelled = travel.abs() / self.travel;
        let power = 1.0 - self.exponent;
        if power.abs() < 1e-9 {
            return left * libm::exp(-travelled);
        }
        if left <= 0.0 {
            return 0.0;
        }
        libm::pow(
            (libm::pow(left, power) - power * travelled).max(0.0),
            1.0 / power,
        )
    }
}

impl Law for Curve {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        self.level * memory
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        let left = (1.0 - memory * now.speed.signum()).max(0.0);
        now.speed * libm::pow(left, self.exponent) / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        let sense = travel.signum();
        match travel == 0.0 {
            true => memory,
            false => sense * (1.0 - self.left((1.0 - memory * sense).max(0.0), travel)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    #[test]
    fn with_an_exponent_of_one_it_is_the_plain_bristle_and_below_it_comes_to_its_level() {
        let plain = law(Mechanism::Presliding, &[0.7, 0.03]).unwrap();
        let own = law(Mechanism::DahlBristle, &[0.7, 0.03, 1.0]).unwrap();
        let steps = [0.011, -0.004, -0.05, 0.02];
        let after = |law: &dyn Law| {
            steps.iter().fold(0.0, |memory, travel| {
                law.memory_after(memory, *travel, *travel)
            })
        };
        assert!((after(plain.as_ref()) - after(own.as_ref())).abs() < 1e-12);
        let half = law(Mechanism::DahlBristle, &[0.7, 0.03, 0.5]).unwrap();
        assert!((half.memory_after(0.0, 0.07, 1.0) - 1.0).abs() < 1e-12);
    }
}
