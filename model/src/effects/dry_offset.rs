//! This file is dry (Coulomb) friction: a level that opposes motion whatever the speed.

use super::facts::{Alone, Asked, AtRest, Facts, Family, Refit, Usual, Where, Words, first};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DryOffset,
    form: Form::Resistance(|p| {
        Box::new(Dry {
            level: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a resistance that stays the same when the motion reverses, or that vanishes with speed",
    equation: "level·sgn(q̇)",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        usual: Usual::Plain,
        at_rest: AtRest::Dry(first),
        refit: Refit {
            leads: true,
            sizes: &[1.0],
        },
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "dry friction (a drag of the same size at every speed)",
                look_for: "seals, bearings, a brake that does not let go fully",
            },
        )
    },
};

/// The same in a joint without a brake.
pub(super) const BEARING: Entry = Entry {
    mechanism: Mechanism::BearingFriction,
    form: Form::Resistance(|p| {
        Box::new(Dry {
            level: parameter(p, 0),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "a joint without a brake that turns freely when its arms are taken apart",
    equation: "level·sgn(ω) at a joint without a brake",
    facts: Facts {
        at_rest: AtRest::Dry(first),
        form_of: Some(Mechanism::DryOffset),
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Bearings,
            },
            Words {
                what: "friction in a joint without a brake",
                look_for: "its bearing: preload, dirt, a seal",
            },
        )
    },
};

struct Dry {
    level: f64,
}

impl Law for Dry {
    fn dry(&self, _now: &Instant) -> f64 {
        self.level
    }
}
