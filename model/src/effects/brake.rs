//! This file is what a brake may do with its current other than the model says: backlash, memory, delay, limit, heat.

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
        form: Form::Brake,
        linear,
        passive: false,
        refuted_by,
        equation,
    }
}

pub(super) const BACKLASH_WIDTH: Entry = entry(
    Mechanism::BacklashWidth,
    0,
    "a full torque after a reversal at the angle of §3.4.3",
    "the off-state torque within `width` after a reversal, instead of the width of table 3.1",
);

pub(super) const CURRENT_HYSTERESIS: Entry = entry(
    Mechanism::CurrentHysteresis,
    1,
    "the same torque on the way up and on the way down of a slow current triangle",
    "τ follows I + share·(p − I), p the play of half width `half_width` that the current moves; its sides meet at 0 from `closing` down",
);

pub(super) const DEAD_TIME: Entry = entry(
    Mechanism::DeadTime,
    0,
    "a torque that begins to change at the sample of the command",
    "τ follows I(t − delay)",
);

pub(super) const SATURATION: Entry = entry(
    Mechanism::Saturation,
    0,
    "a torque that grows with the current beyond the limit",
    "τ follows min(I, limit)",
);

pub(super) const THERMAL_FADE: Entry = entry(
    Mechanism::ThermalFade,
    1,
    "the same torque before and after long dissipation",
    "τ·(1 − per_joule·E), dE/dt = τ·|ω| − E/cooling",
);
