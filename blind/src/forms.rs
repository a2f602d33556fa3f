//! This file says in which forms a case may hide physics, and by which names a diagnosis is right about them.

use crate::effect::{Effect, Scales};
use crate::error::Error;
use crate::form::Form;
use serde::{Deserialize, Serialize};

/// The family that a case is drawn from.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Forms {
    /// Laws in the form in which a textbook has them.
    #[default]
    Usual,
    /// The same physics in other forms from the literature, in machines whose numbers are partly known.
    Other,
}

impl Forms {
    /// Both families.
    pub const ALL: [Forms; 2] = [Forms::Usual, Forms::Other];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Forms::Usual => "usual",
            Forms::Other => "other",
        }
    }

    /// The family of a name.
    ///
    /// # Errors
    /// [`Error::UnknownForms`] for any other text.
    pub fn from_name(name: &str) -> Result<Forms, Error> {
        let mut all = Forms::ALL.into_iter();
        all.find(|forms| forms.name() == name)
            .ok_or_else(|| Error::UnknownForms(name.to_owned()))
    }

    /// Whether it is the family that has no other name.
    pub fn is_usual(&self) -> bool {
        *self == Forms::Usual
    }
}

/// What a diagnosis may say of an effect.
pub struct Names {
    /// Any of these is right.
    pub right: &'static [&'static str],
    /// These are not false beside a right one: what the form looks like in part.
    pub companions: &'static [&'static str],
}

impl Names {
    /// The names of an effect; none is right outside the library.
    pub const fn of(effect: &Effect) -> Names {
        let (right, companions): (&[&str], &[&str]) = match effect.form {
            Form::Coulomb | Form::Bearing if matches!(effect.scales, Scales::Drive) => {
                (&["gain_error", "current_gain"], &[])
            }
            Form::Coulomb => (&["dry_offset"], &[]),
            Form::Viscous => (&["viscous"], &[]),
            Form::Bearing => (&["bearing_friction", "dry_offset", "viscous"], &[]),
            Form::Asymmetric => (&["direction_asymmetry"], &["constant_bias", "gain_error"]),
            Form::Stribeck | Form::Rational => (&["stribeck"], &["dry_offset", "viscous"]),
            Form::Travelled | Form::Lugre => (
                &["stribeck", "lugre_bristle"],
                &[
                    "presliding",
                    "dahl_bristle",
                    "hysteresis",
                    "dry_offset",
                    "viscous",
                ],
            ),
            Form::Dahl
            | Form::DahlPower
            | Form::Bristle
            | Form::ElastoPlastic
            | Form::MaxwellSlip
            | Form::BoucWen => (
                &["presliding", "dahl_bristle", "lugre_bristle", "hysteresis"],
                &["dry_offset", "asymmetric_presliding"],
            ),
            Form::OneSided => (
                &["asymmetric_presliding", "presliding", "hysteresis"],
                &["constant_bias", "dry_offset"],
            ),
            Form::Square | Form::Power => (&["velocity_power"], &["viscous"]),
            Form::Root | Form::Tanh => {
                (&["velocity_power"], &["viscous", "dry_offset", "stribeck"])
            }
            Form::Bias => (&["constant_bias"], &[]),
            Form::Drift | Form::Creep => (&["bias_drift"], &["constant_bias"]),
            Form::Spring => (&["spring"], &[]),
            Form::Anchored => (&["spring"], &["constant_bias"]),
            Form::Tether => (&["joint_stop"], &[]),
            Form::Cubic | Form::Hardening => (&["nonlinear_spring"], &["spring"]),
            Form::Ripple | Form::TwoOrders | Form::Toothed => (&["ripple"], &[]),
            Form::Uneven => (&["uneven_friction"], &["dry_offset"]),
            Form::LoadShare | Form::LoadArm | Form::LoadSquare => (
                &["load_dependent", "load_friction"],
                &["gain_error", "dry_offset"],
            ),
            Form::LoadSided => (
                &["load_dependent", "load_friction"],
                &["gain_error", "dry_offset", "direction_asymmetry"],
            ),
            _ => return Names::elsewhere(effect),
        };
        Names { right, companions }
    }

    const fn elsewhere(effect: &Effect) -> Names {
        let (right, companions): (&[&str], &[&str]) = match effect.form {
            Form::WorkFade | Form::FadeLinear | Form::FadeExponential | Form::FadeByWay => {
                (&["thermal_fade", "friction_fade"], &["dry_offset"])
            }
            Form::Thermal | Form::YieldFade => (&["thermal_fade", "torque_drift"], &["gain_error"]),
            Form::Overshoot
            | Form::OvershootLinear
            | Form::YieldOvershoot
            | Form::YieldOvershootLinear => (
                &["reversal_overshoot", "friction_overshoot"],
                &["stribeck", "presliding", "dahl_bristle", "hysteresis"],
            ),
            Form::Gap => (
                &[
                    "backlash_width",
                    "backlash",
                    "load_backlash",
                    "presliding",
                    "hysteresis",
                ],
                &["dry_offset"],
            ),
            Form::Backlash => (
                &["backlash_width", "backlash", "load_backlash"],
                &["presliding"],
            ),
            // A pure delay between two recorded channels has one name for each of them.
            Form::Lag => (&["lag", "dead_time"], &["channel_skew"]),
            Form::LagSecond => (&["lag", "dead_time", "channel_skew"], &["gain_error"]),
            Form::RateLimit => (&["lag", "rate_limit"], &["saturation", "gain_error"]),
            Form::DeadTime | Form::Skew => (&["dead_time", "channel_skew", "lag"], &[]),
            Form::Gain => (&["gain_error", "current_gain"], &[]),
            Form::Saturation | Form::SoftSaturation => {
                (&["saturation", "drive_saturation"], &["gain_error"])
            }
            Form::Play | Form::Preisach | Form::Plays | Form::BoucWenCurrent => (
                &["current_hysteresis"],
                &["gain_error", "current_gain", "lag"],
            ),
            Form::TimeConstants => (&["time_constant", "lag"], &[]),
            Form::OffState => (&["off_state_torque", "dry_offset"], &[]),
            // Of an arm: other numbers of its last link are the same.
            Form::Payload => (
                &["payload", "inertia_error", "added_inertia", "link_inertia"],
                &[],
            ),
            Form::Inertia => (&["payload", "inertia_error", "added_inertia"], &[]),
            Form::LinkMass => (&["link_inertia"], &[]),
            Form::Rotor => (&["added_inertia"], &[]),
            Form::Compliance => (&["compliance"], &["payload", "inertia_error"]),
            Form::TwoMass => (
                &["compliance"],
                &[
                    "backlash_width",
                    "backlash",
                    "load_backlash",
                    "spring",
                    "inertia_error",
                    "payload",
                ],
            ),
            Form::ImpactGap => (
                &["backlash_width", "backlash", "load_backlash", "compliance"],
                &["inertia_error", "presliding"],
            ),
            _ => return Names::of_sensors(effect),
        };
        Names { right, companions }
    }

    /// Of what is left out of the frame and the sensors.
    const fn of_sensors(effect: &Effect) -> Names {
        let (right, companions): (&[&str], &[&str]) = match effect.form {
            Form::LinkLength => (&["link_length"], &["encoder_offset", "encoder_scale"]),
            Form::Gravity => (&["gravity"], &[]),
            Form::PlaneSpring => (&["plane_spring", "spring"], &["gravity", "force_bias"]),
            Form::EncoderScale => (&["encoder_scale"], &[]),
            Form::EncoderOffset => (&["encoder_offset"], &[]),
            Form::Eccentric => (
                &["encoder_eccentricity", "eccentric_encoder"],
                &["encoder_scale", "ripple"],
            ),
            Form::Interpolation => (
                &[
                    "encoder_eccentricity",
                    "eccentric_encoder",
                    "interpolation_error",
                    "ripple",
                ],
                &[],
            ),
            Form::ForceGain => (&["force_gain"], &[]),
            Form::Crosstalk => (&["force_crosstalk", "force_rotation"], &["force_gain"]),
            Form::ForceBias => (&["force_bias"], &[]),
            Form::ForceRotation => (&["force_rotation"], &[]),
            Form::Repeated => (&["repeated_samples", "dropped_samples"], &[]),
            Form::Clock => (&["clock", "clock_skew", "clock_jitter"], &["inertia_error"]),
            // One name with two periods.
            Form::TwoRipples => (&["ripple"], &[]),
            _ => (&[], &[]),
        };
        Names { right, companions }
    }
}
