//! This file compares an arm's two models joint by joint.

use super::align::arm;
use super::run::ChainRun;
use crate::diagnose::balance::modelled;
use crate::diagnose::write::Stand;
use crate::filter::rms;
use crate::plant::Run;
use crate::problem::Problem;
use crate::report::{ArmReport, JointReport, is_of_joint};
use crate::rules::ARM_WIDTH_S;
use rigproof_spec::effect::Quantity;
use rigproof_trace::rig::chain::ChainRig;

/// The effort that inverse dynamics leaves over at each joint, on the held-out part where it is
/// long enough.
pub(super) fn by_joint(stand: &Stand<'_, ChainRig>) -> Option<ArmReport> {
    let chain = arm(stand.plant).ok()?;
    let held_out = stand.test.clock().duration_s() > ARM_WIDTH_S;
    let (part, run) = match held_out {
        true => ("held_out", stand.test),
        false => ("fitted", stand.train),
    };
    let problem = Problem::new(run, run.all_windows(ARM_WIDTH_S));
    let recorded = problem.windows.average(&run.effort());
    let bare = stand.bare();
    let [before, after] = [&bare, stand.selection].map(|selection| {
        let modelled = modelled(&problem, selection, |_| true);
        let pairs = recorded.iter().zip(&modelled);
        pairs.map(|(r, m)| r - m).collect::<Vec<_>>()
    });
    let outputs = run.outputs();
    let left = |residual: &[f64], output: usize| {
        let rows = residual.iter().skip(output).step_by(outputs);
        rms(&rows.copied().collect::<Vec<_>>())
    };
    let mut joints: Vec<JointReport> = (0..outputs)
        .map(|output| {
            let joint = run.output_name(output);
            let motion = stand.plant.motion_at(joint);
            let mut names = chain.joints.iter().map(|own| own.name.as_str());
            let at = names.position(|name| is_of_joint(joint, name));
            JointReport {
                joint,
                unit: Quantity::Effort.dimension(motion).to_string(),
                before: left(&before, output),
                after: left(&after, output),
                share: 0.0,
                at: 1 + at.unwrap_or(0),
            }
        })
        .collect();
    share(&mut joints);
    let (posture_s, q) = posture(run, chain.joints.len());
    let poses = chain.poses(&q, &[], &[]);
    let end = chain.joints.last().map(|own| match chain.tip.norm() > 0.0 {
        true => chain.tip,
        false => own.inertial.centre(),
    });
    let tip = poses.last().zip(end);
    let tip = tip.map(|(pose, end)| pose.origin + pose.rotation * end);
    let origins = poses.iter().map(|pose| pose.origin).chain(tip);
    Some(ArmReport {
        part,
        joints,
        posture_s,
        line_m: core::iter::once([0.0; 3])
            .chain(origins.map(Into::into))
            .collect(),
    })
}

/// Shares the squares of what is left over, torques and forces by themselves.
fn share(joints: &mut [JointReport]) {
    let squares: Vec<(String, f64)> = joints
        .iter()
        .map(|own| (own.unit.clone(), own.before * own.before))
        .collect();
    for joint in joints {
        let like = squares.iter().filter(|(unit, _)| *unit == joint.unit);
        let all: f64 = like.map(|(_, square)| square).sum();
        joint.share = joint.before * joint.before / all.max(f64::MIN_POSITIVE);
    }
}

/// The positions of the joints halfway through a recording, and the time.
fn posture(run: &ChainRun, joints: usize) -> (f64, Vec<f64>) {
    let middle = run.len() / 2;
    let at = run.motions.iter().take(joints);
    let q = at.map(|motion| motion.get(middle).map_or(0.0, |now| now.position));
    (run.start_s + middle as f64 * run.step_s, q.collect())
}
