//! This file lists the physics that a recording of the five-bar can hide, each with its parameters and its source.

use super::linkage::Pair;
use rigproof_spec::effect::{Mechanism, Motion, Quantity};
use rigproof_spec::joint::Joint;
use rigproof_spec::units::Dimension;

/// A law. Torques are N·m at the joint, positive against positive motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Coulomb friction: the set [−level, level] at rest.
    Dry { level: f64 },
    /// Linear damping.
    Viscous { coefficient: f64 },
    /// The bristle of LuGre (Canudas de Wit, Olsson, Åström and Lischinsky 1995) whose level `peak·exp(−(ω/speed)²)` is gone at speed.
    LuGre {
        peak: f64,
        speed: f64,
        stiffness: f64,
    },
    /// Six elasto-plastic elements side by side (Iwan 1966; Al-Bender, Lampaert and Swevers 2005), the last one yielding after
    /// `travel`.
    MaxwellSlip { level: f64, travel: f64 },
    /// Friction in proportion to the force on the tip, N·m/N (bearing load).
    Load { arm: f64 },
    /// Linear spring about the start.
    Spring { stiffness: f64 },
    /// Constant torque.
    Bias { level: f64 },
    /// Torque periodic in the joint's angle.
    Ripple { sine: f64, cosine: f64, period: f64 },
    /// Torque periodic with two periods.
    TwoRipples { level: f64, periods: Pair },
    /// Coulomb friction whose level swells and falls with the angle, as an eccentric seal's does (Armstrong-Hélouvry 1991):
    /// level·(1 + depth·sin(2π·angle/period)).
    Uneven { level: f64, depth: f64, period: f64 },
    /// Six elasto-plastic elements side by side with different limits forward and backward.
    OneSided {
        forward: f64,
        backward: f64,
        travel: f64,
    },
    /// Dry friction or damping of a bearing at a joint without a brake.
    Bearing { dry: f64, viscous: f64 },

    /// Every torque of the brake × (1 + fraction).
    Gain { fraction: f64 },
    /// A further first-order response behind the brake's own.
    Lag { time_constant: f64 },
    /// Backlash of another width.
    Backlash { width: f64 },
    /// Share of the current that goes through a Preisach operator of even density (Preisach 1935, Mayergoyz 1986).
    Preisach { share: f64 },
    /// Torque lost as the fluid warms: fluid and housing, two masses (K/J and s), `loss` per kelvin.
    Thermal { loss: f64 },
    /// Torque raised by a fraction after a reversal, dying out with travel (thesis §3.5).
    Overshoot { fraction: f64, travel: f64 },

    /// A point mass at the tip.
    Payload { mass: f64 },
    /// Masses and inertias × (1 + fraction).
    Inertia { fraction: f64 },
    /// Acceleration of gravity in the plane of a base that is not level.
    Gravity { field: Pair },
    /// The handle on a spring of its own, with a mass between sensor and tip.
    Compliance { mass: f64, frequency_hz: f64 },

    /// Both force channels late; early when negative.
    Skew { delay: f64 },
    /// Both force channels late by a delay that swings between nothing and twice this.
    VaryingSkew { delay: f64, period: f64 },
    /// The encoder shows (1 + fraction)·(angle − start) + start.
    EncoderScale { fraction: f64 },
    /// The encoder shows this much more.
    EncoderOffset { angle: f64 },
    /// Both force channels × (1 + fraction).
    ForceGain { fraction: f64 },
    /// Added to the force channels, N.
    ForceBias { force: Pair },
    /// The force sensor is turned to the left by this angle.
    ForceRotation { angle: f64 },
}

/// A law, where it acts and from when, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    pub law: Law,
    pub joint: Option<Joint>,
    pub onset_s: Option<f64>,
}

impl Effect {
    /// Whether the law acts at that time.
    pub fn acts(&self, time_s: f64) -> bool {
        self.onset_s.is_none_or(|onset_s| time_s >= onset_s)
    }

    /// The name in the answer: the vocabulary's where it has one.
    pub const fn name(&self) -> &'static str {
        match self.law {
            Law::Dry { .. } => Mechanism::DryOffset.name(),
            Law::Viscous { .. } => Mechanism::Viscous.name(),
            Law::LuGre { .. } => Mechanism::Stribeck.name(),
            Law::MaxwellSlip { .. } => Mechanism::Presliding.name(),
            Law::Load { .. } => Mechanism::LoadDependent.name(),
            Law::Spring { .. } => Mechanism::Spring.name(),
            Law::Bias { .. } => Mechanism::ConstantBias.name(),
            Law::Ripple { .. } => Mechanism::Ripple.name(),
            Law::TwoRipples { .. } => "cogging_with_two_periods",
            Law::Uneven { .. } => "uneven_friction",
            Law::OneSided { .. } => Mechanism::AsymmetricPresliding.name(),
            Law::Bearing { .. } => Mechanism::BearingFriction.name(),
            Law::Gain { .. } => Mechanism::GainError.name(),
            Law::Lag { .. } => Mechanism::Lag.name(),
            Law::Backlash { .. } => Mechanism::BacklashWidth.name(),
            Law::Preisach { .. } => Mechanism::CurrentHysteresis.name(),
            Law::Thermal { .. } => Mechanism::ThermalFade.name(),
            Law::Overshoot { .. } => Mechanism::ReversalOvershoot.name(),
            Law::Payload { .. } => Mechanism::Payload.name(),
            Law::Inertia { .. } => Mechanism::InertiaError.name(),
            Law::Gravity { .. } => Mechanism::Gravity.name(),
            Law::Compliance { .. } => Mechanism::Compliance.name(),
            Law::Skew { .. } => Mechanism::ChannelSkew.name(),
            Law::VaryingSkew { .. } => "varying_delay",
            Law::EncoderScale { .. } => Mechanism::EncoderScale.name(),
            Law::EncoderOffset { .. } => Mechanism::EncoderOffset.name(),
            Law::ForceGain { .. } => Mechanism::ForceGain.name(),
            Law::ForceBias { .. } => Mechanism::ForceBias.name(),
            Law::ForceRotation { .. } => Mechanism::ForceRotation.name(),
        }
    }

    /// Whether the effect is known only by what it does to the nominal equations, not as a torque of its own.
    pub const fn is_residual(&self) -> bool {
        self.is_of_sensors()
            || matches!(
                self.law,
                Law::Payload { .. } | Law::Inertia { .. } | Law::Compliance { .. }
            )
    }

    /// Whether the effect is in the sensors alone.
    pub const fn is_of_sensors(&self) -> bool {
        matches!(
            self.law,
            Law::Skew { .. }
                | Law::VaryingSkew { .. }
                | Law::EncoderScale { .. }
                | Law::EncoderOffset { .. }
                | Law::ForceGain { .. }
                | Law::ForceBias { .. }
                | Law::ForceRotation { .. }
        )
    }

    /// Whether the effect acts in a brake.
    pub const fn is_of_brake(&self) -> bool {
        matches!(
            self.law,
            Law::Gain { .. }
                | Law::Lag { .. }
                | Law::Backlash { .. }
                | Law::Preisach { .. }
                | Law::Thermal { .. }
                | Law::Overshoot { .. }
        )
    }

    /// The same effect with its strength multiplied, its shape kept.
    pub fn scaled(self, factor: f64) -> Effect {
        let mut effect = self;
        let pair = |[x, y]: Pair| [factor * x, factor * y];
        match &mut effect.law {
            Law::Dry { level }
            | Law::MaxwellSlip { level, .. }
            | Law::Uneven { level, .. }
            | Law::Bias { level }
            | Law::TwoRipples { level, .. } => {
                *level *= factor;
            }
            Law::Viscous { coefficient: x }
            | Law::LuGre { peak: x, .. }
            | Law::Load { arm: x }
            | Law::Spring { stiffness: x }
            | Law::Gain { fraction: x }
            | Law::Inertia { fraction: x }
            | Law::EncoderScale { fraction: x }
            | Law::ForceGain { fraction: x }
            | Law::Overshoot { fraction: x, .. }
            | Law::Lag { time_constant: x }
            | Law::Preisach { share: x }
            | Law::Thermal { loss: x }
            | Law::Payload { mass: x }
            | Law::Compliance { mass: x, .. }
            | Law::Skew { delay: x }
            | Law::VaryingSkew { delay: x, .. }
            | Law::EncoderOffset { angle: x }
            | Law::ForceRotation { angle: x }
            | Law::Backlash { width: x } => *x *= factor,
            Law::Ripple { sine, cosine, .. } => {
                *sine *= factor;
                *cosine *= factor;
            }
            Law::OneSided {
                forward, backward, ..
            } => {
                *forward *= factor;
                *backward *= factor;
            }
            Law::Bearing { dry, viscous } => {
                *dry *= factor;
                *viscous *= factor;
            }
            Law::Gravity { field } => *field = pair(*field),
            Law::ForceBias { force } => *force = pair(*force),
        }
        effect
    }

    /// The parameters with their units; the vocabulary's names where it has the same number. A law of another family has numbers of its own: the travel at
    /// which the last of some elements yields is no bristle's, the share of a Preisach operator none of a play's.
    pub fn parameters(&self) -> Vec<(&'static str, f64, Dimension)> {
        let effort = Quantity::Effort.dimension(Motion::Rotary);
        let of = |quantity: Quantity| quantity.dimension(Motion::Rotary);
        let (number, angle) = (Dimension::NUMBER, Dimension::ANGLE);
        match self.law {
            Law::Dry { level } | Law::Bias { level } => vec![("level", level, effort)],
            Law::Viscous { coefficient } => {
                vec![("coefficient", coefficient, of(Quantity::EffortPerSpeed))]
            }
            Law::LuGre { peak, speed, .. } => vec![
                ("peak", peak, effort),
                ("speed", speed, of(Quantity::Speed)),
                ("exponent", 2.0, number),
            ],
            Law::MaxwellSlip { level, travel } => {
                vec![("level", level, effort), (LAST_YIELD, travel, angle)]
            }
            Law::Load { arm } => vec![("arm", arm, Dimension::LENGTH)],
            Law::Spring { stiffness } => {
                vec![("stiffness", stiffness, of(Quantity::EffortPerTravel))]
            }
            Law::Ripple {
                sine,
                cosine,
                period,
            } => vec![
                ("sine", sine, effort),
                ("cosine", cosine, effort),
                ("period", period, angle),
            ],
            Law::TwoRipples {
                level,
                periods: [first, second],
            } => vec![
                ("level", level, effort),
                ("first_period", first, angle),
                ("second_period", second, angle),
            ],
            Law::Uneven {
                level,
                depth,
                period,
            } => vec![
                ("level", level, effort),
                ("depth", depth, number),
                ("period", period, angle),
            ],
            Law::OneSided {
                forward,
                backward,
                travel,
            } => vec![
                ("forward", forward, effort),
                ("backward", backward, effort),
                (LAST_YIELD, travel, angle),
            ],
            Law::Bearing { dry, viscous } => vec![
                ("dry", dry, effort),
                ("viscous", viscous, of(Quantity::EffortPerSpeed)),
            ],
            _ => self.other_parameters(),
        }
    }

    /// Those of brakes, masses and sensors.
    fn other_parameters(&self) -> Vec<(&'static str, f64, Dimension)> {
        let (number, angle, time) = (Dimension::NUMBER, Dimension::ANGLE, Dimension::TIME);
        let acceleration = Dimension::LENGTH.per(Dimension::TIME.power(2));
        match self.law {
            Law::Gain { fraction }
            | Law::Inertia { fraction }
            | Law::EncoderScale { fraction }
            | Law::ForceGain { fraction } => vec![("fraction", fraction, number)],
            Law::Lag { time_constant } => vec![("time_constant", time_constant, time)],
            Law::Backlash { width } => vec![("width", width, angle)],
            Law::Preisach { share } => vec![("preisach_share", share, number)],
            Law::Thermal { loss } => vec![("loss_per_kelvin", loss, number)],
            Law::Overshoot { fraction, travel } => {
                vec![("fraction", fraction, number), ("travel", travel, angle)]
            }
            Law::Payload { mass } => vec![("mass", mass, MASS)],
            Law::Gravity { field: [x, y] } => vec![("x", x, acceleration), ("y", y, acceleration)],
            Law::Compliance { mass, frequency_hz } => vec![
                ("mass", mass, MASS),
                ("frequency", frequency_hz, number.per(time)),
            ],
            Law::Skew { delay } => vec![("delay", delay, time)],
            Law::VaryingSkew { delay, period } => {
                vec![("delay", delay, time), ("period", period, time)]
            }
            Law::EncoderOffset { angle: x } | Law::ForceRotation { angle: x } => {
                vec![("angle", x, angle)]
            }
            Law::ForceBias { force: [x, y] } => {
                vec![("x", x, Dimension::FORCE), ("y", y, Dimension::FORCE)]
            }
            _ => Vec::new(),
        }
    }
}

/// kg.
const MASS: Dimension = Dimension([0, 1, 0, 0, 0]);

/// The travel at which the last element of a Maxwell-slip law yields.
const LAST_YIELD: &str = "last_yield";
