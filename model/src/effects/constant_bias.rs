//! This file is a constant effort: an offset of the drive or of the force sensor.

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
};

struct Bias {
    level: f64,
}

impl Law for Bias {
    fn smooth(&self, _now: &Instant, _memory: f64) -> f64 {
        self.level
    }
}
