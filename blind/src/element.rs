//! This file computes the force of one law at one instant, and carries the law's memory.

use crate::effect::{Effect, Scales};
use crate::form::Form;
use std::f64::consts::TAU;

/// Where a joint is. Travel is m or rad, effort N or N·m.
#[derive(Clone, Copy, Debug)]
pub struct Instant {
    /// s.
    pub time_s: f64,
    /// Since the start.
    pub position: f64,
    pub velocity: f64,
    /// 1 forward, −1 backward; at rest the direction in question.
    pub direction: f64,
    /// What the joint transmits: the drive's effort, or the magnitude of the force on the tip, N; zero on a bench.
    pub load: f64,
    /// What the brake at the joint resists with.
    pub brake: f64,
}

/// Elements of a Maxwell-slip joint.
const ELEMENTS: usize = 6;
/// Damping of the bristle over its stiffness, s (σ₁/σ₀ of LuGre).
const BRISTLE_DAMPING_S: f64 = 1e-3;

/// A law with its memory.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub effect: Effect,
    /// Deflections, or whatever else the law remembers; a law with one memory uses the first.
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

    /// Whether the law is a set at rest.
    pub const fn is_frictional(&self) -> bool {
        matches!(
            self.effect.form,
            Form::Coulomb
                | Form::Bearing
                | Form::LoadArm
                | Form::LoadSided
                | Form::LoadSquare
                | Form::Uneven
        )
    }

    /// What the numbers are a share of.
    fn share(&self, at: &Instant) -> f64 {
        match self.effect.scales {
            Scales::Nothing => 1.0,
            Scales::Drive => at.brake,
        }
    }

    /// The set-valued part: the greatest resistance at rest and the resistance in motion, opposing `at.direction`.
    pub fn bound(&self, at: &Instant) -> f64 {
        if !self.effect.acts(at.time_s) {
            return 0.0;
        }
        let ([a, b, c, _], [memory, ..]) = (self.effect.values, self.memory);
        let bound = match self.effect.form {
            Form::Coulomb | Form::Bearing => a,
            // As a share of a brake the difference is the shift of a set that is not among the elements.
            Form::Asymmetric if self.effect.scales == Scales::Drive => 0.0,
            Form::Asymmetric => a * at.direction,
            Form::Stribeck => {
                let ratio = at.velocity.abs() / b;
                let power = match c {
                    2.0 => ratio * ratio,
                    _ => libm::pow(ratio, c),
                };
                a * libm::exp(-power)
            }
            Form::Rational => a / (1.0 + (at.velocity / b) * (at.velocity / b)),
            Form::LoadShare | Form::LoadArm => a * at.load.abs(),
            Form::LoadSided if at.load * at.direction >= 0.0 => a * at.load.abs(),
            Form::LoadSided => b * at.load.abs(),
            Form::LoadSquare => a * (at.load / b) * (at.load / b),
            Form::Uneven => a * (1.0 + b * libm::sin(TAU * at.position / c)),
            Form::WorkFade => a / (1.0 + memory / b),
            Form::FadeLinear => -a * (at.time_s / b).min(1.0),
            Form::FadeExponential => -a * (1.0 - libm::exp(-at.time_s / b)),
            Form::FadeByWay => -a * (1.0 - libm::exp(-memory / b)),
            Form::Settling => a * memory,
            // Before any motion nothing has turned.
            Form::Overshoot | Form::OvershootLinear if memory == 0.0 => 0.0,
            Form::Overshoot => a * libm::exp(-memory.abs() / b),
            Form::OvershootLinear => a * (1.0 - memory.abs() / b).max(0.0),
            Form::Gap if memory.abs() < b => -a,
            // A brake resists: its ripple is one of its resistance.
            _ if self.effect.scales == Scales::Drive => self.of_position(at),
            _ => return 0.0,
        };
        self.share(at) * bound
    }

    /// The single-valued part with the memory as it will be after `travel` more, positive in the sense of positive velocity.
    pub fn force(&self, at: &Instant, travel: f64, step_s: f64) -> f64 {
        if !self.effect.acts(at.time_s) {
            return 0.0;
        }
        let [a, b, c, d] = self.effect.values;
        let (q, v) = (at.position, at.velocity);
        let force = match self.effect.form {
            Form::Viscous => a * v,
            Form::Bearing => b * v,
            Form::Asymmetric if self.effect.scales == Scales::Drive => a,
            Form::Asymmetric => b * v.abs(),
            Form::Bias => a,
            Form::Drift => a * at.time_s,
            Form::Creep => a * (1.0 - libm::exp(-at.time_s / b)),
            Form::Spring => a * q,
            Form::Anchored => a * (q - b),
            Form::Tether => a * (b.signum() * q - b.abs()).max(0.0) * b.signum(),
            Form::Cubic => a * q * q * q,
            Form::Hardening => a * q + b * q * q * q,
            Form::Square => a * (v / b) * (v / b).abs(),
            Form::Root => a * (v / b).abs().sqrt() * v.signum(),
            Form::Power => a * libm::pow((v / b).abs(), c) * v.signum(),
            Form::Tanh => a * libm::tanh(v / b),
            Form::Disturbance => a * libm::sin(TAU * at.time_s / b),
            Form::Dahl | Form::BoucWen | Form::DahlPower | Form::ElastoPlastic => {
                self.first_after(at, travel)
            }
            Form::Travelled => self.first_after(at, travel),
            Form::Lugre => self.damped(at, travel, step_s, BRISTLE_DAMPING_S),
            Form::Bristle => self.damped(at, travel, step_s, c),
            Form::MaxwellSlip | Form::OneSided => {
                self.memory_after(at, travel, step_s).iter().sum()
            }
            _ if self.effect.scales == Scales::Nothing => self.of_position(at),
            _ => return 0.0,
        };
        let _ = d;
        self.share(at) * force
    }

    /// What comes and goes with the position; 0 for the other forms.
    fn of_position(&self, at: &Instant) -> f64 {
        let ([a, b, c, _], q) = (self.effect.values, at.position);
        match self.effect.form {
            Form::Ripple => {
                let (sine, cosine) = libm::sincos(TAU * q / c);
                a * sine + b * cosine
            }
            Form::TwoOrders => {
                let phase = TAU * q / b;
                a * (libm::sin(phase) + c * libm::sin(2.0 * phase + 1.0))
            }
            Form::Toothed => a * libm::tanh(c * libm::sin(TAU * q / b)) / libm::tanh(c),
            Form::TwoRipples => a * (libm::sin(TAU * q / b) + libm::sin(TAU * q / c + 1.0)),
            _ => 0.0,
        }
    }

    fn first_after(&self, at: &Instant, travel: f64) -> f64 {
        let [after, ..] = self.memory_after(at, travel, 0.0);
        after
    }

    /// The deflection and what its rate adds.
    fn damped(&self, at: &Instant, travel: f64, step_s: f64, damping_s: f64) -> f64 {
        let ([before, ..], after) = (self.memory, self.first_after(at, travel));
        let rate = match step_s > 0.0 {
            true => (after - before) / step_s,
            false => 0.0,
        };
        after + damping_s * rate
    }

    /// Moves the memory over a step of constant direction.
    pub fn advance(&mut self, at: &Instant, travel: f64, step_s: f64) {
        if self.effect.acts(at.time_s) {
            self.memory = self.memory_after(at, travel, step_s);
        }
    }

    fn memory_after(&self, at: &Instant, travel: f64, step_s: f64) -> [f64; ELEMENTS] {
        let mut memory = self.memory;
        let [a, b, c, _] = self.effect.values;
        match self.effect.form {
            // Each yields a sixth of the level, after one, two, … sixths of the travel.
            Form::MaxwellSlip => slip(&mut memory, travel, a / b, [a, a]),
            Form::OneSided => slip(&mut memory, travel, 0.5 * (a + b) / c, [b, a]),
            _ => {
                let [first, ..] = &mut memory;
                *first = self.first(at, *first, travel, step_s);
            }
        }
        memory
    }

    /// The memory of a law that has only one.
    fn first(&self, at: &Instant, memory: f64, travel: f64, step_s: f64) -> f64 {
        let [a, b, c, d] = self.effect.values;
        match self.effect.form {
            // Exact along a displacement of constant sign, so no step is too coarse for a stiff bristle.
            Form::Dahl => {
                let limit = a * at.direction;
                limit - (limit - memory) * libm::exp(-travel.abs() / b)
            }
            Form::Bristle if travel != 0.0 => bristle(memory, travel, a, a / b),
            // dz/dt = σ₀·(v − |v|·z/g), exact at a constant rate: z goes to g·sgn v, faster as g falls.
            Form::Lugre if travel != 0.0 => {
                let ratio = at.velocity / b;
                bristle(memory, travel, (a * libm::exp(-ratio * ratio)).max(1e-9), d)
            }
            Form::Travelled if travel != 0.0 => {
                let level = (a * libm::exp(-(at.velocity / b).abs())).max(1e-9 * a);
                let limit = level * travel.signum();
                limit + (memory - limit) * libm::exp(-travel.abs() / c)
            }
            Form::DahlPower => {
                let slope = |z: f64| {
                    let left = (1.0 - z * at.direction / a).max(0.0);
                    a / b * libm::pow(left, c)
                };
                let middle = memory + 0.5 * travel * slope(memory);
                (memory + travel * slope(middle)).clamp(-a, a)
            }
            Form::ElastoPlastic => {
                let past = (memory.abs() / a - c) / (1.0 - c);
                let creep = match memory * at.direction > 0.0 {
                    true => past.clamp(0.0, 1.0),
                    false => 0.0,
                };
                let smooth = creep * creep * (3.0 - 2.0 * creep);
                (memory + travel * a / b * (1.0 - smooth)).clamp(-a, a)
            }
            Form::BoucWen => {
                let slope = |z: f64| a - b * z * at.direction - c * z.abs();
                let middle = memory + 0.5 * travel * slope(memory);
                memory + travel * slope(middle)
            }
            Form::WorkFade => memory + travel.abs() / (1.0 + memory / b),
            Form::FadeByWay => memory + travel.abs(),
            Form::Settling if travel == 0.0 => 1.0 - (1.0 - memory) * libm::exp(-step_s / b),
            Form::Settling => memory * libm::exp(-travel.abs() / c),
            Form::Overshoot | Form::OvershootLinear | Form::Gap => since_reversal(memory, travel),
            _ => memory,
        }
    }
}

/// A bristle of a level and a stiffness after a travel that is not zero.
fn bristle(deflection: f64, travel: f64, level: f64, stiffness: f64) -> f64 {
    let limit = level * travel.signum();
    let fade = libm::exp(-stiffness * travel.abs() / level);
    limit + (deflection - limit) * fade
}

/// Elasto-plastic elements side by side with limits backward and forward.
fn slip(memory: &mut [f64; ELEMENTS], travel: f64, stiffness: f64, [backward, forward]: [f64; 2]) {
    let elements = ELEMENTS as f64;
    for (k, deflection) in memory.iter_mut().enumerate() {
        let moved = *deflection + stiffness / (k + 1) as f64 * travel;
        *deflection = moved.clamp(-backward / elements, forward / elements);
    }
}

/// Signed travel since the last reversal: infinite before the first one, none before any motion.
fn since_reversal(since: f64, travel: f64) -> f64 {
    if since == 0.0 && travel != 0.0 {
        f64::INFINITY.copysign(travel)
    } else if travel * since < 0.0 {
        travel
    } else {
        since + travel
    }
}

/// The resistance of all elements in motion; dry friction never drives.
pub fn sliding_resistance(elements: &[Element], at: &Instant, travel: f64, step_s: f64) -> f64 {
    let force: f64 = elements.iter().map(|e| e.force(at, travel, step_s)).sum();
    force + at.direction * total_bound(elements, at)
}

/// The set-valued part of all elements, never negative.
pub fn total_bound(elements: &[Element], at: &Instant) -> f64 {
    elements.iter().map(|e| e.bound(at)).sum::<f64>().max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(velocity: f64) -> Instant {
        Instant {
            time_s: 0.0,
            position: 0.0,
            velocity,
            direction: velocity.signum(),
            load: 0.0,
            brake: 0.0,
        }
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
                position: angle_rad,
                ..moving(travel / step_s)
            };
            work_j[(k / steps) as usize] += element.force(&at, 0.5 * travel, 0.5 * step_s) * travel;
            element.advance(&at, travel, 0.0);
            angle_rad = next;
        }
        work_j
    }

    #[test]
    fn closed_cycles_of_memory_cost_energy() {
        for law in [
            Form::Lugre.of([0.31, 0.23, 2.0, 170.0]),
            Form::MaxwellSlip.of([0.27, 0.041]),
            Form::OneSided.of([0.21, 0.47, 0.033]),
        ] {
            for amplitude_rad in [0.007, 0.31] {
                let [_, second, third] = cycle_work(Element::new(law), amplitude_rad);
                assert!(
                    second > 0.0 && (third / second - 1.0).abs() < 0.1,
                    "{law:?} {second} {third}"
                );
            }
        }
    }

    #[test]
    fn the_maxwell_slip_joint_yields_its_level_after_its_travel() {
        let mut joint = Element::new(Form::MaxwellSlip.of([0.27, 0.041]));
        let at = moving(0.3);
        joint.advance(&at, 0.0409, 0.0);
        assert!(joint.force(&at, 0.0, 0.0) < 0.27);
        joint.advance(&at, 0.0002, 0.0);
        assert!((joint.force(&at, 0.0, 0.0) - 0.27).abs() < 1e-12);
        // Masing's rule: the reversed branch is the virgin one at twice the scale.
        joint.advance(&at, -0.0818, 0.0);
        assert!(joint.force(&at, 0.0, 0.0) > -0.27);
        joint.advance(&at, -0.0003, 0.0);
        assert!((joint.force(&at, 0.0, 0.0) + 0.27).abs() < 1e-12);
    }

    #[test]
    fn the_lugre_joint_peaks_at_rest_and_gives_nothing_at_speed() {
        let steady = |rate_rad_s: f64| {
            let mut joint = Element::new(Form::Lugre.of([0.31, 0.23, 2.0, 170.0]));
            let at = moving(rate_rad_s);
            joint.advance(&at, 0.7 * rate_rad_s.signum(), 0.0);
            joint.force(&at, 0.0, 0.0)
        };
        assert!((steady(-0.011) + 0.31 * libm::exp(-0.002_287_334)).abs() < 1e-6);
        assert!(steady(1.9).abs() < 1e-8);
    }
}
