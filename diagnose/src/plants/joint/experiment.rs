//! This file finds the next experiment on one joint: the recorded motion again, slower, faster,
//! narrower or with rests, so that the rival explanations of a recording differ.

mod plan;
#[cfg(test)]
mod tests;

use super::run::JointRun;
use crate::candidates::modelled_effort;
use crate::cause::Cause;
use crate::diagnose::write::Stand;
use crate::plant::Run;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit};
use crate::report::NextExperiment;
use crate::rivals::{Part, Rival, best, contested, parts};
use crate::rules::{FEWEST_WINDOWS, MOST_EXPLANATIONS};
use crate::selection::{Selection, usable_rms};
use plan::{Plan, plans};
use rigproof_model::effects::{Form, form};
use rigproof_trace::Trace;
use rigproof_trace::rig::Rig;

/// An explanation whose effort along another motion is known.
struct Explanation {
    rival: Rival,
    /// All its terms.
    parts: Vec<Part>,
    /// Their fit to the recording.
    fitted: Fit,
}

/// The experiment with the best separation, and its plan; `None` with fewer than two explanations,
/// and on a joint whose effort depends on more than its motion and a brake's current.
pub(super) fn next(
    stand: &Stand<'_, Rig>,
    rivals: &[Vec<Cause>],
) -> Option<(NextExperiment, Option<Trace>)> {
    let run = stand.train;
    if run.is_sweep() || !run.parts.is_empty() || run.servo.is_some() || run.load().is_some() {
        return None;
    }
    let (index, all) = contested(stand.problem, stand.selection, rivals)?;
    let all = all.iter();
    let all = all.filter_map(|own| Explanation::of(own, index));
    let along_motion = |own: &Explanation| own.is_along_motion(stand.problem);
    let (mut all, mut left_out): (Vec<_>, Vec<_>) = all.partition(along_motion);
    left_out.extend(all.split_off(MOST_EXPLANATIONS.min(all.len())));
    let name = |own: &Explanation| stand.problem.name(own.rival.own.cause);
    let names: Vec<String> = all.iter().map(name).collect();
    let plans = plans(run);
    let (plan, separations) = best(&names, &plans, |truth, plan| {
        losses(stand, &all, truth, plan)
    })?;
    let tells = separations.iter().any(|pair| pair.tellable);
    let chosen = Some(plan).filter(|_| tells);
    let report = NextExperiment {
        what: chosen.map(|plan| plan.words.clone()),
        duration_s: plan.run.clock().duration_s(),
        greatest_current_a: chosen.and_then(|plan| plan.current_a).unwrap_or(0.0),
        greatest_force_n: 0.0,
        tried: plans.len(),
        separations,
        not_compared: left_out.iter().map(name).collect(),
        file: None,
    };
    Some((report, chosen.map(|plan| plan.trace(stand.plant))))
}

impl Explanation {
    fn of(selection: &Selection, index: usize) -> Option<Explanation> {
        Some(Explanation {
            rival: Rival::of(selection, index)?,
            parts: parts(selection),
            fitted: selection.after.clone(),
        })
    }

    /// Whether all its terms are efforts along the motion: no change of a drive or of a sensor.
    fn is_along_motion(&self, problem: &Problem) -> bool {
        self.parts.iter().all(|part| {
            let form = form(part.cause.mechanism);
            !matches!(form, Some(Form::Drive(_) | Form::Sensor(_)))
                && !problem.run.moves(part.cause)
        })
    }

    /// The effort that it predicts along the motion of a problem.
    fn effort(&self, problem: &Problem) -> Option<Vec<f64>> {
        let terms = self.parts.iter().map(|part| part.on(problem));
        let terms: Vec<Term> = terms.collect::<Option<_>>()?;
        let terms: Vec<&Term> = terms.iter().collect();
        Some(modelled_effort(problem, &terms, &self.fitted))
    }
}

/// The loss of each explanation along a plan if `truth` is true, with their parameters refitted.
/// What stays unexplained of the recording counts as noise. `None` if the plan asks for more effort
/// than was recorded, or shows too little.
fn losses(
    stand: &Stand<'_, Rig>,
    all: &[Explanation],
    truth: usize,
    plan: &Plan,
) -> Option<Vec<f64>> {
    let width_s = stand.problem.windows.width_s();
    let bare = Problem::new(&plan.run, plan.run.all_windows(width_s));
    let effort = all.get(truth)?.effort(&bare)?;
    let greatest = |effort: &[f64]| effort.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if greatest(&effort) > greatest(&stand.train.effort) {
        return None;
    }
    let run = JointRun {
        effort,
        ..plan.run.clone()
    };
    let windows = run.windows_of(width_s);
    if windows.usable.iter().filter(|usable| **usable).count() < FEWEST_WINDOWS {
        return None;
    }
    let mut problem = Problem::new(&run, windows);
    problem.rewhiten(usable_rms(stand.problem, &stand.selection.after.residual));
    let blocks = Blocks::new(&problem);
    let losses = all.iter().map(|own| own.rival.loss(&problem, &blocks));
    Some(losses.collect())
}
