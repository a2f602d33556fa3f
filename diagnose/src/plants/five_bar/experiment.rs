//! This file finds the next experiment on a five-bar: the one that best separates the rival
//! explanations of a recording.

pub mod plan;
pub mod play;
mod room;
#[cfg(test)]
mod tests;

use super::free_run::Model;
use super::run::joint_at;
use super::undone::described;
use crate::cause::Cause;
use crate::diagnose::write::Stand;
use crate::evidence::Intervals;
use crate::plant::Run;
use crate::problem::Problem;
use crate::regression::Blocks;
use crate::report::NextExperiment;
use crate::rivals::{Rival, best, contested};
use crate::rules::MOST_EXPLANATIONS;
use crate::selection::Selection;
use plan::{DURATION_S, MIDDLE_M, Plan, plans};
use play::{Sensors, play, with_effects};
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_trace::Trace;
use rigproof_trace::rig::five_bar::FiveBar;
use room::has_room;

/// An explanation that the rig can simulate.
struct Explanation {
    rival: Rival,
    /// The rig with its parameters.
    model: Model,
}

impl Explanation {
    /// The cause about which the rivals disagree.
    fn cause(&self) -> Cause {
        self.rival.own.cause
    }
}

/// The experiment with the best separation, and its plan; `None` with fewer than two explanations.
pub(super) fn next(
    stand: &Stand<'_, FiveBar>,
    rivals: &[Vec<Cause>],
) -> Option<(NextExperiment, Option<Trace>)> {
    let run = stand.train;
    let layout = run.parameters.layout;
    let all = explanations(stand, rivals);
    if all.len() < 2 {
        return None;
    }
    // Explanations that the reference rig cannot simulate are left out.
    let simulated = |e: &Explanation| with_effects(&e.model, layout, MIDDLE_M).is_ok();
    let (mut all, mut left_out): (Vec<_>, Vec<_>) = all.into_iter().partition(simulated);
    left_out.extend(all.split_off(MOST_EXPLANATIONS.min(all.len())));
    let plans = plans(layout, &joints(&all), run.step_s);
    let names: Vec<String> = all.iter().map(|e| stand.problem.name(e.cause())).collect();
    let judged = best(&names, &plans, |truth, plan| {
        losses(stand, all.get(truth)?, &all, plan)
    });
    let (plan, separations) = judged.map_or((None, Vec::new()), |(plan, separations)| {
        (Some(plan), separations)
    });
    let tells = separations.iter().any(|pair| pair.tellable);
    let chosen = plan.filter(|_| tells);
    let report = NextExperiment {
        what: chosen.map(|plan| plan.words.clone()),
        duration_s: DURATION_S,
        greatest_current_a: chosen.map_or(0.0, greatest_current_a),
        greatest_force_n: greatest_desired_force_n(layout),
        tried: plans.len(),
        separations,
        not_compared: left_out
            .iter()
            .map(|e| stand.problem.name(e.cause()))
            .collect(),
        file: None,
    };
    Some((report, chosen.map(|plan| plan.trace(layout))))
}

/// The joints of the explanations, each once.
fn joints(explanations: &[Explanation]) -> Vec<Joint> {
    let own: Vec<Joint> = explanations
        .iter()
        .filter_map(|e| joint_at(e.cause().at))
        .collect();
    let all = Joint::ALL.into_iter();
    all.filter(|joint| own.contains(joint)).collect()
}

fn greatest_current_a(plan: &Plan) -> f64 {
    plan.currents_a
        .iter()
        .flatten()
        .copied()
        .fold(0.0, f64::max)
}

/// The named explanation, and one for each rival of a named effect, each refitted to the recording.
fn explanations(stand: &Stand<'_, FiveBar>, rivals: &[Vec<Cause>]) -> Vec<Explanation> {
    let all = contested(stand.problem, stand.selection, rivals);
    let all = all.into_iter().flat_map(|(index, all)| {
        let own = all.into_iter();
        own.filter_map(move |selection| explanation(stand, &selection, index))
    });
    all.collect()
}

fn explanation(
    stand: &Stand<'_, FiveBar>,
    selection: &Selection,
    index: usize,
) -> Option<Explanation> {
    let with = Stand {
        selection,
        ..*stand
    };
    Some(Explanation {
        rival: Rival::of(selection, index)?,
        model: Model::of(&with.with_numbers(&Intervals::default())),
    })
}

/// The loss of each explanation on a simulated experiment in which `truth` is true, with its
/// parameters refitted. `None` if the rig cannot do the experiment or comes near its stops.
fn losses(
    stand: &Stand<'_, FiveBar>,
    truth: &Explanation,
    explanations: &[Explanation],
    plan: &Plan,
) -> Option<Vec<f64>> {
    let layout = stand.train.parameters.layout;
    let sensors = Sensors {
        count_rad: Some(stand.train.theta_noise * 12f64.sqrt()),
        force_noise_n: Some(stand.train.force_noise),
    };
    let played = play(&truth.model, layout, plan).ok()?;
    if !has_room(&played, layout) {
        return None;
    }
    let run = described(stand.plant, &played.recording(layout, sensors), 0.0).ok()?;
    let windows = run.windows_of(stand.problem.windows.width_s());
    let problem = Problem::new(&run, windows);
    let blocks = Blocks::new(&problem);
    let own = explanations.iter().map(|e| e.rival.loss(&problem, &blocks));
    Some(own.collect())
}
