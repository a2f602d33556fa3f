//! This file converts between the true position of a joint and the one that a faulty encoder shows.

use crate::effect::Effect;
use crate::plant::Clock;
use rigproof_model::effects::{Form, OfSensor, form};

/// The error of the encoder that an effect is; `None` for other effects.
pub(super) fn of_encoder(effect: &Effect) -> Option<OfSensor> {
    match form(effect.mechanism())? {
        form @ Form::Sensor(own) if form.is_of_encoder() => Some(own),
        _ => None,
    }
}

/// The true positions behind the shown ones.
pub(super) fn behind(effects: &[Effect], shown: &[f64], clock: Clock) -> Vec<f64> {
    let mut there = shown.to_vec();
    // The sensor's effects are inverted in reverse order.
    for effect in effects.iter().rev() {
        let Some(of) = of_encoder(effect) else {
            continue;
        };
        for position in there.iter_mut().skip(effect.first_sample(clock)) {
            *position = of.behind(*position, &effect.parameters);
        }
    }
    there
}

/// The positions that the encoder shows for the true ones.
pub(super) fn shown(effects: &[Effect], mut there: Vec<f64>, clock: Clock) -> Vec<f64> {
    for effect in effects {
        let Some(of) = of_encoder(effect) else {
            continue;
        };
        for position in there.iter_mut().skip(effect.first_sample(clock)) {
            *position = of.shown(*position, &effect.parameters);
        }
    }
    there
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn the_angle_behind_is_the_one_that_was_shown() {
        let effects = [
            Effect::of(Mechanism::EncoderScale, &[0.13]),
            Effect::of(Mechanism::EccentricEncoder, &[0.071, -0.043]),
            Effect {
                onset_s: Some(0.0107),
                ..Effect::of(Mechanism::EncoderOffset, &[0.37])
            },
        ];
        let clock = Clock {
            step_s: 1e-3,
            start_s: 0.0,
            samples: 23,
        };
        let there: Vec<f64> = (0..23).map(|k| 0.29 * f64::from(k) - 1.7).collect();
        let seen = shown(&effects, there.clone(), clock);
        let eccentric = 1.13 * there[7] + 0.071 * libm::sin(1.13 * there[7]);
        let expected = eccentric - 0.043 * libm::cos(1.13 * there[7]);
        assert!((seen[7] - expected).abs() < 1e-12);
        for (again, own) in behind(&effects, &seen, clock).iter().zip(&there) {
            assert!((again - own).abs() < 1e-12, "{again} {own}");
        }
    }
}
