//! This file is what a drive cannot do: give more than so much effort, or change it faster than so.

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::{Drive, Entry, Form, parameter};
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::DriveSaturation,
    form: Form::Drive(Drive::Limit),
    linear: 0,
    passive: false,
    refuted_by: "an effort that grows with the command beyond the limit",
    equation: "e = gain·u cut at ±limit, or gain·u/(1 + |gain·u/limit|^sharpness)^(1/sharpness) where it bends towards it",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::EffortLimit,
        ..Facts::of(
            Family::Drive,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Nowhere,
            },
            Words {
                what: "a drive that gives no more than so much",
                look_for: "the amplifier's current limit, its supply voltage, a torque limit in a controller, iron that saturates",
            },
        )
    },
};

pub(super) const RATE_ENTRY: Entry = Entry {
    mechanism: Mechanism::RateLimit,
    form: Form::Drive(Drive::Rate),
    refuted_by: "a large step of the effort that takes no longer than a small one",
    equation: "de/dt = ±rate until e = gain·u",
    facts: Facts {
        usual: Usual::Seldom,
        shapes: Shapes::EffortRate,
        words: Words {
            what: "a drive whose effort changes no faster than so much",
            look_for: "the supply voltage over the motor's inductance, a ramp in the amplifier or the controller",
        },
        ..ENTRY.facts
    },
    ..ENTRY
};

/// An effort or a current that is limited by the parameters of `drive_saturation` or `saturation`: a limit, N, N·m or A, and
/// how sharply it bends towards that (Rapp 1991); without a sharpness it is cut off.
pub fn limited(given: f64, parameters: &[f64]) -> f64 {
    let (limit, sharpness) = (parameter(parameters, 0).abs(), parameter(parameters, 1));
    let size = given.abs();
    if sharpness <= 0.0 || limit == 0.0 {
        return given.clamp(-limit, limit);
    }
    let (less, more) = (size.min(limit), size.max(limit));
    let times = libm::pow(less / more, sharpness);
    given * (limit / more) / libm::pow(1.0 + times, 1.0 / sharpness)
}

/// What follows an effort in a step no farther than `most`, N or N·m.
pub fn slewed(state: f64, effort: f64, most: f64) -> f64 {
    state + (effort - state).clamp(-most, most)
}

/// The same in a step in which the effort is held: the mean in the step, and the end.
pub fn slewed_held(state: f64, effort: f64, most: f64) -> [f64; 2] {
    let end = slewed(state, effort, most);
    // The share of the step in which the effort still changes.
    let share = (end - state).abs() / most;
    [end - 0.5 * share * (end - state), end]
}

#[cfg(test)]
mod tests {
    use super::{limited, slewed, slewed_held};

    #[test]
    fn an_effort_bends_towards_its_limit_and_is_cut_where_it_bends_at_once() {
        assert_eq!([0.3, -5.0].map(|e| limited(e, &[0.7])), [0.3, -0.7]);
        for sharpness in [1.0, 2.0, 5.0] {
            let bent = |e: f64| limited(e, &[0.7, sharpness]);
            // At the limit itself a share of 2^(-1/sharpness) is left.
            let at_limit = 0.7 * libm::exp2(-1.0 / sharpness);
            assert!((bent(0.7) - at_limit).abs() < 1e-15);
            assert!((bent(1e-6) - 1e-6).abs() < 2e-12 && bent(-0.4) == -bent(0.4));
            assert!(bent(1e6) > 0.699 && bent(1e6) <= 0.7, "{}", bent(1e6));
        }
        assert!((limited(0.65, &[0.7, 400.0]) - 0.65).abs() < 1e-6);
        assert!((limited(-7e3, &[0.7, 400.0]) + 0.7).abs() < 1e-15);
        assert_eq!([0.0, 0.3].map(|e| limited(e, &[0.0, 2.0])), [0.0; 2]);
    }

    #[test]
    fn a_step_is_followed_at_the_rate() {
        let mut state = 0.1;
        let path: Vec<f64> = (0..5)
            .map(|_| {
                state = slewed(state, 1.0, 0.25);
                state
            })
            .collect();
        assert_eq!(path, [0.35, 0.6, 0.85, 1.0, 1.0]);
        assert_eq!(slewed(0.2, -3.0, 0.5), -0.3);
        // A ramp through the whole step, and one that ends after two fifths of it.
        let [mean, end] = slewed_held(0.2, -3.0, 0.5);
        assert!((mean + 0.05).abs() < 1e-15 && end == -0.3, "{mean}");
        let [mean, end] = slewed_held(0.2, 0.4, 0.5);
        assert!(
            (mean - (0.4 * 0.3 + 0.6 * 0.4)).abs() < 1e-15 && end == 0.4,
            "{mean}"
        );
    }
}
