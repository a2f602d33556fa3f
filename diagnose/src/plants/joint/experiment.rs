//! This file finds the next experiment on one joint: the recorded motion again, slower, faster,
//! narrower or with rests, so that the rival explanations of a recording differ.

mod plan;
#[cfg(test)]
mod tests;

use super::run::JointRun;
use crate::cause::Cause;
use crate::diagnose::write::Stand;
use crate::evidence::coefficients_by_term;
use crate::plant::Run;
use crate::problem::{Problem, add};
use crate::regression::Blocks;
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
    /// The coefficients of the nuisance parameters.
    nuisances: Vec<f64>,
    /// All its terms, with their coefficients.
    parts: Vec<(Part, Vec<f64>)>,
}

/// The experiment with the best separation, and its plan; `None` with fewer than two explanations,
/// and on a joint whose effort depends on more than its motion and a brake's current.
pub(super) fn next(
    stand: &Stand<'_, Rig>,
    rivals: &[Vec<Cause>],
) -> Option<(NextExperiment, Option<Trace>)> {
    let run = stand.train;
    if !run.parts.is_empty() || run.servo.is_some() || run.load().is_some() {
        return None;
    }
    let (index, all) = contested(stand.problem, stand.selection, rivals)?;
    let all = all.iter();
    let all = all.filter_map(|own| Explanation::of(stand.problem, own, index));
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
    fn of(problem: &Problem, selection: &Selection, index: usize) -> Option<Explanation> {
        let (nuisances, by_term) = coefficients_by_term(problem, selection);
        Some(Explanation {
            rival: Rival::of(selection, index)?,
            nuisances,
            parts: parts(selection).into_iter().zip(by_term).collect(),
        })
    }

    /// Whether all its terms are efforts along the motion: no change of a drive or of a sensor.
    fn is_along_motion(&self, problem: &Problem) -> bool {
        self.parts.iter().all(|(part, _)| {
            let form = form(part.cause.mechanism);
            !matches!(form, Some(Form::Drive(_) | Form::Sensor(_)))
                && !problem.run.moves(part.cause)
        })
    }

    /// The effort that it predicts along the motion of a problem.
    fn effort(&self, problem: &Problem) -> Option<Vec<f64>> {
        let mut effort = problem.known.clone();
        for (column, times) in problem.nuisances.iter().zip(&self.nuisances) {
            add(&mut effort, &column.signal, *times);
        }
        for (part, coefficients) in &self.parts {
            let term = part.on(problem)?;
            let given = term.known.as_ref().unwrap_or(coefficients);
            for (rows, times) in term.free.iter().zip(given) {
                add(&mut effort, &rows.signal, *times);
            }
            if let Some(fixed) = &term.fixed {
                add(&mut effort, &fixed.signal, 1.0);
            }
        }
        Some(effort)
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
    let fitted = &stand.problem.windows;
    let width_s = (fitted.bump.len() - 1) as f64 * fitted.step_s;
    let bare = Problem::new(&plan.run, plan.run.windows_of(width_s));
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
