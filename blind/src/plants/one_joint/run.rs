//! This file is what a plant did: the true signals at the recording's instants.

use crate::effect::Effect;
use crate::form::Form;

/// The true signals, one value an instant. Travel is m or rad, effort N or N·m.
#[derive(Clone, Debug, Default)]
pub struct Run {
    pub time_s: Vec<f64>,
    /// The motion at `time_s`.
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    /// Whether the mechanism slides.
    pub moving: Vec<bool>,
    /// What the position channel shows; late by a channel skew.
    pub shown_position: Vec<f64>,
    /// What the input channel shows: command, V, or current, A.
    pub shown_input: Vec<f64>,
    /// What the effort channel shows on a bench; empty on an axis.
    pub shown_effort: Vec<f64>,
    /// The generalised force of each hidden effect along the motion.
    pub hidden: Vec<Vec<f64>>,
}

impl Run {
    /// An empty run with room for this many effects and samples.
    pub fn new(effects: usize, samples: usize) -> Run {
        Run {
            hidden: vec![Vec::with_capacity(samples); effects],
            ..Run::default()
        }
    }

    /// Takes one instant of the motion, and what the position channel shows of it.
    pub fn take(&mut self, time_s: f64, position: f64, velocity: f64, shown_position: f64) {
        self.time_s.push(time_s);
        self.position.push(position);
        self.velocity.push(velocity);
        self.moving.push(velocity != 0.0);
        self.shown_position.push(shown_position);
    }
}

/// The time by which a hidden skew delays a channel, s; 0 without one.
pub fn skew_s(hidden: &[Effect]) -> f64 {
    let skew = hidden.iter().find(|effect| effect.form == Form::Skew);
    skew.map_or(0.0, Effect::first)
}

/// A signal's recent past on the fine grid, to show a channel late.
#[derive(Clone, Debug)]
pub struct Delay {
    past: std::collections::VecDeque<f64>,
    steps: f64,
}

impl Delay {
    /// A delay of `delay_s` (none when negative) on a grid of `step_s`.
    pub fn new(delay_s: f64, step_s: f64) -> Delay {
        Delay {
            past: std::collections::VecDeque::new(),
            steps: (delay_s / step_s).max(0.0),
        }
    }

    /// Takes the signal's newest value; call once a fine step.
    pub fn push(&mut self, value: f64) {
        self.past.push_front(value);
        self.past.truncate(self.steps.ceil() as usize + 1);
    }

    /// The delayed value, linear between fine instants; the first value before the recording.
    pub fn value(&self) -> f64 {
        let whole = self.steps.floor();
        let oldest = self.past.back().copied().unwrap_or(0.0);
        let at = |k: f64| self.past.get(k as usize).copied().unwrap_or(oldest);
        let fraction = self.steps - whole;
        (1.0 - fraction) * at(whole) + fraction * at(whole + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_shown_late_by_the_delay() {
        let mut delay = Delay::new(0.003_7, 0.001);
        for k in 0..50 {
            delay.push(f64::from(k));
        }
        assert!((delay.value() - 45.3).abs() < 1e-12);
        let mut none = Delay::new(-0.004, 0.001);
        none.push(1.5);
        assert_eq!(none.value(), 1.5);
    }
}
