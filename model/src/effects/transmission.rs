//! This file is what the transmission between a motor and its link may lack, over its twist: the
//! motor's position less the link's.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

const ASKED: Asked = Asked {
    alone: Alone::Never,
    five_bar: Where::Nowhere,
};

pub(super) const STIFFNESS: Entry = Entry {
    mechanism: Mechanism::TransmissionStiffness,
    form: Form::Resistance(|p| {
        Box::new(Lash {
            stiffness: -parameter(p, 0),
            gap: f64::INFINITY,
            centre: 0.0,
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "the stated twist under a known torque, the motor held",
    equation: "stiffness·twist, added to the described one",
    facts: Facts {
        usual: Usual::Common,
        at_transmission: true,
        ..Facts::of(
            Family::Position,
            ASKED,
            Words {
                what: "a transmission that is softer or stiffer than stated",
                look_for: "the data sheet of the gear, a loose screw, a belt's tension",
            },
        )
    },
};

pub(super) const BACKLASH: Entry = Entry {
    mechanism: Mechanism::TransmissionBacklash,
    form: Form::Resistance(|p| {
        Box::new(Lash {
            stiffness: parameter(p, 0),
            gap: parameter(p, 1),
            centre: parameter(p, 2),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a torque that follows the twist through its middle",
    equation: "−stiffness·(twist − centre), cut at ±stiffness·gap/2",
    facts: Facts {
        usual: Usual::Common,
        shapes: Shapes::OfTravel {
            low: 0.02,
            high: 0.95,
            count: 12,
        },
        at_transmission: true,
        ..Facts::of(
            Family::Position,
            ASKED,
            Words {
                what: "a gap in the transmission, in which nothing passes",
                look_for: "gear teeth, a key, a coupling",
            },
        )
    },
};

/// What a spring lacks where it has a gap, as a resistance to the twist.
struct Lash {
    stiffness: f64,
    gap: f64,
    centre: f64,
}

impl Law for Lash {
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        let (twist, most) = (now.position - self.centre, 0.5 * self.gap);
        -self.stiffness * twist.clamp(-most, most)
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    #[test]
    fn a_spring_with_a_gap_gives_nothing_within_it() {
        let at = |position: f64| Instant {
            position,
            ..Instant::default()
        };
        let lacks = law(Mechanism::TransmissionBacklash, &[300.0, 0.02, 0.005]).unwrap();
        let passes = |twist: f64| 300.0 * twist + lacks.smooth(&at(twist), 0.0);
        for (twist, torque) in [(0.0, 1.5), (0.01, 1.5), (0.03, 6.0), (-0.02, -3.0)] {
            assert!((passes(twist) - torque).abs() < 1e-12, "{twist}");
        }
        let softer = law(Mechanism::TransmissionStiffness, &[-40.0]).unwrap();
        assert_eq!(softer.smooth(&at(0.5), 0.0), -20.0);
    }
}
