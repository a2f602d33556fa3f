//! This file is viscous friction: resistance in proportion to speed (thesis §3.3.2 measured and neglected it).

use super::facts::{Alone, Asked, Facts, Family, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Viscous,
    form: Form::Resistance(|p| {
        Box::new(Viscous {
            coefficient: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a resistance that does not grow on a speed ramp",
    equation: "coefficient·q̇",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        at_transmission: true,
        usual: Usual::Plain,
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "drag that grows with speed",
                look_for: "grease, fluid in a gap, eddy currents",
            },
        )
    },
};

struct Viscous {
    coefficient: f64,
}

impl Law for Viscous {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.coefficient * now.speed
    }
}
