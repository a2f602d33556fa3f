//! This file is a cubic (Duffing) spring about the position zero.

use super::facts::{Alone, Asked, Facts, Family, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::NonlinearSpring,
    form: Form::Resistance(|p| {
        Box::new(Cubic {
            cubic: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "a force that grows in proportion to position",
    equation: "cubic·q³",
    facts: Facts {
        usual: Usual::Exceptional,
        at_transmission: true,
        ..Facts::of(
            Family::Position,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a spring that gets stiffer with the deflection",
                look_for: "stops, rubber, cables drawn taut",
            },
        )
    },
};

struct Cubic {
    cubic: f64,
}

impl Law for Cubic {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.cubic * now.position * now.position * now.position
    }
}
