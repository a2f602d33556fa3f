//! This file is the way from the held command to the effort at the joint, with what is hidden on it.

use crate::effect::Effect;
use crate::form::{Form, Stage};
use std::collections::VecDeque;

/// The drive: its gain, then one stage after the other.
pub struct Chain {
    gain: f64,
    stages: Vec<Link>,
}

/// One stage with its memory.
struct Link {
    effect: Effect,
    /// Output and its rate.
    state: [f64; 2],
    past: VecDeque<f64>,
}

impl Chain {
    /// A drive at rest.
    pub fn new(gain: f64, hidden: &[Effect]) -> Chain {
        let stages = hidden
            .iter()
            .filter(|effect| effect.stage() == Stage::Drive);
        let link = |effect: &Effect| Link {
            effect: *effect,
            state: [0.0; 2],
            past: VecDeque::new(),
        };
        Chain {
            gain,
            stages: stages.map(link).collect(),
        }
    }

    /// The effort over a fine step that begins at a time, N·m.
    pub fn step(&mut self, time_s: f64, command: f64, step_s: f64) -> f64 {
        let ideal = self.gain * command;
        let pass = |effort: f64, link: &mut Link| link.step(time_s, effort, step_s);
        self.stages.iter_mut().fold(ideal, pass)
    }
}

impl Link {
    fn step(&mut self, time_s: f64, effort: f64, step_s: f64) -> f64 {
        let [a, b, ..] = self.effect.values;
        if !self.effect.acts(time_s) {
            self.state = [effort, 0.0];
            return effort;
        }
        match self.effect.form {
            Form::Gain => (1.0 + a) * effort,
            Form::Saturation => effort.clamp(-a, a),
            Form::SoftSaturation => a * libm::tanh(effort / a),
            Form::DeadZone => effort.signum() * (effort.abs() - a).max(0.0),
            Form::Lag => {
                let [output, rate] = &mut self.state;
                *rate = 0.0;
                *output = effort + (*output - effort) * libm::exp(-step_s / a);
                *output
            }
            Form::LagSecond => {
                let [output, rate] = &mut self.state;
                let pull = (effort - *output) / (a * a) - 2.0 * b / a * *rate;
                *rate += step_s * pull;
                *output += step_s * *rate;
                *output
            }
            Form::RateLimit => {
                let [output, _] = &mut self.state;
                *output += (effort - *output).clamp(-a * step_s, a * step_s);
                *output
            }
            Form::DeadTime => {
                self.past.push_front(effort);
                let steps = a / step_s;
                self.past.truncate(steps.ceil() as usize + 2);
                let value = |k: f64| self.past.get(k as usize).copied().unwrap_or(0.0);
                let part = steps - steps.floor();
                (1.0 - part) * value(steps.floor()) + part * value(steps.floor() + 1.0)
            }
            _ => effort,
        }
    }
}
