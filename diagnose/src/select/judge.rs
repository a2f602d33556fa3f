//! This file judges candidates: each against the gates, and against one another.

use super::prune::would_stay;
use super::refine::refined;
use super::weigh::{
    contribution, drives, effort_beside, excitation, is_noise, loss_with, own_coefficients,
};
use super::{Found, Gates, TIE_Z};
use crate::candidates::is_at_edge;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit, nested_block_losses, paired};
use crate::rules::PROMISING_SHARE;
pub(super) use crate::rules::SIMPLER_SHARE;
use rayon::prelude::*;
use rigproof_model::effects::entry;

/// A candidate that passed the gates.
pub(super) struct Trial {
    /// The mechanism with the evidence for it.
    pub(super) found: Found,
    /// Left-out loss of each block with it.
    pub(super) losses: Vec<f64>,
    /// Whether it would stay if nothing else were found.
    stays: bool,
    /// How many numbers it has.
    parameters: usize,
}

/// Judges one mechanism a list of variants: those that pass the gates, and the best variant of every list.
pub(super) fn trials(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    lists: Vec<Vec<Term>>,
    blocks: &Blocks,
    gates: Gates,
) -> (Vec<Trial>, Vec<Term>) {
    let candidates: Vec<(Vec<Term>, Term, f64)> = lists
        .into_par_iter()
        .map(|list| linearised(problem, common, list, blocks))
        .filter_map(|list| {
            let (term, loss) = best(problem, common, &list)?;
            Some((list, term, loss))
        })
        .collect();
    let least = candidates.iter().map(|c| c.2).fold(current.loss, f64::min);
    let bests = candidates.iter().map(|c| c.1.clone()).collect();
    let trials = candidates
        .into_par_iter()
        .filter(|(_, _, loss)| current.loss - loss >= PROMISING_SHARE * (current.loss - least))
        .filter_map(|(mut list, mut term, _)| {
            if list.len() > 1 {
                term = refined(problem, common, term, blocks);
                list.push(term.clone());
            }
            judge(problem, common, current, &list, term, blocks, gates)
        })
        .collect();
    (trials, bests)
}

/// Changes of the drive, linearised about what the other terms give beside them.
fn linearised(problem: &Problem, common: &[&Term], list: Vec<Term>, blocks: &Blocks) -> Vec<Term> {
    list.into_iter()
        .map(|t| {
            let effort = effort_beside(problem, common, &t, blocks);
            effort
                .and_then(|e| problem.drive_term(t.cause, &t.shape, t.onset_s, &e))
                .unwrap_or(t)
        })
        .collect()
}

/// A mechanism with its variants against the gates.
pub(super) fn judge(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    tried: &[Term],
    term: Term,
    blocks: &Blocks,
    gates: Gates,
) -> Option<Trial> {
    let losses = nested_block_losses(problem, common, tried, blocks);
    let mut terms = common.to_vec();
    terms.push(&term);
    let fitted = fit(problem, &terms, blocks);
    let own = own_coefficients(&term, &fitted);
    let expected = excitation(&term, own, blocks);
    let (gain, z) = paired(&current.block_loss, &losses, &expected);
    let share = 1.0 - losses.iter().sum::<f64>() / current.left_out().max(1e-300);
    let at_floor = is_noise(problem, &fitted);
    let stays =
        !problem.rules.by_form || would_stay(problem, term.cause, current.left_out(), &fitted);
    let passes = gain > 0.0
        && z >= gates.z
        && share >= gates.share
        && is_relevant(
            problem,
            current,
            contribution(problem, &term, own),
            at_floor,
            gates,
        )
        && !drives(&term, own)
        && !is_at_edge(problem, &term);
    let linear = entry(term.cause.mechanism)?.linear;
    passes.then(|| Trial {
        parameters: linear.max(term.free.len())
            + term.shape.len()
            + usize::from(term.onset_s.is_some()),
        found: Found {
            at_floor,
            term,
            z,
            share,
            probability: 1.0,
        },
        stays,
        losses,
    })
}

/// Whether a contribution is large enough to be asked for. Also one that takes away all that is more than noise is, however small.
fn is_relevant(
    problem: &Problem,
    current: &Fit,
    contribution: f64,
    at_floor: bool,
    gates: Gates,
) -> bool {
    let decides = problem.rules.by_floor && at_floor && !is_noise(problem, current);
    decides || contribution >= gates.relevance * problem.effort_size
}

/// The variant with the least loss over all blocks, and that loss.
pub(crate) fn best(problem: &Problem, common: &[&Term], tried: &[Term]) -> Option<(Term, f64)> {
    tried
        .iter()
        .map(|term| (term, loss_with(problem, common, term)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(term, loss)| (term.clone(), loss))
}

/// Where any leaves nothing but noise, only those that do: they are not passed over for one that leaves more, whatever the blocks make of their
/// onsets.
pub(super) fn those_that_leave_noise(trials: &mut Vec<Trial>) {
    if trials.iter().any(|own| own.found.at_floor) {
        trials.retain(|own| own.found.at_floor);
    }
}

/// The trial with the fewest parameters among those that tie with the best one, or that explain nearly as much
/// where even the best one leaves more than noise. One that would go again is no tie of one that would stay.
pub(super) fn simplest(mut trials: Vec<Trial>, loss_without: f64) -> Option<Found> {
    let total = |trial: &Trial| trial.losses.iter().sum::<f64>();
    trials.sort_by(|a, b| total(a).total_cmp(&total(b)));
    let leader = trials.first()?.losses.clone();
    let at_floor = trials.first()?.found.at_floor;
    let stays = trials.first()?.stays;
    let most = loss_without - leader.iter().sum::<f64>();
    let all = vec![1.0; leader.len()];
    trials
        .into_iter()
        .enumerate()
        .filter(|(rank, t)| {
            let nearly = !at_floor && loss_without - total(t) >= SIMPLER_SHARE * most;
            let ties = nearly || paired(&t.losses, &leader, &all).1 < TIE_Z;
            *rank == 0 || ties && (t.stays || !stays)
        })
        .min_by_key(|(rank, t)| (t.parameters, *rank))
        .map(|(_, t)| t.found)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::cause::Cause;
    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::short_run;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn one_that_leaves_only_noise_is_not_passed_over_for_a_lesser_loss() {
        let run = short_run();
        let problem = five_bar::recorded::problem(&run);
        let trial = |mechanism, loss: f64, at_floor| Trial {
            found: Found {
                term: problem.term(Cause::of(mechanism), &[], None).unwrap(),
                z: 5.0,
                share: 0.9,
                at_floor,
                probability: 1.0,
            },
            losses: vec![loss; 8],
            stays: true,
            parameters: 2,
        };
        let named = |at_floor| {
            let mut trials = vec![
                trial(Mechanism::ForceBias, 1.0, false),
                trial(Mechanism::Gravity, 1.3, at_floor),
            ];
            those_that_leave_noise(&mut trials);
            simplest(trials, 1000.0).map(|found| found.term.cause.mechanism)
        };
        assert_eq!(named(true), Some(Mechanism::Gravity));
        assert_eq!(named(false), Some(Mechanism::ForceBias));
    }
}
