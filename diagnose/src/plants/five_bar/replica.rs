//! This file simulates a recording of the five-bar: a hand leads the tip of the reference rig along
//! the recorded path with the recorded force, so that the excitation is the same.

use super::experiment::play::{DAMPING_NS_M, Played, STIFFNESS_N_M, shown};
use super::free_run::{Model, currents_at, force_at, parts_of, truly};
use super::from_rig::aligned;
use super::run::FiveBarRun;
use crate::plant::{Replica, Run};
use rigproof_model::error::ModelError;
use rigproof_model::rig::Rig;
use rigproof_trace::rig::Signal;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};

/// The recording that a rig with the parameters of `model` would have made. `nominal` describes the
/// recording.
///
/// # Errors
/// The recording is faulty, or the rig cannot be given the effects or be led there.
pub(crate) fn replica(
    nominal: &FiveBar,
    model: &FiveBar,
    recording: &FiveBarRecording,
) -> Result<Replica<FiveBarRecording>, String> {
    let run = aligned(nominal, recording).map_err(|fault| fault.reason)?;
    let played = followed(&Model::of(model), &run).map_err(|error| error.to_string())?;
    let with = |signal: &Signal, samples: Vec<f64>| Signal {
        samples,
        ..signal.clone()
    };
    let [theta_a, theta_b] = played.theta_rad;
    let [force_x, force_y] = played.force_n;
    let [shown_a, shown_b] = &recording.theta;
    let [shown_x, shown_y] = &recording.force;
    let mut currents = recording.currents.clone();
    for (current, samples) in currents.iter_mut().zip(played.currents_a) {
        if let Some(current) = current {
            current.samples = samples;
        }
    }
    Ok(Replica {
        noise: [run.theta_noise, run.force_noise],
        how: "the reference rig from the recorded first state, under the recorded currents and force, and led by a hand of 420 N/m and 11 N·s/m along the recorded path of its tip",
        recording: FiveBarRecording {
            time_s: played.time_s,
            theta: [with(shown_a, theta_a), with(shown_b, theta_b)],
            force: [with(shown_x, force_x), with(shown_y, force_y)],
            currents,
        },
    })
}

/// The recorded tip path, its velocity and the force, interpolated linearly between samples.
struct Led<'a> {
    run: &'a FiveBarRun,
}

impl Led<'_> {
    fn tip_m(&self, k: usize) -> [f64; 2] {
        let last = self.run.poses.len().saturating_sub(1);
        let pose = self.run.poses.get(k.min(last));
        pose.map_or([0.0; 2], |pose| pose.tip_m)
    }

    fn velocity_m_s(&self, k: usize) -> [f64; 2] {
        let (from, to) = (k.saturating_sub(1), k + 1);
        let last = self.run.poses.len().saturating_sub(1);
        let time_s = (to.min(last) - from.min(last)).max(1) as f64 * self.run.step_s;
        let ([x, y], [to_x, to_y]) = (self.tip_m(from), self.tip_m(to));
        [(to_x - x) / time_s, (to_y - y) / time_s]
    }

    /// The force of the hand, N, at the fraction `share` of the interval after sample `k`.
    fn force_n(&self, k: usize, share: f64, tip_m: [f64; 2], velocity_m_s: [f64; 2]) -> [f64; 2] {
        let between = |of: &dyn Fn(usize) -> [f64; 2]| {
            let ([x, y], [to_x, to_y]) = (of(k), of(k + 1));
            [x + share * (to_x - x), y + share * (to_y - y)]
        };
        let [force_x, force_y] = between(&|k| force_at(self.run, k));
        let [to_x, to_y] = between(&|k| self.tip_m(k));
        let [at_x, at_y] = between(&|k| self.velocity_m_s(k));
        let ([x, y], [v_x, v_y]) = (tip_m, velocity_m_s);
        [
            force_x + STIFFNESS_N_M * (to_x - x) + DAMPING_NS_M * (at_x - v_x),
            force_y + STIFFNESS_N_M * (to_y - y) + DAMPING_NS_M * (at_y - v_y),
        ]
    }
}

fn followed(model: &Model, run: &FiveBarRun) -> Result<Played, ModelError> {
    let run = truly(model, run)?;
    let led = Led { run: &run };
    let [joint_a, _, joint_b, _] = &run.joints;
    let first = joint_a.first().zip(joint_b.first());
    let (theta, rates) = first.map_or(([0.0; 2], [0.0; 2]), |(a, b)| {
        ([a.position, b.position], [a.speed, b.speed])
    });
    let mut rig = Rig::moving(run.parameters, theta, rates)?.with_effects(&model.rig)?;
    let parts = parts_of(run.step_s);
    let mut played = Played::default();
    for k in 0..run.len() {
        let now = led.force_n(k, 0.0, rig.tip_m(), rig.tip_velocity_m_s());
        let currents = currents_at(&run, k);
        let time_s = run.start_s + k as f64 * run.step_s;
        played.record(time_s, rig.base_angles_rad(), now, currents);
        for part in 0..parts as usize {
            let share = (part as f64 + 0.5) / parts;
            let hand = |tip, speed| led.force_n(k, share, tip, speed);
            rig.step_under(&hand, currents, run.step_s / parts)?;
        }
    }
    for effect in model.sensors.iter().rev() {
        let first = effect.first_sample(run.clock());
        shown(effect, &mut played, run.step_s, first);
    }
    Ok(played)
}
