//! This file is dry friction whose level rises and falls along the travel: an eccentric seal, a bent screw, a guide out of
//! line (Armstrong-Hélouvry 1991).

use super::facts::{Alone, Asked, AtRest, Facts, Family, Refit, Shapes, Usual, Where, Words};
use super::ripple::wave;
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::UnevenFriction,
    form: Form::Resistance(|p| {
        Box::new(Uneven {
            sine: parameter(p, 0),
            cosine: parameter(p, 1),
            period: parameter(p, 2),
        })
    }),
    linear: 2,
    passive: false,
    refuted_by: "the same friction at every position, or a force that keeps its sign when the motion reverses",
    equation: "(sine·sin(2π·q/period) + cosine·cos(2π·q/period))·sgn(q̇)",
    facts: Facts {
        usual: Usual::Seldom,
        turn: 9,
        shapes: Shapes::Period,
        at_rest: AtRest::Dry(greatest),
        refit: Refit {
            leads: false,
            sizes: &[1.0, 1.0, 1.0],
        },
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "dry friction that rises and falls along the travel",
                look_for: "a seal or bearing off its centre, a bent screw, a guide out of line",
            },
        )
    },
};

fn greatest(numbers: &[f64]) -> f64 {
    libm::hypot(parameter(numbers, 0), parameter(numbers, 1))
}

struct Uneven {
    sine: f64,
    cosine: f64,
    period: f64,
}

impl Law for Uneven {
    fn dry(&self, now: &Instant) -> f64 {
        wave([self.sine, self.cosine], now.position, self.period)
    }
}
