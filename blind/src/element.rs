//! This file computes the resistance of one law at one instant, and carries the law's memory.

use crate::law::{Effect, Law};
use std::f64::consts::TAU;

/// Where the mechanism is.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// s.
    pub time_s: f64,
    /// m or rad.
    pub position: f64,
    /// m/s or rad/s.
    pub velocity: f64,
    /// 1 forward, −1 backward; at rest the direction in question.
    pub direction: f64,
    /// What the drive puts in, N or N·m; zero on a bench.
    pub effort: f64,
}

/// A law with its memory.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub effect: Effect,
    memory: f64,
}

impl Element {
    /// The law before the recording begins.
    pub fn new(effect: Effect) -> Element {
        Element {
            effect,
            memory: 0.0,
        }
    }

    /// The set-valued part: the greatest resistance at rest and the resistance in motion, opposing
    /// `at.direction`, N or N·m.
    pub fn bound(&self, at: &Instant) -> f64 {
        if !self.effect.acts(at.time_s) {
            return 0.0;
        }
        match self.effect.law {
            Law::Dry { level } => level,
            Law::Asymmetry { dry, .. } => dry * at.direction,
            Law::Stribeck {
                peak,
                speed,
                exponent,
            } => {
                let ratio = at.velocity.abs() / speed;
                let power = if exponent == 2.0 {
                    ratio * ratio
                } else {
                    libm::pow(ratio, exponent)
                };
                peak * libm::exp(-power)
            }
            Law::LoadFriction { fraction } => fraction * at.effort.abs(),
            Law::ThermalFade { level, travel } => level / (1.0 + self.memory / travel),
            Law::Settling { level, .. } => level * self.memory,
            // Before any motion nothing has turned.
            Law::ReversalOvershoot { .. } if self.memory == 0.0 => 0.0,
            Law::ReversalOvershoot { level, travel } => {
                level * libm::exp(-self.memory.abs() / travel)
            }
            _ => 0.0,
        }
    }

    /// The single-valued part with the memory as it will be after `travel` more, N or N·m, positive in the sense of
    /// positive velocity.
    pub fn force(&self, at: &Instant, travel: f64) -> f64 {
        if !self.effect.acts(at.time_s) {
            return 0.0;
        }
        let (q, v) = (at.position, at.velocity);
        match self.effect.law {
            Law::Viscous { coefficient } => coefficient * v,
            Law::Asymmetry { viscous, .. } => viscous * v.abs(),
            Law::Bias { level } => level,
            Law::Spring { stiffness } => stiffness * q,
            Law::Cubic { cubic } => cubic * q * q * q,
            Law::Ripple {
                sine,
                cosine,
                period,
            } => {
                let (s, c) = libm::sincos(TAU * q / period);
                sine * s + cosine * c
            }
            Law::Dahl { .. } | Law::BoucWen { .. } => self.memory_after(at, travel, 0.0),
            Law::QuadraticDrag { level, speed } => level * (v / speed) * (v / speed).abs(),
            Law::Disturbance { level, period } => level * libm::sin(TAU * at.time_s / period),
            _ => 0.0,
        }
    }

    /// Moves the memory over a step of constant direction.
    pub fn advance(&mut self, at: &Instant, travel: f64, step_s: f64) {
        if self.effect.acts(at.time_s) {
            self.memory = self.memory_after(at, travel, step_s);
        }
    }

    fn memory_after(&self, at: &Instant, travel: f64, step_s: f64) -> f64 {
        let memory = self.memory;
        match self.effect.law {
            // Exact along a displacement of constant sign, so no step is too coarse for a stiff bristle.
            Law::Dahl {
                level,
                travel: yield_travel,
            } => {
                let limit = level * at.direction;
                limit - (limit - memory) * libm::exp(-travel.abs() / yield_travel)
            }
            Law::BoucWen {
                alpha,
                beta_gamma,
                beta_delta,
            } => {
                let slope = |z: f64| alpha - beta_gamma * z * at.direction - beta_delta * z.abs();
                let middle = memory + 0.5 * travel * slope(memory);
                memory + travel * slope(middle)
            }
            Law::ThermalFade {
                travel: fade_travel,
                ..
            } => memory + travel.abs() / (1.0 + memory / fade_travel),
            Law::Settling {
                time,
                travel: wear_travel,
                ..
            } => {
                if travel == 0.0 {
                    1.0 - (1.0 - memory) * libm::exp(-step_s / time)
                } else {
                    memory * libm::exp(-travel.abs() / wear_travel)
                }
            }
            Law::ReversalOvershoot { .. } if memory == 0.0 && travel != 0.0 => {
                f64::INFINITY.copysign(travel)
            }
            Law::ReversalOvershoot { .. } if travel * memory < 0.0 => travel,
            Law::ReversalOvershoot { .. } => memory + travel,
            _ => memory,
        }
    }
}

/// The resistance of all elements in motion, N or N·m; dry friction never drives.
pub fn sliding_resistance(elements: &[Element], at: &Instant, travel: f64) -> f64 {
    let force: f64 = elements.iter().map(|e| e.force(at, travel)).sum();
    force + at.direction * total_bound(elements, at)
}

/// The set-valued part of all elements, N or N·m, never negative.
pub fn total_bound(elements: &[Element], at: &Instant) -> f64 {
    elements.iter().map(|e| e.bound(at)).sum::<f64>().max(0.0)
}
