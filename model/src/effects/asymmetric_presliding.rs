//! This file is elastic motion before sliding with another limit in each direction: a Dahl bristle (P. R. Dahl, 1968) whose steady
//! friction depends on the sense, as levels of friction do (Armstrong-Hélouvry, Dupont and Canudas de Wit, 1994).
//!
//! Once it has slid, it is a bristle with the mean of both limits and a constant of half their difference beside it; a recording tells them
//! apart where it begins relaxed, because the constant is there at once. It takes energy in every closed cycle as long as no limit is negative.

use super::facts::{Alone, Asked, AtRest, Facts, Family, Shapes, Where, Words};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

/// Limits from nothing to the yield of a brake (some N·m or N), both together above nothing; travel above nothing, up to a few tenths of a radian.
pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::AsymmetricPresliding,
    form: Form::Resistance(|p| {
        Box::new(OneSided {
            forward: parameter(p, 0),
            backward: parameter(p, 1),
            travel: parameter(p, 2),
        })
    }),
    linear: 2,
    passive: true,
    refuted_by: "the same friction in both directions, or a constant force before anything has moved",
    equation: "z, travel·dz/dt = |q̇|·(forward − z) forward, −|q̇|·(backward + z) backward",
    facts: Facts {
        has_forms: true,
        shapes: Shapes::Bristle,
        at_rest: AtRest::Level(|numbers| numbers.iter().copied().fold(0.0, f64::max)),
        both: Some([Mechanism::Presliding, Mechanism::ConstantBias]),
        ..Facts::of(
            Family::MemoryOfMotion,
            Asked {
                alone: Alone::Never,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "springy give before sliding begins, and sliding friction that differs between the two directions",
                look_for: "friction surfaces that bend before they slip, and what loads them to one side",
            },
        )
    },
};

struct OneSided {
    forward: f64,
    backward: f64,
    travel: f64,
}

impl OneSided {
    /// What the bristle comes to when it slides in a sense.
    fn limit(&self, sense: f64) -> f64 {
        if sense > 0.0 {
            self.forward
        } else {
            -self.backward
        }
    }
}

/// The memory is the resistance itself, N or N·m.
impl Law for OneSided {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        memory
    }

    fn remembers(&self) -> bool {
        true
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        (self.limit(now.speed) - memory) * now.speed.abs() / self.travel
    }

    fn memory_after(&self, memory: f64, travel: f64, _speed: f64) -> f64 {
        relaxed(memory, self.limit(travel), travel, self.travel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_comes_to_another_limit_in_each_direction_and_takes_energy_in_between() {
        let law = OneSided {
            forward: 0.31,
            backward: 0.07,
            travel: 0.013,
        };
        let slid = law.memory_after(0.0, 0.4, 1.0);
        assert!((slid - 0.31).abs() < 1e-12);
        let back = law.memory_after(slid, -0.4, -1.0);
        assert!((back + 0.07).abs() < 1e-12);
        // Half way to a limit after ln 2 of the travel.
        let half = law.memory_after(slid, -0.013 * core::f64::consts::LN_2, -1.0);
        assert!((half - 0.12).abs() < 1e-12);
        // The tenth of ten short cycles: by then nothing is stored or given back from one to the next.
        let (mut memory, mut work) = (slid, 0.0);
        for k in 0..20_000 {
            let travel = if k % 2000 < 1000 { -1e-5 } else { 1e-5 };
            let after = law.memory_after(memory, travel, travel);
            if k >= 18_000 {
                work += 0.5 * (memory + after) * travel;
            }
            memory = after;
        }
        assert!(work > 1e-4, "{work} J");
    }

    #[test]
    fn once_slid_it_is_a_bristle_with_a_constant_beside_it() {
        let unequal = OneSided {
            forward: 0.31,
            backward: 0.07,
            travel: 0.013,
        };
        let equal = OneSided {
            forward: 0.19,
            backward: 0.19,
            travel: 0.013,
        };
        let (mut one, mut other) = (unequal.limit(1.0), equal.limit(1.0));
        for travel in [-0.004, 0.017, -0.021, 0.002, -0.003] {
            one = unequal.memory_after(one, travel, travel);
            other = equal.memory_after(other, travel, travel);
            assert!((one - (other + 0.12)).abs() < 1e-12);
        }
    }
}
