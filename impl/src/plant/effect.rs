//! This file is physics that the thesis leaves out: the resistance laws of the effect library on a joint of the rig.

use rigproof_spec::effect::{LEAST_TURNING_RAD_S, Mechanism, NOT_MOVED};
use rigproof_spec::joint::Joint;

use super::decay::decayed;

/// Most effects of a rig.
pub const MOST_EFFECTS: usize = 8;

/// One effect as it is asked for: where, which and with which parameters, in the vocabulary's order and units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked<'a> {
    /// The joint, or the joint whose brake's current it changes.
    pub joint: Joint,
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its parameters.
    pub parameters: &'a [f64],
}

/// What a law looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time since the start, s.
    pub time_s: f64,
    /// Angle of the joint, rad.
    pub position: f64,
    /// Its rate, rad/s.
    pub speed: f64,
    /// Sense of motion: +1 or −1; at rest the sense that is tried.
    pub sense: f64,
    /// What the joint's brake alone can resist with, N·m.
    pub brake_nm: f64,
}

/// A law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(
    missing_docs,
    reason = "the vocabulary names the parameters and what they measure"
)]
pub enum Law {
    /// level·sgn q̇ (Coulomb).
    DryOffset { level: f64 },
    /// level.
    ConstantBias { level: f64 },
    /// coefficient·q̇.
    Viscous { coefficient: f64 },
    /// coefficient·|q̇|^exponent·sgn q̇.
    VelocityPower { coefficient: f64, exponent: f64 },
    /// viscous·|q̇| + dry.
    DirectionAsymmetry { viscous: f64, dry: f64 },
    /// peak·exp(−|q̇/speed|^exponent)·sgn q̇.
    Stribeck {
        peak: f64,
        speed: f64,
        exponent: f64,
    },
    /// peak·w, travel·dw/dt = q̇·exp(−|q̇/speed|^exponent) − |q̇|·w.
    DelayedStribeck {
        peak: f64,
        speed: f64,
        exponent: f64,
        travel: f64,
    },
    /// level·w, travel·dw/dt = q̇ − |q̇|·w (Dahl 1968).
    Presliding { level: f64, travel: f64 },
    /// level·w + viscous·q̇, w as above.
    LugreBristle {
        level: f64,
        viscous: f64,
        travel: f64,
    },
    /// level·w, travel·dw/dt = q̇·(1 − w·sgn q̇)^exponent (Dahl 1968).
    DahlBristle {
        level: f64,
        travel: f64,
        exponent: f64,
    },
    /// −missing·sgn q̇ while a gap is crossed: 0 < x < gap, dx/dt = q̇ within its ends.
    Backlash { missing: f64, gap: f64 },
    /// z, travel·dz/dt = |q̇|·(forward − z) forward, −|q̇|·(backward + z) backward.
    AsymmetricPresliding {
        forward: f64,
        backward: f64,
        travel: f64,
    },
    /// alpha·z, dz/dt = q̇ − `beta_gamma`·|q̇|·z − `beta_delta`·q̇·|z| (Bouc 1967, Wen 1976).
    Hysteresis {
        alpha: f64,
        beta_gamma: f64,
        beta_delta: f64,
    },
    /// sine·sin(2π·q/period) + cosine·cos(2π·q/period).
    Ripple { sine: f64, cosine: f64, period: f64 },
    /// (sine·sin(2π·q/period) + cosine·cos(2π·q/period))·sgn q̇.
    UnevenFriction { sine: f64, cosine: f64, period: f64 },
    /// stiffness·(q − rest).
    Spring { stiffness: f64, rest: f64 },
    /// cubic·q³.
    NonlinearSpring { cubic: f64 },
    /// stiffness·(q − position) beyond the position, on the side of the sign.
    JointStop {
        stiffness: f64,
        position: f64,
        side: f64,
    },
    /// rate·settling·(1 − exp(−t/settling)); rate·t where settling is infinite.
    BiasDrift { rate: f64, settling: f64 },
    /// The same as a share of a brake's torque.
    TorqueDrift { rate: f64, settling: f64 },
    /// level·exp(−x/travel), x travelled since the sense changed; of a brake a share of its torque.
    Overshoot {
        level: f64,
        travel: f64,
        of_brake: bool,
    },
    /// level·(1 − m)·sgn q̇, travel·dm/dt = |q̇|·(1 − m); nothing at rest.
    Settling { level: f64, travel: f64 },
}

impl Law {
    /// The resistance law of a mechanism; none for a mechanism that is no resistance, for parameters that are not as many as the
    /// vocabulary names or not finite, and for a length or a speed that is not above zero.
    pub fn new(mechanism: Mechanism, parameters: &[f64]) -> Option<Law> {
        if !parameters.iter().all(|parameter| parameter.is_finite()) {
            return None;
        }
        let law = match (mechanism, parameters) {
            (Mechanism::DryOffset | Mechanism::BearingFriction, &[level]) => {
                Law::DryOffset { level }
            }
            (Mechanism::ConstantBias, &[level]) => Law::ConstantBias { level },
            (Mechanism::Viscous, &[coefficient]) => Law::Viscous { coefficient },
            (Mechanism::VelocityPower, &[coefficient, exponent]) if exponent > 0.0 => {
                Law::VelocityPower {
                    coefficient,
                    exponent,
                }
            }
            (Mechanism::DirectionAsymmetry, &[viscous, dry]) => {
                Law::DirectionAsymmetry { viscous, dry }
            }
            (Mechanism::Stribeck, &[peak, speed, exponent]) if speed > 0.0 => Law::Stribeck {
                peak,
                speed,
                exponent,
            },
            (Mechanism::Stribeck, &[peak, speed, exponent, travel])
                if speed > 0.0 && travel > 0.0 =>
            {
                Law::DelayedStribeck {
                    peak,
                    speed,
                    exponent,
                    travel,
                }
            }
            (Mechanism::Ripple, &[sine, cosine, period]) if period > 0.0 => Law::Ripple {
                sine,
                cosine,
                period,
            },
            (Mechanism::UnevenFriction, &[sine, cosine, period]) if period > 0.0 => {
                Law::UnevenFriction {
                    sine,
                    cosine,
                    period,
                }
            }
            (Mechanism::BiasDrift, &[rate]) => Law::BiasDrift {
                rate,
                settling: f64::INFINITY,
            },
            (Mechanism::TorqueDrift, &[rate]) => Law::TorqueDrift {
                rate,
                settling: f64::INFINITY,
            },
            (Mechanism::TorqueDrift, &[rate, settling]) if settling > 0.0 => {
                Law::TorqueDrift { rate, settling }
            }
            (Mechanism::BiasDrift, &[rate, settling]) if settling > 0.0 => {
                Law::BiasDrift { rate, settling }
            }
            _ => return Law::with_memory(mechanism, parameters),
        };
        Some(law)
    }

    /// The same of a law that remembers the motion.
    fn with_memory(mechanism: Mechanism, parameters: &[f64]) -> Option<Law> {
        let law = match (mechanism, parameters) {
            (Mechanism::Presliding, &[level, travel]) if travel > 0.0 => {
                Law::Presliding { level, travel }
            }
            (Mechanism::AsymmetricPresliding, &[forward, backward, travel]) if travel > 0.0 => {
                Law::AsymmetricPresliding {
                    forward,
                    backward,
                    travel,
                }
            }
            (Mechanism::Hysteresis, &[alpha, beta_gamma, beta_delta]) => Law::Hysteresis {
                alpha,
                beta_gamma,
                beta_delta,
            },
            (Mechanism::LugreBristle, &[level, viscous, travel]) if travel > 0.0 => {
                Law::LugreBristle {
                    level,
                    viscous,
                    travel,
                }
            }
            (Mechanism::DahlBristle, &[level, travel, exponent])
                if travel > 0.0 && exponent > 0.0 =>
            {
                Law::DahlBristle {
                    level,
                    travel,
                    exponent,
                }
            }
            (Mechanism::Backlash, &[missing, gap]) if gap > 0.0 => Law::Backlash { missing, gap },
            (Mechanism::ReversalOvershoot, &[fraction, travel]) if travel > 0.0 => Law::Overshoot {
                level: fraction,
                travel,
                of_brake: true,
            },
            (Mechanism::FrictionOvershoot, &[level, travel]) if travel > 0.0 => Law::Overshoot {
                level,
                travel,
                of_brake: false,
            },
            (Mechanism::Settling, &[level, travel]) if travel > 0.0 => {
                Law::Settling { level, travel }
            }
            _ => return Law::of_position(mechanism, parameters),
        };
        Some(law)
    }

    /// The law of a mechanism whose force depends on the position alone and does not repeat.
    const fn of_position(mechanism: Mechanism, parameters: &[f64]) -> Option<Law> {
        Some(match (mechanism, parameters) {
            (Mechanism::Spring, &[stiffness]) => Law::Spring {
                stiffness,
                rest: 0.0,
            },
            (Mechanism::Spring, &[stiffness, rest]) => Law::Spring { stiffness, rest },
            (Mechanism::NonlinearSpring, &[cubic]) => Law::NonlinearSpring { cubic },
            (Mechanism::JointStop, &[stiffness, position, side]) => Law::JointStop {
                stiffness,
                position,
                side: side.signum(),
            },
            _ => return None,
        })
    }

    /// The memory before any motion.
    pub const fn starts_with(&self) -> f64 {
        match self {
            Law::Overshoot { .. } => NOT_MOVED,
            Law::Backlash { gap, .. } => 0.5 * *gap,
            _ => 0.0,
        }
    }

    /// The part of the resistance that follows from the instant and the memory, N·m.
    pub fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        match *self {
            Law::DryOffset { .. } | Law::Stribeck { .. } | Law::UnevenFriction { .. } => 0.0,
            Law::ConstantBias { level } => level,
            Law::Viscous { coefficient } => coefficient * now.speed,
            Law::VelocityPower {
                coefficient,
                exponent,
            } => coefficient * libm::pow(now.speed.abs(), exponent) * now.speed.signum(),
            Law::DirectionAsymmetry { viscous, dry } => {
                let dry = if now.sense == 0.0 { 0.0 } else { dry };
                viscous * now.speed.abs() + dry
            }
            Law::Presliding { level, .. } | Law::DahlBristle { level, .. } => level * memory,
            Law::LugreBristle { level, viscous, .. } => level * memory + viscous * now.speed,
            Law::Backlash { missing, gap } if memory > 0.0 && memory < gap => -missing * now.sense,
            Law::Backlash { .. } => 0.0,
            Law::AsymmetricPresliding { .. } => memory,
            Law::DelayedStribeck { peak, .. } => peak * memory,
            Law::Hysteresis { alpha, .. } => alpha * memory,
            Law::Ripple {
                sine,
                cosine,
                period,
            } => wave(sine, cosine, now.position, period),
            Law::Spring { stiffness, rest } => stiffness * (now.position - rest),
            Law::NonlinearSpring { cubic } => cubic * now.position * now.position * now.position,
            Law::JointStop {
                stiffness,
                position,
                side,
            } => {
                let beyond = side * (now.position - position);
                stiffness * side * if beyond > 0.0 { beyond } else { 0.0 }
            }
            Law::BiasDrift { rate, settling } => rate * settled(now.time_s, settling),
            Law::TorqueDrift { .. } => 0.0,
            Law::Overshoot { .. } if memory == NOT_MOVED => 0.0,
            Law::Overshoot {
                level,
                of_brake: true,
                ..
            } => -0.5 * level * now.brake_nm * memory,
            Law::Overshoot { level, .. } => {
                let since = memory * now.sense.signum();
                level * (1.0 - if since > 0.0 { since } else { 0.0 }) * now.sense
            }
            Law::Settling { level, .. } => level * (1.0 - memory) * now.sense,
        }
    }

    /// The dry level: the resistance against motion and up to which it holds at rest, N·m.
    pub fn dry(&self, now: &Instant, memory: f64) -> f64 {
        match *self {
            Law::DryOffset { level } => level,
            Law::Overshoot { .. } if memory == NOT_MOVED => 0.0,
            Law::Overshoot {
                level,
                of_brake: true,
                ..
            } => level * now.brake_nm * (1.0 - 0.5 * memory.abs()),
            Law::Stribeck {
                peak,
                speed,
                exponent,
            } => peak * near_standstill(now.speed / speed, exponent),
            Law::UnevenFriction {
                sine,
                cosine,
                period,
            } => wave(sine, cosine, now.position, period),
            Law::TorqueDrift { rate, settling } => {
                rate * settled(now.time_s, settling) * now.brake_nm
            }
            _ => 0.0,
        }
    }

    /// The memory with which a motion of this rate goes on, rad/s: every change of sense begins an overshoot anew.
    fn begun(&self, memory: f64, speed: f64) -> f64 {
        let overshoots = matches!(self, Law::Overshoot { .. });
        let turns = memory * speed < 0.0 && speed.abs() > LEAST_TURNING_RAD_S;
        match (overshoots, memory == NOT_MOVED) {
            (true, true) => speed.signum(),
            (true, false) if turns => 0.0,
            _ => memory,
        }
    }

    /// The memory after a time, s, at a constant rate, rad/s, and halfway: exact while the memory keeps its sign.
    pub fn remember(&self, memory: f64, speed: f64, time_s: f64) -> [f64; 2] {
        if let Law::Overshoot { .. } = self
            && memory == NOT_MOVED
            && speed.abs() <= LEAST_TURNING_RAD_S
        {
            return [memory, memory];
        }
        let memory = self.begun(memory, speed);
        let (gain, decay) = match *self {
            Law::Presliding { travel, .. }
            | Law::LugreBristle { travel, .. }
            | Law::Overshoot { travel, .. } => (speed / travel, speed.abs() / travel),
            Law::DahlBristle {
                travel, exponent, ..
            } => {
                let after = |time_s: f64| bent(memory, speed * time_s / travel, exponent);
                return [after(time_s), after(0.5 * time_s)];
            }
            Law::Backlash { gap, .. } => {
                let after = |time_s: f64| (memory + speed * time_s).clamp(0.0, gap);
                return [after(time_s), after(0.5 * time_s)];
            }
            Law::AsymmetricPresliding {
                forward,
                backward,
                travel,
            } => {
                let limit = if speed > 0.0 { forward } else { -backward };
                (limit * speed.abs() / travel, speed.abs() / travel)
            }
            Law::DelayedStribeck {
                speed: slow,
                exponent,
                travel,
                ..
            } => {
                let gain = speed * near_standstill(speed / slow, exponent);
                (gain / travel, speed.abs() / travel)
            }
            Law::Settling { travel, .. } => (speed.abs() / travel, speed.abs() / travel),
            Law::Hysteresis {
                beta_gamma,
                beta_delta,
                ..
            } => {
                let side = if memory == 0.0 {
                    speed.signum()
                } else {
                    memory.signum()
                };
                (speed, beta_gamma * speed.abs() + beta_delta * speed * side)
            }
            _ => return [memory, memory],
        };
        let exponent = decay * time_s;
        let share = decayed(exponent);
        let rate = gain - decay * memory;
        let half = 0.5 * time_s;
        [
            memory + rate * time_s * share,
            memory + rate * half * decayed(0.5 * exponent),
        ]
    }
}

/// What a time counts where a drift settles, s.
fn settled(time_s: f64, settling: f64) -> f64 {
    if settling == f64::INFINITY {
        return time_s;
    }
    -settling * libm::expm1(-time_s / settling)
}

/// A sum of a sine and a cosine of a period.
fn wave(sine: f64, cosine: f64, position: f64, period: f64) -> f64 {
    let (sin, cos) = libm::sincos(core::f64::consts::TAU * position / period);
    sine * sin + cosine * cos
}

/// Share of a Stribeck peak at a ratio of speeds.
fn near_standstill(ratio: f64, exponent: f64) -> f64 {
    libm::exp(-libm::pow(ratio.abs(), exponent))
}

/// How far a bristle on Dahl's curve is bent after a motion, in its travels: what is left to bend goes by its own power.
fn bent(memory: f64, travels: f64, exponent: f64) -> f64 {
    let sense = travels.signum();
    let left = 1.0 - memory * sense;
    if travels == 0.0 || left <= 0.0 {
        return memory;
    }
    let own = 1.0 - exponent;
    // ln of the share that stays: that of an exponential where the exponent is one.
    let grown = own * travels.abs() * libm::pow(left, -own);
    let ln_share = if own.abs() < 1e-9 {
        -travels.abs()
    } else if grown >= 1.0 {
        return sense;
    } else {
        libm::log1p(-grown) / own
    };
    memory - sense * left * libm::expm1(ln_share)
}

/// A law on a joint, with its memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// Where.
    pub joint: Joint,
    /// What.
    pub law: Law,
    /// w or z; zero for a law without memory.
    pub memory: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bristle_bends_along_its_exponential() {
        let law = Law::new(Mechanism::Presliding, &[0.31, 0.007]).unwrap();
        let mut memory = -0.43;
        for _ in 0..17 {
            [memory, _] = law.remember(memory, 0.61, 1.1e-3);
        }
        let expected = 1.0 - 1.43 * libm::exp(-17.0 * 0.61 * 1.1e-3 / 0.007);
        assert!((memory - expected).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_law_is_refused() {
        assert_eq!(Law::new(Mechanism::Presliding, &[0.31, 0.0]), None);
        assert_eq!(Law::new(Mechanism::Viscous, &[0.31, 0.7]), None);
        assert_eq!(Law::new(Mechanism::Spring, &[f64::NAN]), None);
        assert_eq!(Law::new(Mechanism::Lag, &[0.31]), None);
    }
}
