//! This file is a position servo at a joint: the effort that it gave along a recording, and the
//! effort that it gives in a free run, where it feeds back the simulated position.

use super::drive::drive_of;
use super::run::JointRun;
use super::simulate::{Free, Model, Protocol};
use crate::align::resample;
use rigproof_model::axis::State;
use rigproof_model::effects::{Drive, lagged_held, limited, slewed_held};
use rigproof_trace::rig::{Recording, Servo};

/// A servo with its goal, one value per sample of the run that it drives.
#[derive(Clone, Debug)]
pub struct Servoed {
    servo: Servo,
    /// Effort per volt.
    command_gain: f64,
    goal: Vec<f64>,
    /// Whether it is switched on.
    is_on: Vec<bool>,
}

impl Servoed {
    /// The servo of a recording, resampled to its run; `None` without a servo.
    pub(super) fn of(recording: &Recording, command_gain: f64, run: &JointRun) -> Option<Servoed> {
        let (servo, goal) = (recording.servo?, recording.drive.as_ref()?);
        let on_run =
            |samples: &[f64]| resample(&recording.time_s, samples, run.step_s, run.len()).0;
        let is_on = match &recording.enabled {
            Some(enabled) => on_run(&enabled.samples)
                .iter()
                .map(|on| *on > 0.5)
                .collect(),
            None => vec![true; run.len()],
        };
        Some(Servoed {
            servo,
            command_gain,
            goal: on_run(&goal.samples),
            is_on,
        })
    }

    /// The goal of each sample.
    pub(super) fn goal(&self) -> &[f64] {
        &self.goal
    }

    pub(super) fn part(&self, from: usize, to: usize) -> Servoed {
        Servoed {
            goal: self.goal.get(from..to).unwrap_or_default().to_vec(),
            is_on: self.is_on.get(from..to).unwrap_or_default().to_vec(),
            ..*self
        }
    }

    /// The effort at a state of the joint. `between` is the fraction of the way to the next sample.
    fn effort(&self, sample: usize, between: f64, position: f64, speed: f64) -> f64 {
        if !self.is_on.get(sample).is_some_and(|on| *on) {
            return 0.0;
        }
        let goal = self.goal.get(sample).copied().unwrap_or(position);
        let next = self.goal.get(sample + 1).copied().unwrap_or(goal);
        let error = goal + between * (next - goal) - position;
        self.command_gain * (self.servo.voltage(error) - self.servo.back_emf * speed)
    }

    /// The effort that it gave along the recorded motion.
    pub(super) fn along(&self, run: &JointRun) -> Vec<f64> {
        let each = run.position.iter().zip(&run.motion).enumerate();
        each.map(|(k, (position, now))| self.effort(k, 0.0, *position, now.speed))
            .collect()
    }

    /// The positions of a free run from a start state. The loop is closed over the simulated joint.
    pub(super) fn free_run(
        &self,
        (plant, free): (&Model, &mut Free),
        (first, state): (usize, &mut State),
        protocol: &Protocol,
        step_s: f64,
    ) -> Vec<f64> {
        let mut drive = Driven::of(plant, step_s);
        let mut out = Vec::with_capacity(self.goal.len().saturating_sub(first));
        for sample in first..self.goal.len() {
            out.push(state.position);
            free.take_hold(state.time_s);
            for part in 0..protocol.substeps {
                let between = part as f64 / protocol.substeps as f64;
                let own = self.effort(sample, between, state.position, state.speed);
                let effort = drive.changed(own, state.time_s);
                free.run(state, &[(effort, effort)], step_s);
            }
        }
        out
    }
}

/// The effort of the closed loop after the described changes of its drive, step by step.
struct Driven<'a> {
    plant: &'a Model,
    step_s: f64,
    before: Vec<f64>,
    lagged: Option<f64>,
    slewed: Option<f64>,
}

impl Driven<'_> {
    fn of(plant: &Model, step_s: f64) -> Driven<'_> {
        Driven {
            plant,
            step_s,
            before: Vec::new(),
            lagged: None,
            slewed: None,
        }
    }

    fn changed(&mut self, effort: f64, time_s: f64) -> f64 {
        self.before.push(effort);
        let mut out = effort;
        for effect in &self.plant.effects {
            if effect.onset_s.is_some_and(|onset_s| onset_s > time_s) {
                continue;
            }
            let value = effect.value(0);
            match drive_of(effect) {
                Some(Drive::Gain) => out *= 1.0 + value,
                Some(Drive::Limit) => out = limited(out, &effect.parameters),
                Some(Drive::Rate) => {
                    let last = self.slewed.unwrap_or(out);
                    let [mean, end] = slewed_held(last, out, value * self.step_s);
                    out = mean;
                    self.slewed = Some(end);
                }
                Some(Drive::Lag) => {
                    let last = self.lagged.unwrap_or(out);
                    let [mean, end] = lagged_held(last, out, self.step_s, value);
                    out = mean;
                    self.lagged = Some(end);
                }
                Some(Drive::Skew) => {
                    let back = (value / self.step_s).round().max(0.0) as usize;
                    let place = self.before.len().saturating_sub(1 + back);
                    out = self.before.get(place).copied().unwrap_or(out);
                }
                None => {}
            }
        }
        out
    }
}
