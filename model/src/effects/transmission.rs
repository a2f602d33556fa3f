//! This file is what the transmission between a motor and its link may lack, over its twist: the
//! motor's position less the link's.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, OfJoint};
use rigproof_spec::effect::Mechanism;

const ASKED: Asked = Asked {
    alone: Alone::Never,
    five_bar: Where::Nowhere,
};

pub(super) const STIFFNESS: Entry = Entry {
    mechanism: Mechanism::TransmissionStiffness,
    form: Form::Joint(OfJoint::Stiffness),
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
    form: Form::Joint(OfJoint::Lash),
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

/// The part of a twist that is within a gap about a centre: what a spring with that gap lacks of
/// its deflection, rad or m.
pub fn within_gap(twist: f64, gap: f64, centre: f64) -> f64 {
    let most = 0.5 * gap;
    (twist - centre).clamp(-most, most)
}

#[cfg(test)]
mod tests {
    use super::within_gap;

    #[test]
    fn a_spring_with_a_gap_gives_nothing_within_it() {
        let passes = |twist: f64| 300.0 * (twist - 0.005 - within_gap(twist, 0.02, 0.005));
        for (twist, torque) in [(0.0, 0.0), (0.01, 0.0), (0.03, 4.5), (-0.02, -4.5)] {
            assert!((passes(twist) - torque).abs() < 1e-12, "{twist}");
        }
    }
}
