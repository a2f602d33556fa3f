//! This file is the fixed vocabulary of left-out physics: one name for each mechanism, with its parameters.

use crate::units::Dimension;

/// Rate of a joint below which its sense is rounding and no reversal, rad/s: a count of the encoder takes most of a day.
pub const LEAST_TURNING_RAD_S: f64 = 1e-9;

/// What an overshoot remembers of a joint that has not moved yet: more than the whole of its travel in either sense, so that its
/// first motion is no reversal.
pub const NOT_MOVED: f64 = 2.0;

/// A physical mechanism that a model may contain or may have left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Mechanism {
    /// Rate-independent (Coulomb) friction.
    DryOffset,
    /// Wrong torque constant of a drive or a brake.
    GainError,
    /// Friction proportional to speed.
    Viscous,
    /// Different friction in the two directions of motion.
    DirectionAsymmetry,
    /// Friction that falls with rising speed near standstill.
    Stribeck,
    /// Higher torque of a brake just after a reversal.
    ReversalOvershoot,
    /// Wrong width of the backlash window.
    BacklashWidth,
    /// Elastic motion before sliding (Dahl 1968).
    Presliding,
    /// Elastic motion before sliding, with another limit in each direction.
    AsymmetricPresliding,
    /// Memory of the current history.
    CurrentHysteresis,
    /// Memory of the displacement history (Bouc 1967, Wen 1976).
    Hysteresis,
    /// First-order delay of the commanded effort.
    Lag,
    /// Pure delay of the commanded effort.
    DeadTime,
    /// Limited effort.
    Saturation,
    /// Friction proportional to the transmitted load.
    LoadDependent,
    /// Torque lost to heating.
    ThermalFade,
    /// Torque changed by rest (particle settling).
    Settling,
    /// Force periodic in position.
    Ripple,
    /// Weight of a tilted mechanism.
    Gravity,
    /// Linear spring.
    Spring,
    /// Constant force.
    ConstantBias,
    /// Constant force that drifts with the time since the start.
    BiasDrift,
    /// Wrong inertia.
    InertiaError,
    /// Extra mass at the tip.
    Payload,
    /// Friction at a joint without a brake.
    BearingFriction,
    /// Structural flexibility.
    Compliance,
    /// Time shift between two channels.
    ChannelSkew,
    /// Wrong scale of a position channel.
    EncoderScale,
    /// Wrong zero of a position channel.
    EncoderOffset,
    /// Wrong scale of a force channel.
    ForceGain,
    /// Wrong zero of a force channel.
    ForceBias,
    /// Rotated force sensor.
    ForceRotation,
    /// Cubic spring.
    NonlinearSpring,
    /// Friction proportional to a power of speed.
    VelocityPower,
}

impl Mechanism {
    /// Every mechanism, in the order of the design document.
    pub const ALL: [Mechanism; 34] = [
        Mechanism::DryOffset,
        Mechanism::GainError,
        Mechanism::Viscous,
        Mechanism::DirectionAsymmetry,
        Mechanism::Stribeck,
        Mechanism::ReversalOvershoot,
        Mechanism::BacklashWidth,
        Mechanism::Presliding,
        Mechanism::AsymmetricPresliding,
        Mechanism::CurrentHysteresis,
        Mechanism::Hysteresis,
        Mechanism::Lag,
        Mechanism::DeadTime,
        Mechanism::Saturation,
        Mechanism::LoadDependent,
        Mechanism::ThermalFade,
        Mechanism::Settling,
        Mechanism::Ripple,
        Mechanism::Gravity,
        Mechanism::Spring,
        Mechanism::ConstantBias,
        Mechanism::BiasDrift,
        Mechanism::InertiaError,
        Mechanism::Payload,
        Mechanism::BearingFriction,
        Mechanism::Compliance,
        Mechanism::ChannelSkew,
        Mechanism::EncoderScale,
        Mechanism::EncoderOffset,
        Mechanism::ForceGain,
        Mechanism::ForceBias,
        Mechanism::ForceRotation,
        Mechanism::NonlinearSpring,
        Mechanism::VelocityPower,
    ];

    /// The name used in every file and report.
    pub const fn name(self) -> &'static str {
        match self {
            Mechanism::DryOffset => "dry_offset",
            Mechanism::GainError => "gain_error",
            Mechanism::Viscous => "viscous",
            Mechanism::DirectionAsymmetry => "direction_asymmetry",
            Mechanism::Stribeck => "stribeck",
            Mechanism::ReversalOvershoot => "reversal_overshoot",
            Mechanism::BacklashWidth => "backlash_width",
            Mechanism::Presliding => "presliding",
            Mechanism::AsymmetricPresliding => "asymmetric_presliding",
            Mechanism::CurrentHysteresis => "current_hysteresis",
            Mechanism::Hysteresis => "hysteresis",
            Mechanism::Lag => "lag",
            Mechanism::DeadTime => "dead_time",
            Mechanism::Saturation => "saturation",
            Mechanism::LoadDependent => "load_dependent",
            Mechanism::ThermalFade => "thermal_fade",
            Mechanism::Settling => "settling",
            Mechanism::Ripple => "ripple",
            Mechanism::Gravity => "gravity",
            Mechanism::Spring => "spring",
            Mechanism::ConstantBias => "constant_bias",
            Mechanism::BiasDrift => "bias_drift",
            Mechanism::InertiaError => "inertia_error",
            Mechanism::Payload => "payload",
            Mechanism::BearingFriction => "bearing_friction",
            Mechanism::Compliance => "compliance",
            Mechanism::ChannelSkew => "channel_skew",
            Mechanism::EncoderScale => "encoder_scale",
            Mechanism::EncoderOffset => "encoder_offset",
            Mechanism::ForceGain => "force_gain",
            Mechanism::ForceBias => "force_bias",
            Mechanism::ForceRotation => "force_rotation",
            Mechanism::NonlinearSpring => "nonlinear_spring",
            Mechanism::VelocityPower => "velocity_power",
        }
    }

    /// The mechanism of a name, or `None`.
    pub fn from_name(name: &str) -> Option<Mechanism> {
        Mechanism::ALL
            .into_iter()
            .find(|mechanism| mechanism.name() == name)
    }

    /// The parameters of the mechanism, empty while no room computes it.
    pub const fn parameters(self) -> &'static [Parameter] {
        use Quantity::*;
        match self {
            Mechanism::DryOffset => const { &[Parameter::new("level", Effort)] },
            Mechanism::GainError => const { &[Parameter::new("fraction", Number)] },
            Mechanism::Viscous => const { &[Parameter::new("coefficient", EffortPerSpeed)] },
            Mechanism::DirectionAsymmetry => {
                const {
                    &[
                        Parameter::new("viscous", EffortPerSpeed),
                        Parameter::new("dry", Effort),
                    ]
                }
            }
            Mechanism::Stribeck => {
                const {
                    &[
                        Parameter::new("peak", Effort),
                        Parameter::new("speed", Speed),
                        Parameter::new("exponent", Number),
                        Parameter::optional("travel", Travel),
                    ]
                }
            }
            Mechanism::Presliding => {
                const {
                    &[
                        Parameter::new("level", Effort),
                        Parameter::new("travel", Travel),
                    ]
                }
            }
            Mechanism::Hysteresis => {
                const {
                    &[
                        Parameter::new("alpha", EffortPerTravel),
                        Parameter::new("beta_gamma", PerTravel),
                        Parameter::new("beta_delta", PerTravel),
                    ]
                }
            }
            Mechanism::Lag => const { &[Parameter::new("time_constant", Time)] },
            Mechanism::Ripple => {
                const {
                    &[
                        Parameter::new("sine", Effort),
                        Parameter::new("cosine", Effort),
                        Parameter::new("period", Travel),
                    ]
                }
            }
            Mechanism::Spring => const { &[Parameter::new("stiffness", EffortPerTravel)] },
            Mechanism::ConstantBias => const { &[Parameter::new("level", Effort)] },
            Mechanism::BiasDrift => const { &[Parameter::new("rate", EffortPerTime)] },
            Mechanism::NonlinearSpring => {
                const { &[Parameter::new("cubic", EffortPerCubicTravel)] }
            }
            Mechanism::ChannelSkew => const { &[Parameter::new("delay", Time)] },
            _ => self.parameters_at_brake(),
        }
    }

    /// Of what a brake does besides, and of what the others do not have.
    const fn parameters_at_brake(self) -> &'static [Parameter] {
        use Quantity::*;
        match self {
            Mechanism::ReversalOvershoot => {
                const {
                    &[
                        Parameter::new("fraction", Number),
                        Parameter::new("travel", Travel),
                    ]
                }
            }
            Mechanism::Settling => {
                const {
                    &[
                        Parameter::new("level", Effort),
                        Parameter::new("travel", Travel),
                    ]
                }
            }
            Mechanism::AsymmetricPresliding => {
                const {
                    &[
                        Parameter::new("forward", Effort),
                        Parameter::new("backward", Effort),
                        Parameter::new("travel", Travel),
                    ]
                }
            }
            Mechanism::BacklashWidth => const { &[Parameter::new("width", Travel)] },
            Mechanism::CurrentHysteresis => {
                const {
                    &[
                        Parameter::new("share", Number),
                        Parameter::new("half_width", Current),
                        Parameter::optional("closing", Current),
                    ]
                }
            }
            Mechanism::DeadTime => const { &[Parameter::new("delay", Time)] },
            Mechanism::Saturation => const { &[Parameter::new("limit", Current)] },
            Mechanism::LoadDependent => const { &[Parameter::new("arm", Length)] },
            Mechanism::ThermalFade => {
                const {
                    &[
                        Parameter::new("per_joule", PerEnergy),
                        Parameter::new("cooling", Time),
                    ]
                }
            }
            _ => self.parameters_of_linkage(),
        }
    }

    /// Of a linkage as a whole and of its sensors.
    const fn parameters_of_linkage(self) -> &'static [Parameter] {
        use Quantity::*;
        match self {
            Mechanism::BearingFriction => const { &[Parameter::new("level", Effort)] },
            Mechanism::Gravity => {
                const {
                    &[
                        Parameter::new("x", Acceleration),
                        Parameter::new("y", Acceleration),
                    ]
                }
            }
            Mechanism::InertiaError => {
                const {
                    &[
                        Parameter::new("arm_ae", MomentOfInertia),
                        Parameter::new("arm_bc", MomentOfInertia),
                        Parameter::new("arm_ed", MomentOfInertia),
                        Parameter::new("arm_cd", MomentOfInertia),
                        Parameter::new("tip", Mass),
                    ]
                }
            }
            Mechanism::Payload => const { &[Parameter::new("mass", Mass)] },
            Mechanism::EncoderScale => const { &[Parameter::new("fraction", Number)] },
            Mechanism::EncoderOffset => const { &[Parameter::new("angle", Angle)] },
            Mechanism::ForceGain => const { &[Parameter::new("fraction", Number)] },
            Mechanism::ForceBias => {
                const { &[Parameter::new("x", Force), Parameter::new("y", Force)] }
            }
            Mechanism::ForceRotation => const { &[Parameter::new("angle", Angle)] },
            _ => &[],
        }
    }
}

/// One parameter of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The name used in files and reports.
    pub name: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Whether it may be left out; none stands before one that may not.
    pub is_optional: bool,
}

impl Parameter {
    const fn new(name: &'static str, quantity: Quantity) -> Parameter {
        Parameter {
            name,
            quantity,
            is_optional: false,
        }
    }

    const fn optional(name: &'static str, quantity: Quantity) -> Parameter {
        Parameter {
            is_optional: true,
            ..Parameter::new(name, quantity)
        }
    }
}

/// What a parameter measures, whether the plant turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A plain number.
    Number,
    /// Seconds.
    Time,
    /// Metres or radians.
    Travel,
    /// Metres or radians per second.
    Speed,
    /// Newtons or newton metres.
    Effort,
    /// Effort over travel.
    EffortPerTravel,
    /// Effort over speed.
    EffortPerSpeed,
    /// Effort over cubed travel.
    EffortPerCubicTravel,
    /// Effort over time.
    EffortPerTime,
    /// One over travel.
    PerTravel,
    /// Effort over acceleration: mass or moment of inertia.
    Inertia,
    /// Amperes.
    Current,
    /// One over joule.
    PerEnergy,
    /// Metres per squared second, whatever the plant does.
    Acceleration,
    /// Metres, whatever the plant does.
    Length,
    /// Kilograms, whatever the plant does.
    Mass,
    /// Kilograms times squared metres, whatever the plant does.
    MomentOfInertia,
    /// Newtons, whatever the plant does.
    Force,
    /// Radians, whatever the plant does.
    Angle,
}

/// Whether a plant slides or turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Metres and newtons.
    Linear,
    /// Radians and newton metres.
    Rotary,
}

impl Quantity {
    /// The physical dimension for a sliding or a turning plant.
    pub const fn dimension(self, motion: Motion) -> Dimension {
        let (travel, effort) = match motion {
            Motion::Linear => (Dimension::LENGTH, Dimension::FORCE),
            Motion::Rotary => (Dimension::ANGLE, Dimension::TORQUE),
        };
        let speed = travel.per(Dimension::TIME);
        match self {
            Quantity::Number => Dimension::NUMBER,
            Quantity::Time => Dimension::TIME,
            Quantity::Travel => travel,
            Quantity::Speed => speed,
            Quantity::Effort => effort,
            Quantity::EffortPerTravel => effort.per(travel),
            Quantity::EffortPerSpeed => effort.per(speed),
            Quantity::EffortPerCubicTravel => effort.per(travel.power(3)),
            Quantity::EffortPerTime => effort.per(Dimension::TIME),
            Quantity::PerTravel => Dimension::NUMBER.per(travel),
            Quantity::Inertia => effort.per(speed.per(Dimension::TIME)),
            Quantity::Current => Dimension::CURRENT,
            Quantity::PerEnergy => Dimension::NUMBER.per(Dimension::FORCE.times(Dimension::LENGTH)),
            Quantity::Acceleration => Dimension::LENGTH.per(Dimension::TIME.power(2)),
            Quantity::Mass => Dimension::FORCE
                .per(Dimension::LENGTH)
                .times(Dimension::TIME.power(2)),
            Quantity::MomentOfInertia => Dimension::FORCE
                .times(Dimension::LENGTH)
                .times(Dimension::TIME.power(2)),
            Quantity::Force => Dimension::FORCE,
            Quantity::Length => Dimension::LENGTH,
            Quantity::Angle => Dimension::ANGLE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_read_back() {
        for (i, mechanism) in Mechanism::ALL.into_iter().enumerate() {
            assert_eq!(Mechanism::from_name(mechanism.name()), Some(mechanism));
            for other in Mechanism::ALL.into_iter().skip(i + 1) {
                assert_ne!(mechanism.name(), other.name());
            }
        }
    }
}
