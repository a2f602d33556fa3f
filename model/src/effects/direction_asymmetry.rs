//! This file is friction that differs between the two directions of motion (a worn screw, a preloaded nut).

use super::facts::{Alone, Asked, AtRest, End, Facts, Family, Limit, Refit, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DirectionAsymmetry,
    form: Form::Resistance(|p| {
        Box::new(Asymmetry {
            viscous: parameter(p, 0),
            dry: parameter(p, 1),
        })
    }),
    linear: 2,
    passive: false,
    refuted_by: "equal resistance at equal speed in both directions",
    equation: "viscous·|q̇| + dry·[q̇ ≠ 0]",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        of_torque: true,
        usual: Usual::Rare,
        turn: 2,
        // It shifts both breakaway levels.
        at_rest: AtRest::Level(|numbers| parameter(numbers, 1).abs()),
        limit: Some(Limit {
            of: Mechanism::ConstantBias,
            parameter: 0,
            end: End::Nothing,
        }),
        twin: Some(Mechanism::ConstantBias),
        refit: Refit {
            leads: false,
            sizes: &[0.0, 1.0],
        },
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "friction that differs between the two directions",
                look_for: "preload, a worn or tilted bearing, a seal that lies over",
            },
        )
    },
};

/// Half the difference between the positive and the negative direction.
struct Asymmetry {
    viscous: f64,
    dry: f64,
}

impl Law for Asymmetry {
    /// In motion the dry part does not change sign with the sense, so it is no dry level but a constant; at rest
    /// it shifts the two breakaway levels, because each is tried with its own sense.
    fn smooth(&self, now: &Instant, _memory: f64) -> f64 {
        let dry = if now.sense == 0.0 { 0.0 } else { self.dry };
        self.viscous * now.speed.abs() + dry
    }
}
