//! This file is a gap that is crossed after a reversal: while it is, the friction of what lies behind it is missing.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Entry, Form, Instant, Law, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Backlash,
    form: Form::Resistance(|p| {
        Box::new(Gap {
            missing: parameter(p, 0),
            gap: parameter(p, 1),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "full friction from the first instant after a reversal",
    equation: "−missing·sgn(q̇) while 0 < x < gap, x the travel across the gap",
    facts: Facts {
        in_sets: true,
        usual: Usual::Common,
        has_forms: true,
        shapes: Shapes::Gap,
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a gap that is crossed after every reversal, in which friction is missing",
                look_for: "gear teeth, couplings, keys, a worn nut",
            },
        )
    },
};

struct Gap {
    missing: f64,
    gap: f64,
}

impl Law for Gap {
    /// The memory is how far the gap is crossed.
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        match memory > 0.0 && memory < self.gap {
            true => -self.missing * now.sense,
            false => 0.0,
        }
    }

    fn remembers(&self) -> bool {
        true
    }

    /// Where in the gap it begins is not known: in its middle it is mistaken least.
    fn starts_with(&self) -> f64 {
        0.5 * self.gap
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        let goes_out =
            (memory >= self.gap && now.speed > 0.0) || (memory <= 0.0 && now.speed < 0.0);
        match goes_out {
            true => 0.0,
            false => now.speed,
        }
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        (memory + travel).clamp(0.0, self.gap)
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    #[test]
    fn friction_is_missing_for_the_width_of_the_gap_after_each_reversal() {
        let own = law(Mechanism::Backlash, &[0.3, 0.04]).unwrap();
        let now = |sense: f64| Instant {
            time_s: 0.0,
            position: 0.0,
            speed: sense,
            sense,
        };
        let mut memory = own.memory_after(own.starts_with(), 1.0, 1.0);
        assert_eq!(own.smooth(&now(1.0), memory), 0.0);
        memory = own.memory_after(memory, -0.013, -1.0);
        assert!((own.smooth(&now(-1.0), memory) - 0.3).abs() < 1e-15);
        memory = own.memory_after(memory, -0.028, -1.0);
        assert_eq!(own.smooth(&now(-1.0), memory), 0.0);
    }
}
