//! This file turns a brake or a damper along an imposed motion and meters its resistance.
//!
//! Each law is integrated in displacement where it is a law of displacement, on a fine grid between samples. Dry
//! friction keeps its last sign while the velocity is exactly zero.

use super::run::{Delay, Run, skew_s};
use super::setup::Setup;
use crate::brake::{Brake, BrakeStep};
use crate::braked::Braked;
use crate::effect::Effect;
use crate::element::{Element, Instant, sliding_resistance};
use crate::form::Stage;
use crate::forms::Forms;
use rigproof_spec::joint::Joint;

/// Runs the bench with the laws the nominal model knows and the hidden effects, `fine_steps` to a sample.
pub fn run(setup: &Setup, known: &[Effect], hidden: &[Effect], fine_steps: usize) -> Run {
    let step_s = 1.0 / (setup.rate_hz * fine_steps as f64);
    let samples = (setup.duration_s * setup.rate_hz) as usize;
    let mut bench = Bench::new(setup, known, hidden);
    let delay_s = skew_s(hidden);
    let mut late_position = Delay::new(-delay_s, step_s);
    let mut late_effort = Delay::new(delay_s, step_s);
    let mut skewed = Delay::new(delay_s.abs(), step_s);
    let mut run = Run::new(hidden.len(), samples);
    for fine in 0..samples * fine_steps {
        let time_s = fine as f64 * step_s;
        if fine > 0 {
            bench.advance(setup, time_s, step_s);
        }
        let at = bench.at;
        let effort = bench.effort();
        late_position.push(at.position);
        late_effort.push(effort);
        skewed.push(effort);
        if fine.is_multiple_of(fine_steps) {
            run.take(time_s, at.position, at.velocity, late_position.value());
            run.shown_effort.push(late_effort.value());
            if let Some((_, currents)) = setup.brake() {
                run.shown_input.push(currents.at(time_s));
            }
            for (effect, force) in hidden.iter().zip(&mut run.hidden) {
                force.push(match effect.stage() {
                    Stage::Sensor => skewed.value() - effort,
                    Stage::Drive => bench.brake_excess(),
                    _ => bench.resistance_of(effect),
                });
            }
        }
    }
    run
}

struct Bench {
    elements: Vec<Element>,
    brake: Option<Turned>,
    at: Instant,
}

impl Bench {
    fn new(setup: &Setup, known: &[Effect], hidden: &[Effect]) -> Bench {
        let (position, velocity) = setup.path.at(0.0);
        let (_, first_velocity) = setup.path.at(1.0 / setup.rate_hz);
        let brake = setup
            .brake()
            .map(|(joint, _)| Turned::new(setup, joint, hidden, position));
        Bench {
            elements: known
                .iter()
                .chain(hidden)
                .copied()
                .map(Element::new)
                .collect(),
            brake,
            at: Instant {
                time_s: 0.0,
                position,
                velocity,
                direction: first_velocity.signum(),
                load: 0.0,
                brake: 0.0,
            },
        }
    }

    fn advance(&mut self, setup: &Setup, time_s: f64, step_s: f64) {
        let (position, velocity) = setup.path.at(time_s);
        let travel = position - self.at.position;
        let mut before = self.at;
        if travel != 0.0 {
            before.direction = travel.signum();
        }
        for element in &mut self.elements {
            element.advance(&before, travel, step_s);
        }
        let direction = if velocity == 0.0 {
            before.direction
        } else {
            velocity.signum()
        };
        self.at = Instant {
            time_s,
            position,
            velocity,
            direction,
            load: 0.0,
            brake: 0.0,
        };
        if let (Some(brake), Some((_, currents))) = (&mut self.brake, setup.brake()) {
            let step = BrakeStep {
                step_s,
                // The current of the step that ends here is the one commanded at its middle.
                current_a: currents.at(time_s - 0.5 * step_s),
                position_rad: position,
                speed_rad_s: velocity,
            };
            brake.step(time_s, &step);
            self.at.brake = brake.yield_nm();
        }
    }

    /// Metered resistance, positive in the sense of positive velocity.
    fn effort(&self) -> f64 {
        let brake = self.brake.as_ref().map_or(0.0, Turned::yield_nm);
        self.at.direction * brake + sliding_resistance(&self.elements, &self.at, 0.0, 0.0)
    }

    fn brake_excess(&self) -> f64 {
        let brake = self.brake.as_ref();
        brake.map_or(0.0, |brake| {
            self.at.direction * (brake.yield_nm() - brake.nominal_nm())
        })
    }

    fn resistance_of(&self, effect: &Effect) -> f64 {
        self.elements
            .iter()
            .filter(|element| element.effect == *effect)
            .map(|element| {
                element.force(&self.at, 0.0, 0.0) + self.at.direction * element.bound(&self.at)
            })
            .sum()
    }
}

/// The brake that is turned, beside the one that the nominal model knows.
enum Turned {
    /// With at most one effect, which acts ahead of its first-order response.
    Usual { own: Brake, nominal: Brake },
    /// With effects in any form.
    Other(Braked),
}

impl Turned {
    fn new(setup: &Setup, joint: Joint, hidden: &[Effect], position_rad: f64) -> Turned {
        let mut effects = hidden
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, e)| e.stage() == Stage::Drive);
        match setup.forms {
            Forms::Usual => Turned::Usual {
                own: Brake::new(
                    joint,
                    effects.next().map(|(_, effect)| effect),
                    position_rad,
                ),
                nominal: Brake::new(joint, None, position_rad),
            },
            Forms::Other => Turned::Other(Braked::new(joint, effects.collect(), position_rad)),
        }
    }

    fn step(&mut self, time_s: f64, step: &BrakeStep) {
        match self {
            Turned::Usual { own, nominal } => {
                own.step(time_s, step);
                nominal.step(time_s, step);
            }
            Turned::Other(brake) => brake.step(time_s, step),
        }
    }

    fn yield_nm(&self) -> f64 {
        match self {
            Turned::Usual { own, .. } => own.yield_nm(),
            Turned::Other(brake) => brake.yield_nm(),
        }
    }

    fn nominal_nm(&self) -> f64 {
        match self {
            Turned::Usual { nominal, .. } => nominal.yield_nm(),
            Turned::Other(brake) => brake.nominal_yield_nm(),
        }
    }
}
