//! This file is the Stribeck peak: dry friction that is higher near standstill (Stribeck 1902; the exponent
//! is 1 after Tustin 1947, 2 after Bo and Pavelescu 1982; Armstrong-Hélouvry 1994).

use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Stribeck,
    form: Form::Resistance(|p| {
        Box::new(Stribeck {
            peak: parameter(p, 0),
            speed: parameter(p, 1),
            exponent: parameter(p, 2),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "the same resistance while slowing down to rest as in fast motion",
    equation: "peak·exp(−|q̇/speed|^exponent)·sgn(q̇)",
};

struct Stribeck {
    peak: f64,
    speed: f64,
    exponent: f64,
}

impl Law for Stribeck {
    fn dry(&self, now: &Instant) -> f64 {
        let ratio = (now.speed / self.speed).abs();
        self.peak * libm::exp(-libm::pow(ratio, self.exponent))
    }
}
