//! This file is what can be wrong with a linkage as a whole: its masses, its weight, the force sensor at its tip.

use super::{Entry, Form};
use rigproof_spec::effect::Mechanism;

const fn entry(
    mechanism: Mechanism,
    linear: usize,
    refuted_by: &'static str,
    equation: &'static str,
) -> Entry {
    Entry {
        mechanism,
        form: Form::Linkage,
        linear,
        passive: false,
        refuted_by,
        equation,
    }
}

pub(super) const BEARING_FRICTION: Entry = Entry {
    passive: true,
    ..entry(
        Mechanism::BearingFriction,
        1,
        "a joint without a brake that turns freely when its arms are taken apart",
        "level·sgn(ω) at a joint without a brake",
    )
};

pub(super) const LOAD_DEPENDENT: Entry = Entry {
    passive: true,
    ..entry(
        Mechanism::LoadDependent,
        1,
        "the same friction whether the hand pulls hard or hardly at all",
        "arm·|F|·sgn(ω), F the force on the tip",
    )
};

pub(super) const GRAVITY: Entry = entry(
    Mechanism::Gravity,
    2,
    "a tip that stays where it is let go, brakes off, wherever that is",
    "Σ mass·(x, y) at each centre of mass: the weight's components in the plane of motion",
);

pub(super) const INERTIA_ERROR: Entry = entry(
    Mechanism::InertiaError,
    5,
    "arms weighed and swung one by one; only their combinations are determined, so that a number of 0 is one that the others stand for",
    "moments of inertia about each arm's first joint and a mass at the tip, added to the nominal ones",
);

pub(super) const PAYLOAD: Entry = entry(
    Mechanism::Payload,
    1,
    "a handle that weighs what the model says",
    "mass at the tip, added to the nominal one",
);

pub(super) const ENCODER_SCALE: Entry = entry(
    Mechanism::EncoderScale,
    1,
    "a full turn that the encoder counts as a full turn",
    "recorded angle = (1 + fraction)·angle",
);

pub(super) const ENCODER_OFFSET: Entry = entry(
    Mechanism::EncoderOffset,
    1,
    "an arm on its stop that the encoder shows there",
    "recorded angle = angle + `angle`",
);

pub(super) const FORCE_GAIN: Entry = entry(
    Mechanism::ForceGain,
    1,
    "a known weight on the force sensor",
    "recorded force = (1 + fraction)·force",
);

pub(super) const FORCE_BIAS: Entry = entry(
    Mechanism::ForceBias,
    2,
    "a force sensor that shows nothing when nobody touches it",
    "recorded force = force + (x, y)",
);

pub(super) const FORCE_ROTATION: Entry = entry(
    Mechanism::ForceRotation,
    0,
    "a pull along an arm that the sensor shows along that arm",
    "recorded force = the force turned by the angle",
);
