//! This file computes the joint positions of the linkage over time, as recorded and as two models
//! simulate them, for a replay.

use super::free_run::{Model, Simulated, simulated};
use super::from_rig::aligned;
use super::run::FiveBarRun;
use crate::plant::{Frame, RESTART_S, Replayed};
use rigproof_model::linkage::{Pose, forward, point_a_m, point_b_m};
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};

/// Frames per second.
const RATE_HZ: f64 = 25.0;
/// The longest replay, s. The reference rig is slow to simulate.
pub const LONGEST_S: f64 = 20.0;

/// The end of a recording, at most [`LONGEST_S`], beside free runs of two descriptions; `None` if
/// it cannot be simulated.
pub fn replayed(
    before: &FiveBar,
    after: &FiveBar,
    recording: &FiveBarRecording,
) -> Option<Replayed> {
    let run = aligned(before, recording).ok()?;
    let longest = (LONGEST_S / run.step_s).round() as usize;
    let run = run.part(run.len().saturating_sub(longest), run.len());
    let one = |description| simulated(&Model::of(description), &run, RESTART_S).ok();
    let (old, new) = (one(before)?, one(after)?);
    let every = (1.0 / RATE_HZ / run.step_s).round().max(1.0) as usize;
    let frames = |of: &dyn Fn(usize) -> Frame| (0..run.len()).step_by(every).map(of).collect();
    Some(Replayed {
        time_s: (0..run.len())
            .step_by(every)
            .map(|k| run.start_s + k as f64 * run.step_s)
            .collect(),
        point_a_m: point_a_m(&run.parameters.arms),
        point_b_m: point_b_m(&run.parameters.arms),
        recorded: frames(&|k| run.poses.get(k).map(frame)),
        before: frames(&|k| posed(&run, &old, k)),
        after: frames(&|k| posed(&run, &new, k)),
    })
}

fn posed(run: &FiveBarRun, simulated: &Simulated, k: usize) -> Frame {
    let [a, b] = &simulated.theta_rad;
    let pose = forward::pose(&run.parameters.arms, *a.get(k)?, *b.get(k)?);
    pose.as_ref().ok().map(frame)
}

const fn frame(pose: &Pose) -> [f64; 6] {
    let ([e_x, e_y], [d_x, d_y], [c_x, c_y]) = (pose.point_e_m, pose.tip_m, pose.point_c_m);
    [e_x, e_y, d_x, d_y, c_x, c_y]
}
