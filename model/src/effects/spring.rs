//! This file is a linear spring about its position of rest (a cable, a bellows).

use super::facts::{Alone, Asked, End, Facts, Family, Limit, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Spring,
    form: Form::Resistance(|p| {
        Box::new(Spring {
            stiffness: parameter(p, 0),
            rest: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "no change of force with position in slow motion",
    equation: "stiffness·(q − rest)",
    facts: Facts {
        usual: Usual::Seldom,
        limit: Some(Limit {
            of: Mechanism::ConstantBias,
            parameter: 0,
            end: End::Nothing,
        }),
        zero: Some(Mechanism::ConstantBias),
        at_arm: true,
        ..Facts::of(
            Family::Position,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Joints,
            },
            Words {
                what: "a spring that pulls it back",
                look_for: "cables, hoses, a belt that is stretched",
            },
        )
    },
};

struct Spring {
    stiffness: f64,
    rest: f64,
}

impl Law for Spring {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.stiffness * (now.position - self.rest)
    }
}
