//! This file is a constant effort: an offset of the drive or of the force sensor.

use super::facts::{Alone, Asked, Facts, Family, Refit, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::ConstantBias,
    form: Form::Resistance(|p| {
        Box::new(Bias {
            level: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "an offset that differs between slow motion in the two directions by more than its sign",
    equation: "level",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        usual: Usual::Frequent,
        twin: Some(Mechanism::DirectionAsymmetry),
        refit: Refit {
            leads: true,
            sizes: &[1.0],
        },
        ..Facts::of(
            Family::Constant,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a steady pull to one side",
                look_for: "a sensor's zero, a cable that pulls, a tilt",
            },
        )
    },
};

struct Bias {
    level: f64,
}

impl Law for Bias {
    fn smooth(&self, _now: &Instant, _memory: f64) -> f64 {
        self.level
    }
}
