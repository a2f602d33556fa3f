//! This file is a linear spring about the position zero (a cable, a bellows).

use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Spring,
    form: Form::Resistance(|p| {
        Box::new(Spring {
            stiffness: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "no change of force with position in slow motion",
    equation: "stiffness·q",
};

struct Spring {
    stiffness: f64,
}

impl Law for Spring {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.stiffness * now.position
    }
}
