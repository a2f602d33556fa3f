//! This file is a recorder whose time stamps scatter about its clock: what they say of a speed is not what was there.

use super::facts::{Alone, Asked, Facts, Family, Usual, Where, Words};
use super::{Entry, Form, OfSensor};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::ClockJitter,
    form: Form::Sensor(OfSensor::Clock),
    linear: 1,
    passive: false,
    refuted_by: "steps between stamps that are all alike",
    equation: "recorded time = time of the sample + scatter of this root mean square",
    facts: Facts {
        usual: Usual::Common,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "time stamps that scatter about an even clock",
                look_for: "when the logger takes its stamp: at the sample, or when a message arrives",
            },
        )
    },
};
