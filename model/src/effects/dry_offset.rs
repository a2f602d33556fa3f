//! This file is dry (Coulomb) friction: a level that opposes motion whatever the speed.

use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DryOffset,
    form: Form::Resistance(|p| {
        Box::new(Dry {
            level: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a resistance that stays the same when the motion reverses, or that vanishes with speed",
    equation: "level·sgn(q̇)",
};

struct Dry {
    level: f64,
}

impl Law for Dry {
    fn dry(&self, _now: &Instant) -> f64 {
        self.level
    }
}
