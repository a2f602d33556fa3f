//! This file bounds the probabilities of names by what the data leave open.

use crate::candidates::is_periodic;
use crate::cause::Cause;
use crate::evidence::{Intervals, coefficients_by_term};
use crate::problem::{Problem, Term};
use crate::rules::{PERIOD_KNOWN, SUSPECTED};
use crate::selection::{Selection, is_noise};
use rigproof_model::effects::facts;

/// Bounds the probabilities of what is named.
///
/// If the residual is more than noise, a mechanism that explains little beside the rest may be a part
/// of the unexplained physics. Its probability is at most one half plus the share of the loss that it
/// removes. A mechanism beside others whose numbers may all be those of nothing is at most suspected:
/// the others, with other numbers, do without it.
pub(super) fn bound(problem: &Problem, selection: &mut Selection, intervals: &Intervals) {
    let is_noise = is_noise(problem, &selection.after);
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let numbers = coefficients.iter().zip(&intervals.terms);
    let numbers = numbers.skip(selection.nominal.len());
    // Of a plant of many places delays are measured without an interval.
    let beside = selection.found.len() > 1 && !problem.rules.many;
    for (found, (values, halves)) in selection.found.iter_mut().zip(numbers) {
        if beside && may_be_nothing(&found.term, values, halves) {
            found.probability = found.probability.min(SUSPECTED);
        }
        if !is_noise {
            found.probability = found.probability.min(SUSPECTED + found.share.max(0.0));
        }
    }
}

/// Whether every coefficient may be 0 by its interval; of a law without one whether its first number may
/// be the one at which it does nothing.
fn may_be_nothing(term: &Term, values: &[f64], halves: &[f64]) -> bool {
    let nothing = facts(term.cause.mechanism).and_then(|facts| facts.nothing);
    match (values, nothing, term.shape.first(), halves.first()) {
        ([], Some(nothing), Some(own), Some(half)) => (own - nothing).abs() < *half,
        ([], ..) => false,
        _ => values
            .iter()
            .zip(halves)
            .all(|(value, half)| *value == 0.0 || value.abs() < *half),
    }
}

/// The periodic laws that were found without a known period: no periods were seen.
pub(super) fn vague(selection: &Selection, intervals: &Intervals) -> Vec<Cause> {
    let halves = intervals.terms.iter().skip(selection.nominal.len());
    let found = selection.found.iter().zip(halves);
    let vague = found.filter(|(found, halves)| is_vague(&found.term, halves));
    vague.map(|(found, _)| found.term.cause).collect()
}

fn is_vague(term: &Term, halves: &[f64]) -> bool {
    let own = term.numbers().first().zip(halves.last());
    is_periodic(term.cause) && own.is_some_and(|(period, half)| *half > PERIOD_KNOWN * period)
}
