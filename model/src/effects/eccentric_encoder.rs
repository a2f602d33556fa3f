//! This file is an encoder whose error repeats: once a turn where its disc turns off its centre, and once or twice a line where its two signals are no sine and cosine of one size (Heydemann 1981).

use super::facts::{Alone, Asked, Facts, Family, Shapes, Usual, Where, Words};
use super::ripple::wave;
use super::{Entry, Form, OfSensor, parameter};
use core::f64::consts::TAU;
use rigproof_spec::effect::Mechanism;

pub(super) const ENTRY: Entry = Entry {
    mechanism: Mechanism::EccentricEncoder,
    form: Form::Sensor(OfSensor::Eccentric),
    linear: 2,
    passive: false,
    refuted_by: "a turn whose halves, and lines whose halves, the encoder counts alike",
    equation: "recorded angle = q + sine·sin(2π·q/period) + cosine·cos(2π·q/period), once a turn without `period`",
    facts: Facts {
        in_sets: true,
        usual: Usual::Seldom,
        shapes: Shapes::Pitch,
        ..Facts::of(
            Family::Sensor,
            Asked {
                alone: Alone::Driven,
                five_bar: Where::Encoders,
            },
            Words {
                what: "an encoder that shows too much in one half of a turn, or of a line, and too little in the other",
                look_for: "the centring of its disc, a bent shaft, offset and size of its two signals, teeth before it",
            },
        )
    },
};

/// What an encoder shows too much at a position, m or rad, by the parameters of `eccentric_encoder`.
pub fn shown_too_much(position: f64, parameters: &[f64]) -> f64 {
    let period = parameters.get(2).copied().unwrap_or(TAU);
    wave([0, 1].map(|k| parameter(parameters, k)), position, period)
}

/// Rounds of the iteration that finds the position behind a shown one. Each multiplies the error by the slope of what is shown too much.
const ROUNDS: usize = 24;

/// The position at which an encoder shows this one, m or rad.
pub fn behind_shown(shown: f64, parameters: &[f64]) -> f64 {
    let mut there = shown;
    for _ in 0..ROUNDS {
        let before = there;
        there = shown - shown_too_much(before, parameters);
        if there == before {
            break;
        }
    }
    there
}

#[cfg(test)]
mod tests {
    use super::{behind_shown, shown_too_much};
    use core::f64::consts::TAU;

    #[test]
    fn an_error_repeats_once_a_turn_or_once_a_period() {
        assert_eq!(shown_too_much(0.7, &[0.3, 0.0]), 0.3 * libm::sin(0.7));
        for (numbers, period) in [(vec![0.02, -0.01], TAU), (vec![0.02, -0.01, 0.31], 0.31)] {
            let again = shown_too_much(0.7 + period, &numbers);
            assert!((again - shown_too_much(0.7, &numbers)).abs() < 1e-15);
            let shown = 0.7 + again;
            assert!((behind_shown(shown, &numbers) - 0.7).abs() < 1e-9);
        }
    }
}
