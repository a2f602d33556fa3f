//! This file is a constant effort that drifts in proportion to the time since the start (a warming amplifier).

use super::facts::{Alone, Asked, Facts, Family, Refit, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::BiasDrift,
    form: Form::Resistance(|p| {
        Box::new(Drift {
            rate: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: false,
    refuted_by: "an offset that is the same at the start and at the end of the recording",
    equation: "rate·t",
    facts: Facts {
        usual: Usual::Exceptional,
        refit: Refit {
            leads: false,
            sizes: &[0.1],
        },
        ..Facts::of(
            Family::Constant,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a pull to one side that grows with time",
                look_for: "a sensor's zero that drifts with temperature",
            },
        )
    },
};

struct Drift {
    rate: f64,
}

impl Law for Drift {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.rate * now.time_s
    }
}
