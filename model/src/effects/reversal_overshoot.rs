//! This file is more torque just after a reversal, as §3.5 of the thesis saw it: it decays with the travel since.

use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::ReversalOvershoot,
    form: Form::Resistance(|p| {
        Box::new(Overshoot {
            level: parameter(p, 0),
            travel: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "the same resistance just after a reversal and long after it",
    equation: "level·(sgn(q̇) − w)/2, travel·dw/dt = q̇ − |q̇|·w",
};

/// The memory is Dahl's: it comes from −1 to +1 with the travel after a reversal, so that what it lacks of the sense decays.
struct Overshoot {
    level: f64,
    travel: f64,
}

impl Law for Overshoot {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        -0.5 * self.level * memory
    }

    fn dry(&self, _now: &Instant) -> f64 {
        0.5 * self.level
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        (now.speed - now.speed.abs() * memory) / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        relaxed(memory, travel.signum(), travel, self.travel)
    }
}
