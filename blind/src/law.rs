//! This file lists the physics that a recording can contain, each with its parameters and its source.

use rigproof_spec::effect::{Mechanism, Quantity};

/// A law of resistance or of the drive. Effort is N or N·m, travel m or rad; resistance is positive in the sense of
/// the velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Coulomb friction: a set at rest, `level` in motion.
    Dry { level: f64 },
    /// Linear damping.
    Viscous { coefficient: f64 },
    /// Different friction in the two directions: adds `dry` to the bound and `viscous` to the damping when moving
    /// forward and takes them off when moving backward.
    Asymmetry { dry: f64, viscous: f64 },
    /// Extra friction near rest, `peak·exp(−|v/speed|^exponent)` (Tustin 1947: 1; Bo and Pavelescu 1982: 2).
    Stribeck {
        peak: f64,
        speed: f64,
        exponent: f64,
    },
    /// Rigid-plastic bristle (Dahl 1968): `dz/dq = (level − z·sgn v)/travel`.
    Dahl { level: f64, travel: f64 },
    /// Displacement memory (Bouc 1967, Wen 1976) of order one: `dz/dq = alpha − beta_gamma·z·sgn v − beta_delta·|z|`.
    BoucWen {
        alpha: f64,
        beta_gamma: f64,
        beta_delta: f64,
    },
    /// Constant effort against positive motion.
    Bias { level: f64 },
    /// Linear spring about the zero of position.
    Spring { stiffness: f64 },
    /// Cubic spring about the zero of position (Duffing 1918).
    Cubic { cubic: f64 },
    /// Force periodic in position: cogging, gear mesh.
    Ripple { sine: f64, cosine: f64, period: f64 },
    /// First-order delay of the drive's or the brake's effort.
    Lag { time_constant: f64 },
    /// Gain of the drive or the brake, as a fraction above the nominal one.
    Gain { fraction: f64 },
    /// The position channel is late by `delay` on the axis, the effort channel on the bench; early when negative.
    Skew { delay: f64 },
    /// Turbulent drag: `level` at `speed`, growing with the square.
    QuadraticDrag { level: f64, speed: f64 },
    /// Friction proportional to the drive's effort (gear and bearing load).
    LoadFriction { fraction: f64 },
    /// Dry friction that fades as its own work warms the contact: halved after `travel` at full level.
    ThermalFade { level: f64, travel: f64 },
    /// Breakaway that grows with dwell time at rest (Rabinowicz 1958) and is worn off by sliding.
    Settling { level: f64, time: f64, travel: f64 },
    /// Extra friction after a reversal that dies out with travel (thesis §3.5).
    ReversalOvershoot { level: f64, travel: f64 },
    /// The drive gives nothing below `level` and loses it above.
    DeadZone { level: f64 },
    /// A disturbance periodic in time.
    Disturbance { level: f64, period: f64 },
    /// The drive cannot exceed `level`.
    Saturation { level: f64 },
    /// The magnetic circuit lags the current by a play of `width` ampere (thesis figure 3.17).
    CurrentHysteresis { width: f64 },
    /// A backlash window of another width than table 3.1.
    BacklashWidth { width: f64 },
}

impl Law {
    /// The name in the answer: the vocabulary's where it has one.
    pub const fn name(&self) -> &'static str {
        match self {
            Law::Dry { .. } => Mechanism::DryOffset.name(),
            Law::Viscous { .. } => Mechanism::Viscous.name(),
            Law::Asymmetry { .. } => Mechanism::DirectionAsymmetry.name(),
            Law::Stribeck { .. } => Mechanism::Stribeck.name(),
            Law::Dahl { .. } => Mechanism::Presliding.name(),
            Law::BoucWen { .. } => Mechanism::Hysteresis.name(),
            Law::Bias { .. } => Mechanism::ConstantBias.name(),
            Law::Spring { .. } => Mechanism::Spring.name(),
            Law::Cubic { .. } => Mechanism::NonlinearSpring.name(),
            Law::Ripple { .. } => Mechanism::Ripple.name(),
            Law::Lag { .. } => Mechanism::Lag.name(),
            Law::Gain { .. } => Mechanism::GainError.name(),
            Law::Skew { .. } => Mechanism::ChannelSkew.name(),
            Law::QuadraticDrag { .. } => Mechanism::VelocityPower.name(),
            Law::LoadFriction { .. } => Mechanism::LoadDependent.name(),
            Law::ThermalFade { .. } => Mechanism::ThermalFade.name(),
            Law::Settling { .. } => Mechanism::Settling.name(),
            Law::ReversalOvershoot { .. } => Mechanism::ReversalOvershoot.name(),
            Law::DeadZone { .. } => "dead_zone",
            Law::Disturbance { .. } => "periodic_disturbance",
            Law::Saturation { .. } => Mechanism::Saturation.name(),
            Law::CurrentHysteresis { .. } => Mechanism::CurrentHysteresis.name(),
            Law::BacklashWidth { .. } => Mechanism::BacklashWidth.name(),
        }
    }

    /// The parameters with the vocabulary's names; what the vocabulary has no quantity for is a plain number.
    pub fn parameters(&self) -> Vec<(&'static str, f64, Quantity)> {
        use Quantity::*;
        match *self {
            Law::Dry { level } | Law::Bias { level } => vec![("level", level, Effort)],
            Law::Viscous { coefficient } => vec![("coefficient", coefficient, EffortPerSpeed)],
            Law::Asymmetry { dry, viscous } => {
                vec![("dry", dry, Effort), ("viscous", viscous, EffortPerSpeed)]
            }
            Law::Stribeck {
                peak,
                speed,
                exponent,
            } => vec![
                ("peak", peak, Effort),
                ("speed", speed, Speed),
                ("exponent", exponent, Number),
            ],
            Law::Dahl { level, travel } => {
                vec![("level", level, Effort), ("travel", travel, Travel)]
            }
            Law::BoucWen {
                alpha,
                beta_gamma,
                beta_delta,
            } => vec![
                ("alpha", alpha, EffortPerTravel),
                ("beta_gamma", beta_gamma, PerTravel),
                ("beta_delta", beta_delta, PerTravel),
            ],
            Law::Spring { stiffness } => vec![("stiffness", stiffness, EffortPerTravel)],
            Law::Cubic { cubic } => vec![("cubic", cubic, EffortPerCubicTravel)],
            Law::Ripple {
                sine,
                cosine,
                period,
            } => vec![
                ("sine", sine, Effort),
                ("cosine", cosine, Effort),
                ("period", period, Travel),
            ],
            Law::Lag { time_constant } => vec![("time_constant", time_constant, Time)],
            Law::Gain { fraction } => vec![("fraction", fraction, Number)],
            Law::Skew { delay } => vec![("delay", delay, Time)],
            _ => self.foreign_parameters(),
        }
    }

    fn foreign_parameters(&self) -> Vec<(&'static str, f64, Quantity)> {
        use Quantity::*;
        match *self {
            Law::DeadZone { level } | Law::Saturation { level } => vec![("level", level, Effort)],
            Law::LoadFriction { fraction } => vec![("fraction", fraction, Number)],
            Law::ThermalFade { level, travel } | Law::ReversalOvershoot { level, travel } => {
                vec![("level", level, Effort), ("travel", travel, Travel)]
            }
            Law::QuadraticDrag { level, speed } => {
                vec![("level", level, Effort), ("speed", speed, Speed)]
            }
            Law::Settling {
                level,
                time,
                travel,
            } => vec![
                ("level", level, Effort),
                ("time", time, Time),
                ("travel", travel, Travel),
            ],
            Law::Disturbance { level, period } => {
                vec![("level", level, Effort), ("period", period, Time)]
            }
            Law::CurrentHysteresis { width } => vec![("width_a", width, Number)],
            Law::BacklashWidth { width } => vec![("width", width, Travel)],
            _ => Vec::new(),
        }
    }

    /// The same law with its effect multiplied, its shape kept.
    pub fn scaled(self, factor: f64) -> Law {
        let mut law = self;
        match &mut law {
            Law::Dry { level }
            | Law::Bias { level }
            | Law::Dahl { level, .. }
            | Law::QuadraticDrag { level, .. }
            | Law::ThermalFade { level, .. }
            | Law::Settling { level, .. }
            | Law::ReversalOvershoot { level, .. }
            | Law::DeadZone { level }
            | Law::Saturation { level }
            | Law::Disturbance { level, .. } => *level *= factor,
            Law::Viscous { coefficient } => *coefficient *= factor,
            Law::Asymmetry { dry, viscous } => {
                *dry *= factor;
                *viscous *= factor;
            }
            Law::Stribeck { peak, .. } => *peak *= factor,
            Law::BoucWen { alpha, .. } => *alpha *= factor,
            Law::Spring { stiffness } => *stiffness *= factor,
            Law::Cubic { cubic } => *cubic *= factor,
            Law::Ripple { sine, cosine, .. } => {
                *sine *= factor;
                *cosine *= factor;
            }
            Law::Lag { time_constant } => *time_constant *= factor,
            Law::Gain { fraction } | Law::LoadFriction { fraction } => *fraction *= factor,
            Law::Skew { delay } => *delay *= factor,
            Law::CurrentHysteresis { width } | Law::BacklashWidth { width } => *width *= factor,
        }
        law
    }

    /// Whether the law acts in the drive or the brake, ahead of the mechanism.
    pub const fn is_upstream(&self) -> bool {
        matches!(
            self,
            Law::Lag { .. }
                | Law::Gain { .. }
                | Law::DeadZone { .. }
                | Law::Saturation { .. }
                | Law::CurrentHysteresis { .. }
                | Law::BacklashWidth { .. }
        )
    }
}

/// A law with the time from which it acts, s; `None` when it always does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    pub law: Law,
    pub onset_s: Option<f64>,
}

impl Effect {
    /// A law that always acts.
    pub const fn always(law: Law) -> Effect {
        Effect { law, onset_s: None }
    }

    /// Whether the law acts at that time.
    pub fn acts(&self, time_s: f64) -> bool {
        self.onset_s.is_none_or(|onset_s| time_s >= onset_s)
    }
}

/// The time by which a hidden skew delays a channel, s; 0 without one.
pub fn skew_s(hidden: &[Effect]) -> f64 {
    let skew = hidden.iter().find_map(|effect| match effect.law {
        Law::Skew { delay } => Some(delay),
        _ => None,
    });
    skew.unwrap_or(0.0)
}
