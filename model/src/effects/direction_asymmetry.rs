//! This file is friction that differs between the two directions of motion (a worn screw, a preloaded nut).

use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DirectionAsymmetry,
    form: Form::Resistance(|p| {
        Box::new(Asymmetry {
            viscous: parameter(p, 0),
            dry: parameter(p, 1),
        })
    }),
    linear: 2,
    dissipative: false,
    refuted_by: "equal resistance at equal speed in both directions",
    equation: "viscous·|q̇| + dry·[q̇ ≠ 0]",
};

/// Half the difference between the positive and the negative direction.
struct Asymmetry {
    viscous: f64,
    dry: f64,
}

impl Law for Asymmetry {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.viscous * now.speed.abs()
    }

    fn dry(&self, now: &Instant) -> f64 {
        self.dry * now.sense
    }
}
