//! This file compares an arm's two models joint by joint.

use super::align::arm;
use super::run::ChainRun;
use crate::diagnose::balance::modelled;
use crate::diagnose::write::Stand;
use crate::filter::rms;
use crate::plant::Run;
use crate::problem::Problem;
use crate::report::{ArmReport, JointReport};
use crate::rules::ARM_WIDTH_S;
use rigproof_spec::effect::Motion;
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
            let slides = stand.plant.motion_at(joint) == Motion::Linear;
            let at = chain.joints.iter().position(|own| {
                let rest = joint.strip_prefix(own.name.as_str());
                rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            });
            JointReport {
                joint,
                unit: if slides { "N" } else { "N·m" },
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
    for unit in ["N", "N·m"] {
        let own = |joint: &&JointReport| joint.unit == unit;
        let squares = joints
            .iter()
            .filter(own)
            .map(|joint| joint.before * joint.before);
        let all = squares.sum::<f64>().max(f64::MIN_POSITIVE);
        let own = joints.iter_mut().filter(|joint| joint.unit == unit);
        own.for_each(|joint| joint.share = joint.before * joint.before / all);
    }
}

/// The positions of the joints halfway through a recording, and the time.
fn posture(run: &ChainRun, joints: usize) -> (f64, Vec<f64>) {
    let middle = run.len() / 2;
    let at = run.motions.iter().take(joints);
    let q = at.map(|motion| motion.get(middle).map_or(0.0, |now| now.position));
    (run.start_s + middle as f64 * run.step_s, q.collect())
}
