//! This file bounds the probabilities of names by what the data leave open.

use crate::evidence::{Intervals, coefficients_by_term};
use crate::problem::Problem;
use crate::rules::SUSPECTED;
use crate::selection::{Selection, is_noise};

/// Bounds the probabilities of what is named.
///
/// If the residual is more than noise, a mechanism that explains little beside the rest may be a part
/// of the unexplained physics. Its probability is at most one half plus the share of the loss that it
/// removes. A mechanism beside others whose numbers may all be 0 is at most suspected: the others,
/// with other numbers, do without it.
pub(super) fn bound(problem: &Problem, selection: &mut Selection, intervals: &Intervals) {
    let may_be_nothing = may_be_nothing(problem, selection, intervals);
    let is_noise = is_noise(problem, &selection.after);
    for (found, is_nothing) in selection.found.iter_mut().zip(may_be_nothing) {
        if is_nothing {
            found.probability = found.probability.min(SUSPECTED);
        }
        if !is_noise {
            found.probability = found.probability.min(SUSPECTED + found.share.max(0.0));
        }
    }
}

/// Of each found mechanism, whether the intervals of its coefficients all hold 0 beside others; a
/// coefficient that is 0 since others stand for it has none. Not on a plant of many places, whose
/// delays are measured without an interval.
fn may_be_nothing(problem: &Problem, selection: &Selection, intervals: &Intervals) -> Vec<bool> {
    if selection.found.len() < 2 || problem.rules.many {
        return vec![false; selection.found.len()];
    }
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let own = coefficients.iter().zip(&intervals.terms);
    own.skip(selection.nominal.len())
        .map(|(values, halves)| {
            let mut pairs = values.iter().zip(halves);
            !values.is_empty() && pairs.all(|(value, half)| *value == 0.0 || value.abs() < *half)
        })
        .collect()
}
