//! This file is what an encoder with an error shows, and what is behind what it shows.

use super::{OfSensor, behind_shown, parameter, shown_too_much};

impl OfSensor {
    /// The position that an encoder with this error shows, m or rad. `parameters` are those of its
    /// mechanism. Errors of other sensors change nothing.
    pub fn shown(self, position: f64, parameters: &[f64]) -> f64 {
        match self {
            OfSensor::EncoderScale => position * (1.0 + parameter(parameters, 0)),
            OfSensor::EncoderOffset => position + parameter(parameters, 0),
            OfSensor::Eccentric => position + shown_too_much(position, parameters),
            OfSensor::Clock
            | OfSensor::ForceGain
            | OfSensor::ForceBias
            | OfSensor::ForceRotation => position,
        }
    }

    /// The position at which an encoder with this error shows this one, m or rad.
    pub fn behind(self, shown: f64, parameters: &[f64]) -> f64 {
        match self {
            OfSensor::EncoderScale => shown / (1.0 + parameter(parameters, 0)),
            OfSensor::EncoderOffset => shown - parameter(parameters, 0),
            OfSensor::Eccentric => behind_shown(shown, parameters),
            OfSensor::Clock
            | OfSensor::ForceGain
            | OfSensor::ForceBias
            | OfSensor::ForceRotation => shown,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::OfSensor;

    #[test]
    fn what_is_behind_is_what_was_shown() {
        for (of, parameters) in [
            (OfSensor::EncoderScale, &[0.13][..]),
            (OfSensor::EncoderOffset, &[0.37]),
            (OfSensor::Eccentric, &[0.071, -0.043]),
            (OfSensor::Clock, &[0.1, 0.2]),
        ] {
            let shown = of.shown(0.71, parameters);
            assert!(
                (of.behind(shown, parameters) - 0.71).abs() < 1e-12,
                "{of:?}"
            );
            assert_eq!(shown == 0.71, of == OfSensor::Clock, "{of:?}");
        }
    }
}
