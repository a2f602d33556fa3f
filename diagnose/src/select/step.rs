//! This file takes one step of the search: a mechanism more, or one in the place of another.

use super::judge::{SIMPLER_SHARE, Trial, simplest, those_that_leave_noise, trials};
use super::merge::takes_both;
use super::together::{beside, is_elementary, masking, of_one_family};
use super::weigh::is_noise;
use super::{Found, Gates, TIE_Z, refs};
use crate::candidates::{all_variants, causes, modelled_effort, realise};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit, paired};
use crate::rules::{EARLY_SHARE, ELEMENTARY_SHARE, MORE_Z, ONSET_GRID};
use rayon::prelude::*;

/// The next mechanism: an elementary one, any other, or one that begins during the recording, in this order as
/// long as it explains enough of what the best of them does. Two or three where no one alone leaves nothing but noise and they do; none where nothing passes.
pub(super) fn forward(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    blocks: &Blocks,
    gates: Gates,
) -> Vec<Found> {
    let common = refs(nominal, found);
    let current = fit(problem, &common, blocks);
    let gates = beyond_noise(problem, &current, found, gates);
    let lists = all_variants(problem, open(problem, nominal, found), &common, &current);
    let (mut early, bests) = trials(problem, &common, &current, lists, blocks, gates);
    early.extend(beside(problem, nominal, found, &current, blocks, gates));
    let effort = modelled_effort(problem, &common, &current);
    let onsets = |terms: &[Term]| -> Vec<Vec<Term>> {
        let each = terms.par_iter();
        each.map(|t| with_onsets(problem, t, &effort)).collect()
    };
    let (mut late, _) = trials(problem, &common, &current, onsets(&bests), blocks, gates);
    let enough = late.iter().filter(|t| t.found.at_floor);
    let enough: Vec<Cause> = enough.map(|t| t.found.term.cause).collect();
    let wanting = bests.iter().filter(|t| !enough.contains(&t.cause));
    let unequal: Vec<Term> = wanting
        .filter_map(|t| with_unequal_limits(problem, t, &effort))
        .collect();
    late.extend(trials(problem, &common, &current, onsets(&unequal), blocks, gates).0);
    if is_noise(problem, &current) {
        for trials in [&mut early, &mut late] {
            trials.retain(|own| !of_one_family(problem, own.found.term.cause, found));
        }
    } else if problem.rules.by_floor {
        those_that_leave_noise(&mut early);
        those_that_leave_noise(&mut late);
    }
    let (elementary, others): (Vec<Trial>, Vec<Trial>) = early
        .into_iter()
        .partition(|t| is_elementary(t.found.term.cause.mechanism));
    let without = current.left_out();
    let ranked = [
        (simplest(elementary, without), ELEMENTARY_SHARE),
        (simplest(others, without), EARLY_SHARE),
        (simplest(late, without), 1.0),
    ];
    let shares = ranked.iter().flat_map(|(found, _)| found).map(|f| f.share);
    let most = shares.fold(0.0, f64::max);
    // One that leaves nothing but noise is not passed over for one that leaves more.
    let floor_reached = ranked
        .iter()
        .flat_map(|(found, _)| found)
        .any(|f| f.at_floor);
    if !floor_reached && let Some(all) = masking(problem, &common, blocks, gates) {
        return all;
    }
    let mut enough = ranked
        .into_iter()
        .filter_map(|(found, least)| found.filter(|f| f.share >= least * most))
        .filter(|f| f.at_floor || !floor_reached);
    enough.next().into_iter().collect()
}

/// The gates, higher where nothing but noise is left of what was found.
fn beyond_noise(problem: &Problem, current: &Fit, found: &[Found], gates: Gates) -> Gates {
    let is_more = problem.rules.by_floor && !found.is_empty();
    match is_more && is_noise(problem, current) {
        true => Gates {
            z: gates.z.max(MORE_Z),
            ..gates
        },
        false => gates,
    }
}

/// Replaces a found mechanism where another one explains clearly more in its place.
pub(super) fn swap(
    problem: &Problem,
    nominal: &[Term],
    found: &mut [Found],
    blocks: &Blocks,
    gates: Gates,
) {
    for index in 0..found.len() {
        let others: Vec<Found> = found
            .iter()
            .enumerate()
            .filter(|(k, _)| *k != index)
            .map(|(_, f)| f.clone())
            .collect();
        let common = refs(nominal, &others);
        let without = fit(problem, &common, blocks);
        let current = fit(problem, &refs(nominal, found), blocks);
        let lists = all_variants(problem, open(problem, nominal, found), &common, &without);
        let (passed, _) = trials(problem, &common, &without, lists, blocks, gates);
        let better: Vec<Trial> = passed
            .into_iter()
            .filter(|t| {
                let all = vec![1.0; t.losses.len()];
                let gained = without.left_out() - t.losses.iter().sum::<f64>();
                let had = without.left_out() - current.left_out();
                (t.found.at_floor || had < SIMPLER_SHARE * gained)
                    && paired(&current.block_loss, &t.losses, &all).1 >= TIE_Z
            })
            .collect();
        if let (Some(better), Some(slot)) =
            (simplest(better, without.left_out()), found.get_mut(index))
        {
            *slot = better;
        }
    }
}

/// Causes that are neither nominal nor found.
pub(super) fn open(problem: &Problem, nominal: &[Term], found: &[Found]) -> Vec<Cause> {
    let taken: Vec<Cause> = refs(nominal, found).iter().map(|t| t.cause).collect();
    causes(problem)
        .into_iter()
        .filter(|cause| !taken.contains(cause))
        .collect()
}

/// For a bristle the one whose limits differ. From the start it is found as a bristle beside a constant; of two that begin later
/// neither may pass alone, or the one that does leaves what a wrong name then takes.
fn with_unequal_limits(problem: &Problem, term: &Term, effort: &[f64]) -> Option<Term> {
    if !problem.rules.by_family {
        return None;
    }
    let (mechanism, _) = takes_both(term.cause.mechanism)?;
    let cause = Cause {
        mechanism,
        ..term.cause
    };
    realise(problem, cause, &term.shape, None, effort)
}

/// A term that begins at twelfths of the recording, ends left out.
pub(super) fn with_onsets(problem: &Problem, term: &Term, effort: &[f64]) -> Vec<Term> {
    let clock = problem.run.clock();
    (2..=ONSET_GRID - 2)
        .map(|k| clock.start_s + clock.duration_s() * k as f64 / ONSET_GRID as f64)
        .filter_map(|t| {
            let mut late = realise(problem, term.cause, &term.shape, Some(t), effort)?;
            problem.lighten(&mut late);
            Some(late)
        })
        .collect()
}
