//! This file finds the next experiment on a five-bar: the one that best separates the rival
//! explanations of a recording.

mod explanation;
pub mod plan;
pub mod play;
mod room;
#[cfg(test)]
mod tests;

use super::free_run::Model;
use super::run::joint_at;
use super::undone::described;
use crate::candidates::{realise, variants};
use crate::cause::Cause;
use crate::diagnose::write::Stand;
use crate::evidence::Intervals;
use crate::plant::Run;
use crate::problem::Problem;
use crate::regression::{Blocks, fit};
use crate::report::{NextExperiment, Separation};
use crate::rules::LEAST_SIGMAS;
use crate::rules::{FINALISTS, MOST_EXPLANATIONS};
use crate::selection::{Found, Selection, best_variant, refined, refs};
use explanation::Explanation;
use plan::{DURATION_S, MIDDLE_M, Plan, plans};
use play::{Sensors, play, with_effects};
use rayon::prelude::*;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_trace::Trace;
use rigproof_trace::rig::five_bar::FiveBar;
use room::has_room;

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
    let (plan, separations) = best(stand, &all, &plans)
        .map_or((None, Vec::new()), |(plan, separations)| {
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

/// The best plan, and the separation of each pair of explanations; `None` with fewer than two.
fn best<'p>(
    stand: &Stand<'_, FiveBar>,
    explanations: &[Explanation],
    plans: &'p [Plan],
) -> Option<(&'p Plan, Vec<Separation>)> {
    let (named, others) = explanations.split_first()?;
    if others.is_empty() {
        return None;
    }
    // Screening assumes that the named explanation is true. The best plans are then judged for
    // every possible truth.
    let screen = |plan: &Plan| -> Vec<f64> {
        let losses = losses(stand, named, explanations, plan).unwrap_or_default();
        let others = 1..losses.len();
        others.map(|other| beyond(&losses, 0, other)).collect()
    };
    let screened: Vec<Vec<f64>> = plans.par_iter().map(screen).collect();
    let mut finalists: Vec<(&Plan, f64)> = plans.iter().zip(least(&screened)).collect();
    finalists.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    finalists.truncate(FINALISTS);
    let apart: Vec<Vec<f64>> = finalists
        .par_iter()
        .map(|(plan, _)| separations(stand, explanations, plan).unwrap_or_default())
        .collect();
    let ranked = finalists.iter().zip(&apart).zip(least(&apart));
    let (((plan, _), sigmas), _) = ranked.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let name = |place: usize| {
        explanations
            .get(place)
            .map_or_else(String::new, |e| stand.problem.name(e.cause()))
    };
    let pairs = pairs(explanations.len()).into_iter().zip(sigmas);
    let separations = pairs.map(|([one, other], sigmas)| Separation {
        one: name(one),
        other: name(other),
        sigmas: *sigmas,
        tellable: *sigmas >= LEAST_SIGMAS,
    });
    Some((plan, separations.collect()))
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

/// The least separation that each experiment reaches. Pairs that no experiment separates are left
/// out, because they decide nothing.
fn least(all: &[Vec<f64>]) -> Vec<f64> {
    let greatest = |pair: usize| {
        let own = all.iter().filter_map(|sigmas| sigmas.get(pair));
        own.copied().fold(0.0, f64::max)
    };
    let least = |sigmas: &Vec<f64>| {
        let told = sigmas.iter().enumerate();
        let told = told.filter(|(pair, _)| greatest(*pair) >= LEAST_SIGMAS);
        let least = told.map(|(_, s)| *s).fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    };
    all.iter().map(least).collect()
}

fn greatest_current_a(plan: &Plan) -> f64 {
    plan.currents_a
        .iter()
        .flatten()
        .copied()
        .fold(0.0, f64::max)
}

/// All pairs of indices.
fn pairs(count: usize) -> Vec<[usize; 2]> {
    let all = (0..count).flat_map(|one| (one + 1..count).map(move |other| [one, other]));
    all.collect()
}

/// The named explanation, and one for each rival of a named effect, each refitted to the recording.
///
/// If several effects have rivals, the first of them is chosen: it explains most.
fn explanations(stand: &Stand<'_, FiveBar>, rivals: &[Vec<Cause>]) -> Vec<Explanation> {
    let contested = rivals.iter().enumerate().find(|(_, own)| !own.is_empty());
    let Some((index, rivals)) = contested else {
        return Vec::new();
    };
    let in_its_place = |cause: &Cause| replaced(stand.problem, stand.selection, index, *cause);
    let mut others: Vec<Selection> = rivals.iter().filter_map(in_its_place).collect();
    others.sort_by(|a, b| a.after.loss.total_cmp(&b.after.loss));
    let all = core::iter::once(stand.selection).chain(&others);
    all.filter_map(|selection| explanation(stand, selection, index))
        .collect()
}

fn explanation(
    stand: &Stand<'_, FiveBar>,
    selection: &Selection,
    index: usize,
) -> Option<Explanation> {
    let own = selection.found.get(index)?;
    let others = selection.found.iter().enumerate();
    let others = others.filter(|(k, _)| *k != index).map(|(_, f)| &f.term);
    let nothing = Intervals::default();
    let with = Stand {
        selection,
        ..*stand
    };
    let model = Model::of(&with.with_numbers(&nothing));
    let others = selection.nominal.iter().chain(others);
    Some(Explanation::new(&own.term, others, model))
}

/// The selection with a found cause replaced by another.
fn replaced(
    problem: &Problem,
    selection: &Selection,
    index: usize,
    cause: Cause,
) -> Option<Selection> {
    let blocks = Blocks::new(problem);
    let mut others = selection.found.clone();
    let old = others.remove(index);
    let common = refs(&selection.nominal, &others);
    let bare = fit(problem, &common, &blocks);
    let tried = variants(problem, cause, &common, &bare).into_iter();
    let tried = tried.filter_map(|term| match old.term.onset_s {
        None => Some(term),
        onset_s => realise(problem, cause, &term.shape, onset_s, &[]),
    });
    let tried: Vec<_> = tried.collect();
    let (mut term, _) = best_variant(problem, &common, &tried)?;
    if !term.shape.is_empty() {
        term = refined(problem, &common, term, &blocks);
    }
    let mut found = selection.found.clone();
    if let Some(slot) = found.get_mut(index) {
        *slot = Found { term, ..old };
    }
    let after = fit(problem, &refs(&selection.nominal, &found), &blocks);
    Some(Selection {
        found,
        after,
        ..selection.clone()
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
    let fitted = &stand.problem.windows;
    let width_s = (fitted.bump.len() - 1) as f64 * fitted.step_s;
    let played = play(&truth.model, layout, plan).ok()?;
    if !has_room(&played, layout) {
        return None;
    }
    let run = described(stand.plant, &played.recording(layout, sensors), 0.0).ok()?;
    let windows = run.windows_of(width_s);
    let problem = Problem::new(&run, windows);
    let blocks = Blocks::new(&problem);
    let own = explanations.iter().map(|e| e.loss(&problem, &blocks));
    Some(own.collect())
}

/// The separation of an explanation from the true one, in standard deviations of the noise.
fn beyond(losses: &[f64], truth: usize, other: usize) -> f64 {
    let at = |place: usize| losses.get(place).copied().unwrap_or(0.0);
    (at(other) - at(truth)).max(0.0).sqrt()
}

/// The separation of each pair of explanations by an experiment, in standard deviations of the
/// noise: the lesser of the two, as either may be true.
fn separations(
    stand: &Stand<'_, FiveBar>,
    explanations: &[Explanation],
    plan: &Plan,
) -> Option<Vec<f64>> {
    let all = explanations
        .par_iter()
        .map(|truth| losses(stand, truth, explanations, plan));
    let all: Vec<Vec<f64>> = all.collect::<Option<_>>()?;
    let way = |truth: usize, other: usize| {
        let losses = all.get(truth);
        losses.map_or(0.0, |losses| beyond(losses, truth, other))
    };
    let apart = |[one, other]: [usize; 2]| way(one, other).min(way(other, one));
    Some(pairs(explanations.len()).into_iter().map(apart).collect())
}
