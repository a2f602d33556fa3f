//! This file is what a driven joint has as a whole: friction by load or by time, another inertia, an inertia behind a spring or a gap.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, OfJoint, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const LOAD_FRICTION: Entry = Entry {
    mechanism: Mechanism::LoadFriction,
    form: Form::Joint(OfJoint::Load),
    linear: 0,
    passive: true,
    refuted_by: "the same friction whether the joint drives hard or coasts",
    equation: "share·|e|·sgn(q̇), or share·|e/(1 N·m)|^exponent·(1 N·m)·sgn(q̇), e the effort at the joint",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::OfLoad {
            low: 0.03,
            high: 0.5,
            count: 7,
        },
        at_arm: true,
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Loaded,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "friction that grows with the effort that the joint transmits",
                look_for: "a gear with sliding teeth, a screw, a harmonic drive",
            },
        )
    },
};

/// Friction, N or N·m, by an effort that is transmitted, from the parameters of `load_friction`.
///
/// It grows with the load where dry surfaces meet, with its power 4/3 where a ball rolls (Hertz), and with its square in the gears of
/// servos (Duclusaud et al. 2024).
pub fn load_friction(effort: f64, parameters: &[f64]) -> f64 {
    let load = match parameters.get(1) {
        Some(exponent) => libm::pow(effort.abs(), *exponent),
        None => effort.abs(),
    };
    parameter(parameters, 0) * load
}

pub(super) const FRICTION_FADE: Entry = Entry {
    mechanism: Mechanism::FrictionFade,
    form: Form::Joint(OfJoint::Fade),
    linear: 2,
    passive: false,
    refuted_by: "the same friction at the start and at the end of the recording",
    equation: "described dry friction × (1 − rate·t), described drag × (1 − drag_rate·t)",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "friction that changes while the recording goes on",
                look_for: "grease that warms up, running in",
            },
        )
    },
};

pub(super) const ADDED_INERTIA: Entry = Entry {
    mechanism: Mechanism::AddedInertia,
    form: Form::Joint(OfJoint::Inertia),
    linear: 1,
    passive: false,
    refuted_by: "the described inertia on a swing or a scale",
    equation: "inertia·q̈, added to the described one",
    facts: Facts {
        at_arm: true,
        in_sets: true,
        usual: Usual::Frequent,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::WithInertia,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "another inertia than the described one",
                look_for: "a payload, a tool, the motor behind its gear",
            },
        )
    },
};

pub(super) const LINK_INERTIA: Entry = Entry {
    mechanism: Mechanism::LinkInertia,
    form: Form::Joint(OfJoint::Link),
    linear: 10,
    passive: false,
    refuted_by: "the described weight and centre of the link on a scale",
    equation: "regressor·(numbers − described numbers), of the link's base parameters",
    facts: Facts {
        at_arm: true,
        in_sets: true,
        usual: Usual::Frequent,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "other inertial numbers of a link",
                look_for: "a payload, a tool, cables, inertias that were guessed",
            },
        )
    },
};

pub(super) const COMPLIANCE: Entry = Entry {
    mechanism: Mechanism::Compliance,
    form: Form::Joint(OfJoint::Compliance),
    linear: 1,
    passive: true,
    refuted_by: "a load that moves as the joint does up to the highest frequency",
    equation: "share of the inertia follows the joint as a resonator of this frequency and damping, free within ±gap/2",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::Resonance,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "parts that bend",
                look_for: "arms, couplings, the clamping of the base",
            },
        )
    },
};

pub(super) const LOAD_BACKLASH: Entry = Entry {
    mechanism: Mechanism::LoadBacklash,
    form: Form::Joint(OfJoint::Gap),
    linear: 1,
    passive: true,
    refuted_by: "a load that moves as the joint does when the drive turns from pushing to braking",
    equation: "inertia·(acceleration of the load − q̈), the load free inside the gap and pushed at its ends",
    facts: Facts {
        in_sets: true,
        usual: Usual::Common,
        shapes: Shapes::Gap,
        form_of: Some(Mechanism::Backlash),
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a gap between the motor and its load, in which the load's inertia is missing",
                look_for: "gear teeth, a coupling, a key, a belt that has grown",
            },
        )
    },
};

#[cfg(test)]
mod tests {
    use super::load_friction;

    #[test]
    fn friction_by_the_load_grows_with_it_or_with_its_power() {
        assert_eq!([1.3, -1.3].map(|e| load_friction(e, &[0.2])), [0.26, 0.26]);
        assert_eq!(load_friction(-3.0, &[0.2, 2.0]), 0.2 * 9.0);
        assert_eq!(load_friction(1.0, &[0.2, 4.0 / 3.0]), 0.2);
    }
}
