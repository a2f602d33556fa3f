//! This file is drag that grows with a power of speed: with its root where a thin film shears (0.5), with its square where fluid is pushed
//! through a gap and turns over (2; Borda and Carnot: a sudden change of section loses half ρ·v²).
//!
//! At an exponent of 1 it is viscous friction, at 0 it would be dry friction: a recording over a narrow range of speeds does not tell them apart.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

/// The coefficient is the drag at 1 rad/s or 1 m/s, N·m or N, 0 or more (it takes energy); the exponent above 0, in practice 0.5 to 2.
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
    refuted_by: "a resistance that grows in proportion to speed, or not at all",
    equation: "coefficient·|q̇/(1 rad/s)|^exponent·sgn(q̇)",
    facts: Facts {
        in_a_sweep: true,
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::Values(&[0.25, 0.5, 2.0, 3.0]),
        at_arm: true,
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "drag that grows with a power of the speed",
                look_for: "grease that thins when it is sheared, air or fluid that is pushed through a gap",
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
        self.coefficient * libm::pow(now.speed.abs(), self.exponent) * now.speed.signum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    fn drag(coefficient: f64, exponent: f64, speed: f64) -> f64 {
        let own = law(Mechanism::VelocityPower, &[coefficient, exponent]).unwrap();
        let now = Instant {
            time_s: 0.3,
            position: 1.7,
            speed,
            sense: speed.signum(),
        };
        own.smooth(&now, 0.0) + own.dry(&now) * now.sense
    }

    #[test]
    fn four_times_the_speed_is_twice_the_drag_by_the_root_and_sixteen_times_by_the_square() {
        for speed in [0.37, -1.9] {
            let times = |exponent| drag(0.23, exponent, 4.0 * speed) / drag(0.23, exponent, speed);
            assert!((times(0.5) - 2.0).abs() < 1e-12);
            assert!((times(2.0) - 16.0).abs() < 1e-12);
            assert!((drag(0.23, 1.0, speed) - 0.23 * speed).abs() < 1e-15);
        }
    }

    #[test]
    fn it_takes_energy_in_either_sense_and_nothing_at_rest() {
        for exponent in [0.5, 1.3, 2.0] {
            for speed in [0.41, -0.41] {
                assert!(drag(0.23, exponent, speed) * speed > 0.0);
                assert!(drag(-0.23, exponent, speed) * speed < 0.0);
            }
            assert_eq!(drag(0.23, exponent, 0.0), 0.0);
        }
    }
}
