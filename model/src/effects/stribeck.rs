//! This file is the Stribeck peak: dry friction that is higher near standstill (Stribeck 1902; the exponent
//! is 1 after Tustin 1947, 2 after Bo and Pavelescu 1982; Armstrong-Hélouvry 1994). Friction follows the speed with a delay that
//! is a travel rather than a time (Hess and Soom 1990; Canudas de Wit et al. 1995).

use super::facts::{
    Alone, Asked, AtRest, Facts, Family, Shapes, Usual, Where, Words, first_if_positive,
};
use super::{Entry, Form, Instant, Law, parameter, relaxed};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::Stribeck,
    form: Form::Resistance(|p| {
        Box::new(Stribeck {
            peak: parameter(p, 0),
            speed: parameter(p, 1),
            exponent: parameter(p, 2),
            travel: parameter(p, 3),
        })
    }),
    linear: 1,
    passive: true,
    refuted_by: "the same resistance while slowing down to rest as in fast motion",
    equation: "peak·exp(−|q̇/speed|^exponent)·sgn(q̇), reached within `travel` where there is one",
    facts: Facts {
        in_a_sweep: true,
        at_arm: true,
        of_torque: true,
        usual: Usual::Frequent,
        turn: 2,
        has_forms: true,
        shapes: Shapes::Peak,
        at_rest: AtRest::Dry(first_if_positive),
        ..Facts::of(
            Family::FrictionOfMotion,
            Asked {
                alone: Alone::Always,
                five_bar: Where::Brakes,
            },
            Words {
                what: "extra friction at low speed that lets go as the motion gets faster",
                look_for: "lubrication that only builds up with speed; it makes slow motion jerk",
            },
        )
    },
};

struct Stribeck {
    peak: f64,
    speed: f64,
    exponent: f64,
    /// 0 where the friction follows at once.
    travel: f64,
}

impl Stribeck {
    fn share(&self, speed: f64) -> f64 {
        libm::exp(-libm::pow((speed / self.speed).abs(), self.exponent))
    }
}

impl Law for Stribeck {
    fn smooth(&self, _now: &Instant, memory: f64) -> f64 {
        match self.remembers() {
            true => self.peak * memory,
            false => 0.0,
        }
    }

    fn dry(&self, now: &Instant) -> f64 {
        match self.remembers() {
            true => 0.0,
            false => self.peak * self.share(now.speed),
        }
    }

    fn remembers(&self) -> bool {
        self.travel > 0.0
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        match self.remembers() {
            true => (now.speed * self.share(now.speed) - now.speed.abs() * memory) / self.travel,
            false => 0.0,
        }
    }

    fn memory_after(&self, memory: f64, travel: f64, speed: f64) -> f64 {
        match self.remembers() {
            true => relaxed(
                memory,
                self.share(speed).copysign(travel),
                travel,
                self.travel,
            ),
            false => memory,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::law;
    use super::*;

    /// The resistance after turning by `turned` at a speed that holds.
    fn resistance(shape: &[f64], speed: f64, turned: f64) -> f64 {
        let own = law(Mechanism::Stribeck, shape).unwrap();
        let now = Instant {
            time_s: 0.3,
            position: 1.7,
            speed,
            sense: speed.signum(),
        };
        let (steps, mut memory) = (20_000, 0.0);
        let step_s = turned / speed.abs() / f64::from(steps);
        for _ in 0..steps {
            memory += step_s * own.memory_rate(&now, memory);
        }
        own.smooth(&now, memory) + own.dry(&now) * now.sense
    }

    #[test]
    fn a_delayed_peak_comes_to_the_level_of_the_speed_within_its_travel() {
        let at_once = [0.37, 0.23, 1.7];
        for speed in [0.11, -0.31] {
            let level = resistance(&at_once, speed, 0.01);
            let delayed = |turned| resistance(&[0.37, 0.23, 1.7, 0.019], speed, turned);
            assert!((delayed(0.5) / level - 1.0).abs() < 1e-3);
            let after_one = delayed(0.019) / level;
            assert!(
                (after_one - (1.0 - libm::exp(-1.0))).abs() < 1e-3,
                "{after_one}"
            );
        }
    }
}
