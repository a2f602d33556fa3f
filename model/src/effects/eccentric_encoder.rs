//! This file is an encoder whose disc turns off its centre: once a turn it shows too much, once too little.

use super::facts::{Alone, Asked, Facts, Family, Usual, Where, Words};
use super::{Entry, Form, OfSensor};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::EccentricEncoder,
    form: Form::Sensor(OfSensor::Eccentric),
    linear: 2,
    passive: false,
    refuted_by: "a turn whose halves the encoder counts alike",
    equation: "recorded angle = q + sine·sin(q) + cosine·cos(q)",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "an encoder that shows too much in one half of a turn and too little in the other",
                look_for: "the centring of its disc, a bent shaft",
            },
        )
    },
};
