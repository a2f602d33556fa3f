//! This file is what can be wrong with a linkage as a whole: its masses, its weight, the force sensor at its tip.

use super::facts::{
    Alone, Asked, AtRest, End, Facts, Family, Limit, Shapes, Usual, Where, Words, first,
};
use super::{Entry, Form, OfLinkage, OfSensor};
use rigproof_spec::effect::Mechanism;

pub(super) const LOAD_DEPENDENT: Entry = Entry {
    mechanism: Mechanism::LoadDependent,
    form: Form::Linkage(OfLinkage::Load),
    linear: 1,
    passive: true,
    refuted_by: "the same friction whether the hand pulls hard or hardly at all",
    equation: "arm·|F|·sgn(ω), F the force on the tip",
    facts: Facts {
        usual: Usual::Seldom,
        turn: 7,
        has_forms: true,
        at_rest: AtRest::OfLoad(first),
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Brakes,
            },
            Words {
                what: "friction that grows with the load",
                look_for: "bearings under side load",
            },
        )
    },
};

pub(super) const GRAVITY: Entry = Entry {
    mechanism: Mechanism::Gravity,
    form: Form::Linkage(OfLinkage::Weight),
    linear: 2,
    passive: false,
    refuted_by: "a tip that stays where it is let go, brakes off, wherever that is",
    equation: "Σ mass·(x, y) at each centre of mass: the weight's components in the plane of motion",
    facts: Facts::of(
        Family::Constant,
        Asked {
            alone: Alone::Never,
            five_bar: Where::Whole,
        },
        Words {
            what: "weight, because the mechanism is not level",
            look_for: "a spirit level on the base",
        },
    ),
};

pub(super) const INERTIA_ERROR: Entry = Entry {
    mechanism: Mechanism::InertiaError,
    form: Form::Linkage(OfLinkage::Inertias),
    linear: 5,
    passive: false,
    refuted_by: "arms weighed and swung one by one; only their combinations are determined, so that a number of 0 is one that the others stand for",
    equation: "moments of inertia about each arm's first joint and a mass at the tip, added to the nominal ones",
    facts: Facts {
        turn: 2,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "moving parts that are heavier or lighter than the model's",
                look_for: "parts that were changed, their masses and lengths",
            },
        )
    },
};

pub(super) const INERTIA_SCALE: Entry = Entry {
    mechanism: Mechanism::InertiaScale,
    form: Form::Linkage(OfLinkage::InertiaScale),
    linear: 1,
    refuted_by: "arms and handle that weigh what the model says; a force sensor and brakes that are all wrong by one factor do the same",
    equation: "(1 + fraction)·(mass matrix·q̈ + velocity terms)",
    facts: Facts {
        form_of: Some(Mechanism::InertiaError),
        words: Words {
            what: "moving parts that are all heavier or lighter than the model's by one factor",
            look_for: "the density in the drawing, the whole linkage on a scale",
        },
        ..INERTIA_ERROR.facts
    },
    ..INERTIA_ERROR
};

pub(super) const PAYLOAD: Entry = Entry {
    mechanism: Mechanism::Payload,
    form: Form::Linkage(OfLinkage::Payload),
    linear: 1,
    passive: true,
    refuted_by: "a handle that weighs what the model says",
    equation: "mass at the tip, added to the nominal one",
    facts: Facts {
        at_arm: true,
        usual: Usual::Frequent,
        turn: 1,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "extra weight at the tip",
                look_for: "a handle or a sensor that the model does not know",
            },
        )
    },
};

pub(super) const ENCODER_SCALE: Entry = Entry {
    mechanism: Mechanism::EncoderScale,
    form: Form::Sensor(OfSensor::EncoderScale),
    linear: 1,
    passive: false,
    refuted_by: "a full turn that the encoder counts as a full turn",
    equation: "recorded angle = (1 + fraction)·angle",
    facts: Facts {
        usual: Usual::Seldom,
        shapes: Shapes::Values(&[0.005, -0.005, 0.04, -0.04]),
        limit: Some(Limit {
            of: Mechanism::EncoderOffset,
            parameter: 0,
            end: End::Nothing,
        }),
        zero: Some(Mechanism::EncoderOffset),
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::WithInertia,
                five_bar: Where::Encoders,
            },
            Words {
                what: "an angle or position that is measured too large or too small",
                look_for: "counts per turn, gear ratio",
            },
        )
    },
};

pub(super) const ENCODER_OFFSET: Entry = Entry {
    mechanism: Mechanism::EncoderOffset,
    form: Form::Sensor(OfSensor::EncoderOffset),
    linear: 1,
    passive: false,
    refuted_by: "an arm on its stop that the encoder shows there",
    equation: "recorded angle = angle + `angle`",
    facts: Facts {
        shapes: Shapes::Values(&[0.01, -0.01, 0.06, -0.06]),
        at_transmission: true,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Encoders,
            },
            Words {
                what: "an angle or position with the wrong zero",
                look_for: "the homing of the encoder",
            },
        )
    },
};

pub(super) const FORCE_GAIN: Entry = Entry {
    mechanism: Mechanism::ForceGain,
    form: Form::Sensor(OfSensor::ForceGain),
    linear: 1,
    passive: false,
    refuted_by: "a known weight on the force sensor",
    equation: "recorded force = (1 + fraction)·force",
    facts: Facts {
        turn: 3,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "a force sensor that reads too much or too little",
                look_for: "its calibration, its range setting",
            },
        )
    },
};

pub(super) const FORCE_BIAS: Entry = Entry {
    mechanism: Mechanism::ForceBias,
    form: Form::Sensor(OfSensor::ForceBias),
    linear: 2,
    passive: false,
    refuted_by: "a force sensor that shows nothing when nobody touches it",
    equation: "recorded force = force + (x, y)",
    facts: Facts {
        turn: 3,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "a force sensor whose zero is off",
                look_for: "tare it with nothing attached",
            },
        )
    },
};

pub(super) const FORCE_ROTATION: Entry = Entry {
    mechanism: Mechanism::ForceRotation,
    form: Form::Sensor(OfSensor::ForceRotation),
    linear: 0,
    passive: false,
    refuted_by: "a pull along an arm that the sensor shows along that arm",
    equation: "recorded force = the force turned by the angle",
    facts: Facts {
        turn: 3,
        shapes: Shapes::BothSigns {
            low: 0.003,
            high: 0.39,
            count: 8,
        },
        nothing: Some(0.0),
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "a force sensor that is mounted turned",
                look_for: "its axes against those of the rig",
            },
        )
    },
};

pub(super) const PLANE_SPRING: Entry = Entry {
    mechanism: Mechanism::PlaneSpring,
    form: Form::Linkage(OfLinkage::PlaneSpring),
    linear: 2,
    passive: false,
    refuted_by: "a tip that stays where it is let go, wherever that is",
    equation: "(stiffness·r − tension) along r, from the tip to the anchor (x, y)",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::Anchor,
        ..Facts::of(
            Family::Position,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Whole,
            },
            Words {
                what: "a spring between the tip and the frame",
                look_for: "a cable, a hose, a counterbalance",
            },
        )
    },
};

pub(super) const LINK_LENGTH: Entry = Entry {
    mechanism: Mechanism::LinkLength,
    form: Form::Linkage(OfLinkage::LinkLength),
    linear: 1,
    passive: false,
    refuted_by: "arms measured between their axes",
    equation: "an arm is longer by so much",
    facts: Facts {
        in_sets: true,
        usual: Usual::Rare,
        ..Facts::of(
            Family::Inertia,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Joints,
            },
            Words {
                what: "an arm of another length than described",
                look_for: "its drawing, a replaced part",
            },
        )
    },
};
