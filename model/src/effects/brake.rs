//! This file is what a brake may do with its current other than the model says: backlash, memory, delay, limit, heat.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, OfBrake};
use rigproof_spec::effect::Mechanism;

pub(super) const BACKLASH_WIDTH: Entry = Entry {
    mechanism: Mechanism::BacklashWidth,
    form: Form::Brake(OfBrake::BacklashWidth),
    linear: 0,
    passive: false,
    refuted_by: "a full torque after a reversal at the angle of §3.4.3",
    equation: "the off-state torque within `width` after a reversal, instead of the width of table 3.1",
    facts: Facts {
        turn: 8,
        shapes: Shapes::Geometric {
            low: 0.003,
            high: 0.12,
            count: 8,
        },
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "play at reversals that is wider or narrower than the model's",
                look_for: "couplings, keys and gears beside the brake",
            },
        )
    },
};

pub(super) const CURRENT_HYSTERESIS: Entry = Entry {
    mechanism: Mechanism::CurrentHysteresis,
    form: Form::Brake(OfBrake::CurrentHysteresis),
    linear: 0,
    passive: true,
    refuted_by: "the same torque on the way up and on the way down of a slow current triangle",
    equation: "τ follows I + share·(p − I), p the play of half width `half_width` that the current moves; its sides meet at 0 from `closing` down; with `spread` the mean of plays whose half widths reach down to (1 − spread)·half_width; with `top` in the scale in which it is I where I has risen to `top`",
    facts: Facts {
        in_a_sweep: true,
        turn: 6,
        has_forms: true,
        shapes: Shapes::CurrentPlay {
            low: 0.01,
            high: 0.5,
            count: 7,
        },
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that remembers its earlier current",
                look_for: "steel that stays magnetised after the current was higher",
            },
        )
    },
};

pub(super) const DEAD_TIME: Entry = Entry {
    mechanism: Mechanism::DeadTime,
    form: Form::Brake(OfBrake::DeadTime),
    linear: 0,
    passive: false,
    refuted_by: "a torque that begins to change at the sample of the command",
    equation: "τ follows I(t − delay)",
    facts: Facts {
        turn: 5,
        shapes: Shapes::Delay,
        nothing: Some(0.0),
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a drive or brake that answers late",
                look_for: "a bus, a buffer, a sample taken too late",
            },
        )
    },
};

pub(super) const SATURATION: Entry = Entry {
    mechanism: Mechanism::Saturation,
    form: Form::Brake(OfBrake::Saturation),
    linear: 0,
    passive: false,
    refuted_by: "a torque that grows with the current beyond the limit",
    equation: "τ follows I cut at limit, or I/(1 + (I/limit)^sharpness)^(1/sharpness) where it bends towards it",
    facts: Facts {
        in_a_sweep: true,
        usual: Usual::Common,
        turn: 5,
        shapes: Shapes::CurrentLimit,
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a command that is cut off at a limit or bends towards it",
                look_for: "the amplifier's limit or its supply, iron that saturates",
            },
        )
    },
};

pub(super) const THERMAL_FADE: Entry = Entry {
    mechanism: Mechanism::ThermalFade,
    form: Form::Brake(OfBrake::ThermalFade),
    linear: 1,
    passive: true,
    refuted_by: "the same torque before and after long dissipation",
    equation: "τ·(1 − per_joule·E), dE/dt = τ·|ω| − E/cooling",
    facts: Facts {
        turn: 6,
        has_forms: true,
        // Heat is one reason why a torque changes with time.
        form_of: Some(Mechanism::TorqueDrift),
        shapes: Shapes::Geometric {
            low: 3.0,
            high: 300.0,
            count: 4,
        },
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that weakens as it warms up",
                look_for: "its temperature: let it cool and repeat",
            },
        )
    },
};

pub(super) const TIME_CONSTANT: Entry = Entry {
    mechanism: Mechanism::TimeConstant,
    form: Form::Brake(OfBrake::TimeConstant),
    linear: 0,
    passive: false,
    refuted_by: "a torque that follows a step of the current as fast as its table says",
    equation: "the brake's time constants × scale, the falling one × falling where that is another",
    facts: Facts {
        in_sets: true,
        usual: Usual::Common,
        shapes: Shapes::Edges {
            low: 0.4,
            high: 4.0,
            count: 11,
        },
        nothing: Some(1.0),
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that answers slower or faster than its table says",
                look_for: "the age of the fluid, its temperature, residual magnetism",
            },
        )
    },
};

pub(super) const CURRENT_GAIN: Entry = Entry {
    mechanism: Mechanism::CurrentGain,
    form: Form::Brake(OfBrake::CurrentGain),
    linear: 0,
    passive: false,
    refuted_by: "the commanded current through the coil",
    equation: "τ follows scale·I",
    facts: Facts {
        in_a_sweep: true,
        in_sets: true,
        usual: Usual::Frequent,
        shapes: Shapes::Geometric {
            low: 0.6,
            high: 1.6,
            count: 9,
        },
        nothing: Some(1.0),
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "an amplifier that gives more or less current than it is told",
                look_for: "the amplifier's scale and offset",
            },
        )
    },
};

pub(super) const COMMAND_EXPONENT: Entry = Entry {
    mechanism: Mechanism::CommandExponent,
    form: Form::Brake(OfBrake::CommandExponent),
    linear: 0,
    passive: false,
    refuted_by: "settled efforts on the stated curve at several commands",
    equation: "τ follows full·(u/full)^exponent in place of u",
    facts: Facts {
        in_a_sweep: true,
        in_sets: true,
        usual: Usual::Common,
        shapes: Shapes::CommandExponent(&[0.5, 0.7, 0.85, 1.2, 1.5, 2.0, 2.5]),
        nothing: Some(1.0),
        ..Facts::of(
            Family::Brake,
            Asked {
                alone: Alone::WithCharacteristic,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a brake whose effort grows with its command along another curve than stated",
                look_for: "the settled effort at several commands: field that grows with the square of the current, iron that saturates",
            },
        )
    },
};

/// How often the rising and the falling time constants of a brake are what they were, by the numbers of their effect.
pub fn slower(numbers: &[f64]) -> [f64; 2] {
    let rising = numbers.first().copied().unwrap_or(1.0);
    [rising, numbers.get(1).copied().unwrap_or(rising)]
}

/// A command on another curve that ends at the same greatest one, by the numbers of its effect.
pub fn bent_command(command: f64, numbers: &[f64]) -> f64 {
    match numbers {
        [exponent, full, ..] => {
            full * libm::pow((command / full).abs(), *exponent).copysign(command)
        }
        _ => command,
    }
}
