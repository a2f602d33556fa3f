//! This file computes the torque of one hidden law at a joint, and carries the law's memory.

use super::law::{Effect, Law};
use std::f64::consts::TAU;

/// Where a joint is.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    pub time_s: f64,
    /// Angle since the start, rad.
    pub angle_rad: f64,
    pub rate_rad_s: f64,
    /// Magnitude of the force on the tip, N.
    pub load_n: f64,
}

/// Elements of a Maxwell-slip joint.
const ELEMENTS: usize = 6;
/// Damping of the bristle over its stiffness, s (σ₁/σ₀ of LuGre).
const BRISTLE_DAMPING_S: f64 = 1e-3;

/// A law at a joint with its memory.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub effect: Effect,
    /// Deflections, N·m; a law with one uses the first.
    memory: [f64; ELEMENTS],
}

impl Element {
    /// The law before the recording begins.
    pub const fn new(effect: Effect) -> Element {
        Element {
            effect,
            memory: [0.0; ELEMENTS],
        }
    }

    /// The set-valued part, N·m: greatest resistance at rest, resistance in motion.
    pub fn bound_nm(&self, at: &Instant) -> f64 {
        match self.effect.law {
            _ if !self.effect.acts(at.time_s) => 0.0,
            Law::Dry { level } => level,
            Law::Bearing { dry, .. } => dry,
            Law::Load { arm } => arm * at.load_n,
            Law::Uneven {
                level,
                depth,
                period,
            } => level * (1.0 + depth * libm::sin(TAU * at.angle_rad / period)),
            _ => 0.0,
        }
    }

    /// The single-valued part with the memory as it will be after `travel` more, N·m, against positive motion.
    pub fn torque_nm(&self, at: &Instant, travel: f64, step_s: f64) -> f64 {
        if !self.effect.acts(at.time_s) {
            return 0.0;
        }
        let angle = at.angle_rad;
        match self.effect.law {
            Law::Viscous { coefficient } => coefficient * at.rate_rad_s,
            Law::Bearing { viscous, .. } => viscous * at.rate_rad_s,
            Law::Spring { stiffness } => stiffness * angle,
            Law::Bias { level } => level,
            Law::Ripple {
                sine,
                cosine,
                period,
            } => {
                let (s, c) = libm::sincos(TAU * angle / period);
                sine * s + cosine * c
            }
            Law::TwoRipples {
                level,
                periods: [first, second],
            } => level * (libm::sin(TAU * angle / first) + libm::sin(TAU * angle / second + 1.0)),
            Law::LuGre { .. } => {
                let [after, ..] = self.memory_after(at, travel);
                let [before, ..] = self.memory;
                let bristle_rate = if step_s > 0.0 {
                    (after - before) / step_s
                } else {
                    0.0
                };
                after + BRISTLE_DAMPING_S * bristle_rate
            }
            Law::MaxwellSlip { .. } | Law::OneSided { .. } => {
                self.memory_after(at, travel).iter().sum()
            }
            _ => 0.0,
        }
    }

    /// Moves the memory over a step.
    pub fn advance(&mut self, at: &Instant, travel: f64) {
        if self.effect.acts(at.time_s) {
            self.memory = self.memory_after(at, travel);
        }
    }

    fn memory_after(&self, at: &Instant, travel: f64) -> [f64; ELEMENTS] {
        let mut memory = self.memory;
        match self.effect.law {
            // dz/dt = σ₀·(ω − |ω|·z/g), exact at a constant rate: z goes to g·sgn ω, faster as g falls.
            Law::LuGre {
                peak,
                speed,
                stiffness,
            } => {
                let ratio = at.rate_rad_s / speed;
                let level = (peak * libm::exp(-ratio * ratio)).max(1e-9);
                if let [deflection, ..] = &mut memory
                    && travel != 0.0
                {
                    let limit = level * travel.signum();
                    let fade = libm::exp(-stiffness * travel.abs() / level);
                    *deflection = limit + (*deflection - limit) * fade;
                }
            }
            // Each yields a sixth of the level, after one, two, … sixths of the travel.
            Law::MaxwellSlip {
                level,
                travel: last,
            } => {
                let limit = level / ELEMENTS as f64;
                for (k, deflection) in memory.iter_mut().enumerate() {
                    let stiffness = level / last / (k + 1) as f64;
                    *deflection = (*deflection + stiffness * travel).clamp(-limit, limit);
                }
            }
            Law::OneSided {
                forward,
                backward,
                travel: last,
            } => {
                let elements = ELEMENTS as f64;
                for (k, deflection) in memory.iter_mut().enumerate() {
                    let stiffness = 0.5 * (forward + backward) / last / (k + 1) as f64;
                    let moved = *deflection + stiffness * travel;
                    *deflection = moved.clamp(-backward / elements, forward / elements);
                }
            }
            _ => {}
        }
        memory
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(law: Law) -> Element {
        Element::new(Effect {
            law,
            joint: None,
            onset_s: None,
        })
    }

    /// Work of three turns of a cycle of one amplitude at 0.7 Hz, J, one value a turn.
    fn cycle_work(mut element: Element, amplitude_rad: f64) -> [f64; 3] {
        let (steps, step_s) = (20_000, 1.0 / 14_000.0);
        let mut work_j = [0.0; 3];
        let mut angle_rad = 0.0;
        for k in 0..3 * steps {
            let next = amplitude_rad * libm::sin(TAU * f64::from(k + 1) / f64::from(steps));
            let travel = next - angle_rad;
            let at = Instant {
                time_s: 0.0,
                angle_rad,
                rate_rad_s: travel / step_s,
                load_n: 0.0,
            };
            work_j[(k / steps) as usize] +=
                element.torque_nm(&at, 0.5 * travel, 0.5 * step_s) * travel;
            element.advance(&at, travel);
            angle_rad = next;
        }
        work_j
    }

    #[test]
    fn closed_cycles_of_memory_cost_energy() {
        for law in [
            Law::LuGre {
                peak: 0.31,
                speed: 0.23,
                stiffness: 170.0,
            },
            Law::MaxwellSlip {
                level: 0.27,
                travel: 0.041,
            },
            Law::OneSided {
                forward: 0.21,
                backward: 0.47,
                travel: 0.033,
            },
        ] {
            for amplitude_rad in [0.007, 0.31] {
                let [_, second, third] = cycle_work(element(law), amplitude_rad);
                assert!(
                    second > 0.0 && (third / second - 1.0).abs() < 0.1,
                    "{law:?} {second} {third}"
                );
            }
        }
    }

    #[test]
    fn the_maxwell_slip_joint_yields_its_level_after_its_travel() {
        let mut joint = element(Law::MaxwellSlip {
            level: 0.27,
            travel: 0.041,
        });
        let at = Instant {
            time_s: 0.0,
            angle_rad: 0.0,
            rate_rad_s: 0.3,
            load_n: 0.0,
        };
        joint.advance(&at, 0.0409);
        assert!(joint.torque_nm(&at, 0.0, 0.0) < 0.27);
        joint.advance(&at, 0.0002);
        assert!((joint.torque_nm(&at, 0.0, 0.0) - 0.27).abs() < 1e-12);
        // Masing's rule: the reversed branch is the virgin one at twice the scale.
        joint.advance(&at, -0.0818);
        assert!(joint.torque_nm(&at, 0.0, 0.0) > -0.27);
        joint.advance(&at, -0.0003);
        assert!((joint.torque_nm(&at, 0.0, 0.0) + 0.27).abs() < 1e-12);
    }

    #[test]
    fn the_lugre_joint_peaks_at_rest_and_gives_nothing_at_speed() {
        let steady = |rate_rad_s: f64| {
            let mut joint = element(Law::LuGre {
                peak: 0.31,
                speed: 0.23,
                stiffness: 170.0,
            });
            let at = Instant {
                time_s: 0.0,
                angle_rad: 0.0,
                rate_rad_s,
                load_n: 0.0,
            };
            joint.advance(&at, 0.7 * rate_rad_s.signum());
            joint.torque_nm(&at, 0.0, 0.0)
        };
        assert!((steady(-0.011) + 0.31 * libm::exp(-0.002_287_334)).abs() < 1e-6);
        assert!(steady(1.9).abs() < 1e-8);
    }
}
