//! This file is a greater torque just after a reversal, as §3.5 of the thesis saw it on a brake: a share of its torque that decays with
//! the travel since; and the same of a joint's friction, a force of its own.

use super::facts::{
    Alone, Asked, AtRest, End, Facts, Family, Limit, Shapes, Where, Words, first_if_positive,
};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::{LEAST_TURNING_RAD_S, Mechanism, NOT_MOVED};

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::ReversalOvershoot,
    form: Form::ShareOfBrake(|p| {
        Box::new(Overshoot {
            fraction: parameter(p, 0),
            travel: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "the same resistance just after a reversal and long after it",
    equation: "τ·fraction·exp(−x/travel), x travelled since the sense changed, without an end before it first does",
    facts: Facts {
        turn: 3,
        has_forms: true,
        shapes: Shapes::Geometric {
            low: 0.01,
            high: 1.5,
            count: 6,
        },
        at_rest: AtRest::OfBrake(first_if_positive),
        limit: Some(Limit {
            of: Mechanism::GainError,
            parameter: 1,
            end: End::Everything,
        }),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::WithBrake,
                five_bar: Where::Brakes,
            },
            Words {
                what: "a brake that grips harder just after each reversal",
                look_for: "the brake's fluid, which has to yield anew",
            },
        )
    },
};

pub(super) const OF_FRICTION: Entry = Entry {
    mechanism: Mechanism::FrictionOvershoot,
    form: Form::Resistance(|p| {
        Box::new(Overshoot {
            fraction: parameter(p, 0),
            travel: parameter(p, 1),
        })
    }),
    equation: "level·exp(−x/travel)·sgn(q̇), x travelled since the sense changed, without an end before it first does",
    facts: Facts {
        has_forms: true,
        shapes: Shapes::Bristle,
        limit: Some(Limit {
            of: Mechanism::DryOffset,
            parameter: 1,
            end: End::Everything,
        }),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "friction that is higher just after each reversal and falls with the way gone since",
                look_for: "seals and grease that have to yield anew, a belt or a cable that settles",
            },
        )
    },
    ..ENTRY
};

/// The memory is the share of its travel that a joint has gone since it turned, with the sense in which it goes: every change of
/// sense begins anew, the first motion does not: it is no reversal.
struct Overshoot {
    /// What it begins with: a share of a brake's torque, or a force.
    fraction: f64,
    travel: f64,
}

impl Law for Overshoot {
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        if memory == NOT_MOVED {
            return 0.0;
        }
        // Half a sense is one that the recording cannot tell, not half of what is remembered.
        let since = (memory * now.sense.signum()).max(0.0);
        self.fraction * (1.0 - since) * now.sense
    }

    fn parts(&self, _now: &Instant, memory: f64) -> (f64, f64) {
        if memory == NOT_MOVED {
            return (0.0, 0.0);
        }
        let half = 0.5 * self.fraction;
        (-half * memory, self.fraction - half * memory.abs())
    }

    fn remembers(&self) -> bool {
        true
    }

    fn starts_with(&self) -> f64 {
        NOT_MOVED
    }

    fn begins_anew(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        (now.speed - now.speed.abs() * memory) / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, speed: f64) -> f64 {
        if memory == NOT_MOVED {
            let moves = speed.abs() > LEAST_TURNING_RAD_S;
            return if moves { speed.signum() } else { memory };
        }
        let turned = memory * speed < 0.0 && speed.abs() > LEAST_TURNING_RAD_S;
        let memory = if turned { 0.0 } else { memory };
        relaxed(memory, travel.signum(), travel, self.travel)
    }
}
