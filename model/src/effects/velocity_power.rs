//! This file is drag that grows with a power of speed: its root in a lubricated contact, its square in turbulent flow.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::VelocityPower,
    form: Form::Resistance(|p| {
        Box::new(Power {
            coefficient: parameter(p, 0),
            exponent: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a resistance that grows in proportion to speed",
    equation: "coefficient·|q̇|^exponent·sgn(q̇), q̇ in units of one",
    facts: Facts {
        shapes: Shapes::Values(&[0.5, 2.0]),
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "drag that grows with the root or the square of speed",
                look_for: "grease that thins when it is sheared, air or oil that is stirred",
            },
        )
    },
};

struct Power {
    coefficient: f64,
    exponent: f64,
}

impl Law for Power {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        self.coefficient * libm::pow(now.speed.abs(), self.exponent) * now.sense
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    #[test]
    fn at_four_times_the_speed_a_root_is_twice_and_a_square_sixteen_times() {
        for (exponent, times) in [(0.5, 2.0), (2.0, 16.0)] {
            let law = law(Mechanism::VelocityPower, &[0.37, exponent]).unwrap();
            let at = |speed: f64| {
                let now = Instant {
                    time_s: 0.3,
                    position: 1.7,
                    speed,
                    sense: speed.signum(),
                };
                law.smooth(&now, 0.0)
            };
            assert!((at(0.92) / at(0.23) - times).abs() < 1e-12);
            assert!((at(-0.23) + at(0.23)).abs() < 1e-15);
        }
    }
}
