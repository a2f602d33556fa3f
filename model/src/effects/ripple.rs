//! This file is an effort periodic in position (cogging, a bent shaft, a tooth mesh).

use super::facts::{Alone, Asked, Facts, Family, Refit, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use core::f64::consts::TAU;
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Ripple,
    form: Form::Resistance(|p| {
        Box::new(Ripple {
            sine: parameter(p, 0),
            cosine: parameter(p, 1),
            period: parameter(p, 2),
        })
    }),
    linear: 2,
    passive: false,
    refuted_by: "no line in the spectrum over position",
    equation: "sine·sin(2π·q/period) + cosine·cos(2π·q/period)",
    facts: Facts {
        of_torque: true,
        usual: Usual::Seldom,
        turn: 9,
        shapes: Shapes::Period,
        refit: Refit {
            leads: false,
            sizes: &[1.0, 1.0, 1.0],
        },
        at_arm: true,
        ..Facts::of(
            Family::Position,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a force that comes and goes with the position",
                look_for: "cogging, a bent shaft, teeth, a coupling out of line",
            },
        )
    },
};

struct Ripple {
    sine: f64,
    cosine: f64,
    period: f64,
}

impl Law for Ripple {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        wave([self.sine, self.cosine], now.position, self.period)
    }
}

/// What is so much of a sine and a cosine over a position, m or rad, with a period.
pub(super) fn wave([sine, cosine]: [f64; 2], position: f64, period: f64) -> f64 {
    let (sin, cos) = libm::sincos(TAU * position / period);
    sine * sin + cosine * cos
}
