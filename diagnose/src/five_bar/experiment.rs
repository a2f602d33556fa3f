//! This file says which experiment on a five-bar would tell the explanations of a recording apart.

mod explanation;
pub mod plan;
pub mod play;
#[cfg(test)]
mod tests;

use super::diagnose::Stand;
use super::free_run::Model;
use super::from_rig::aligned;
use crate::candidates::{realise, variants};
use crate::evidence::Errors;
use crate::problem::{Cause, Problem};
use crate::regression::{Blocks, fit};
use crate::report::{NextExperiment, Separation};
use crate::select::{Found, Selection, best_variant, refined, refs};
use crate::weak::Windows;
use explanation::Explanation;
use plan::{DURATION_S, Plan, plans};
use play::{Sensors, play};
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_trace::Trace;

/// The most explanations that are held against one another.
const MOST_EXPLANATIONS: usize = 5;
/// From how many standard deviations of the sensors' noise on two explanations count as told apart.
const LEAST_SIGMAS: f64 = 10.0;

/// The experiment that tells the explanations apart best, and the plan; `None` where there is one explanation only.
pub(super) fn next(
    stand: &Stand<'_>,
    rivals: &[Vec<Cause>],
) -> Option<(NextExperiment, Option<Trace>)> {
    let explanations = explanations(stand, rivals);
    if explanations.len() < 2 {
        return None;
    }
    let run = stand.train;
    let layout = run.parameters.layout;
    let mut joints: Vec<_> = explanations
        .iter()
        .filter_map(|e| e.cause().joint)
        .collect();
    joints.sort_by_key(|joint| *joint as usize);
    joints.dedup();
    let plans = plans(layout, &joints, run.step_s);
    let told: Vec<Option<Vec<f64>>> = plans
        .iter()
        .map(|plan| separations(stand, &explanations, plan))
        .collect();
    let pairs = pairs(explanations.len());
    // What no experiment tells apart decides nothing.
    let best_of = |pair: usize| {
        let own = told.iter().flatten().filter_map(|sigmas| sigmas.get(pair));
        own.copied().fold(0.0, f64::max)
    };
    let tellable: Vec<bool> = (0..pairs.len())
        .map(|pair| best_of(pair) >= LEAST_SIGMAS)
        .collect();
    let least = |sigmas: &[f64]| {
        let own = sigmas.iter().zip(&tellable).filter(|(_, t)| **t);
        own.map(|(s, _)| *s).fold(f64::INFINITY, f64::min)
    };
    let ranked = plans.iter().zip(&told);
    let ranked = ranked.filter_map(|(plan, sigmas)| Some((plan, sigmas.as_ref()?)));
    let best = ranked.max_by(|(_, one), (_, other)| least(one).total_cmp(&least(other)));
    let name = |place: usize| {
        explanations
            .get(place)
            .map_or_else(String::new, |e| e.cause().name())
    };
    let separations = pairs
        .iter()
        .enumerate()
        .map(|(pair, [one, other])| Separation {
            one: name(*one),
            other: name(*other),
            sigmas: best
                .and_then(|(_, sigmas)| sigmas.get(pair).copied())
                .unwrap_or(0.0),
            tellable: tellable.get(pair) == Some(&true),
        });
    let chosen = best
        .filter(|_| tellable.contains(&true))
        .map(|(plan, _)| plan);
    let report = NextExperiment {
        what: chosen.map(|plan| plan.words.clone()),
        duration_s: DURATION_S,
        greatest_current_a: chosen.map_or(0.0, greatest_current_a),
        greatest_force_n: greatest_desired_force_n(layout),
        tried: told.iter().flatten().count(),
        separations: separations.collect(),
        file: None,
    };
    Some((report, chosen.map(|plan| plan.trace(layout))))
}

fn greatest_current_a(plan: &Plan) -> f64 {
    plan.currents_a
        .iter()
        .flatten()
        .copied()
        .fold(0.0, f64::max)
}

/// Pairs of places, each once.
fn pairs(count: usize) -> Vec<[usize; 2]> {
    let all = (0..count).flat_map(|one| (one + 1..count).map(move |other| [one, other]));
    all.collect()
}

/// What was named, and each rival of one effect in its place, with the numbers that fit the recording best. Where several effects have
/// rivals it is the first of them: what was named first explains most.
fn explanations(stand: &Stand<'_>, rivals: &[Vec<Cause>]) -> Vec<Explanation> {
    let contested = rivals.iter().enumerate().find(|(_, r)| !r.is_empty());
    let Some((index, rivals)) = contested else {
        return Vec::new();
    };
    let in_its_place = |cause: &Cause| replaced(stand.problem, stand.selection, index, *cause);
    let mut others: Vec<Selection> = rivals.iter().filter_map(in_its_place).collect();
    others.sort_by(|a, b| a.after.loss.total_cmp(&b.after.loss));
    let all = core::iter::once(stand.selection).chain(&others);
    all.take(MOST_EXPLANATIONS)
        .filter_map(|selection| explanation(stand, selection, index))
        .collect()
}

fn explanation(stand: &Stand<'_>, selection: &Selection, index: usize) -> Option<Explanation> {
    let own = selection.found.get(index)?;
    let others = selection.found.iter().enumerate();
    let others = others.filter(|(k, _)| *k != index).map(|(_, f)| &f.term);
    let nothing = Errors {
        inertia: None,
        terms: Vec::new(),
    };
    let with = Stand {
        selection,
        ..*stand
    };
    let model = Model::of(&with.calibrated(&nothing));
    let others = selection.nominal.iter().chain(others);
    Some(Explanation::new(&own.term, others, model))
}

/// The selection with another cause in the place of a found one.
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

/// How far each pair of explanations lies apart on an experiment, in standard deviations of the sensors' noise: what one explanation's recording leaves
/// unexplained with the other, whose numbers may be others there, beyond what it leaves with itself; the lesser of both ways.
/// `None` where the rig cannot do the experiment.
fn separations(stand: &Stand<'_>, explanations: &[Explanation], plan: &Plan) -> Option<Vec<f64>> {
    let layout = stand.train.parameters.layout;
    let sensors = Sensors {
        count_rad: Some(stand.train.theta_noise * 12f64.sqrt()),
        force_noise_n: Some(stand.train.force_noise),
    };
    let fitted = &stand.problem.windows;
    let width_s = (fitted.bump.len() - 1) as f64 * fitted.step_s;
    let losses = explanations.iter().map(|truth| {
        let played = play(&truth.model, layout, plan).ok()?;
        let run = aligned(stand.rig, &played.recording(layout, sensors)).ok()?;
        let windows = Windows::over(run.len(), 2, (run.step_s, run.start_s), width_s);
        let problem = Problem::of_five_bar(&run, windows);
        let blocks = Blocks::new(&problem);
        let losses = explanations.iter().map(|e| e.loss(&problem, &blocks));
        Some(losses.collect())
    });
    let losses: Vec<Vec<f64>> = losses.collect::<Option<_>>()?;
    let beyond = |truth: usize, other: usize| {
        let own = losses.get(truth);
        let at = |place| own.and_then(|own| own.get(place)).copied().unwrap_or(0.0);
        (at(other) - at(truth)).max(0.0).sqrt()
    };
    let apart = |[one, other]: [usize; 2]| beyond(one, other).min(beyond(other, one));
    Some(pairs(explanations.len()).into_iter().map(apart).collect())
}
