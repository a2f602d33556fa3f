//! This file refines the shape and the onset of a term by a pattern search inside their bounds.

use super::weigh::{effort_beside, loss_with, own_coefficients};
use crate::candidates::{is_periodic, is_sign, modelled_effort, realise, shape_bounds};
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit};
use crate::rules::{
    LEAST_IMPROVEMENT, MOST_ROUNDS, NO_WORSE, ONSET_HALVINGS, ONSET_MARGIN, ONSET_STRIDE,
    PERIOD_STRIDE, STRIDE, STRIDE_HALVINGS, TAKEN_AGAIN,
};

/// The variant with the least loss over all blocks, and its loss.
pub(crate) fn best_variant(
    problem: &Problem,
    common: &[&Term],
    tried: &[Term],
) -> Option<(Term, f64)> {
    tried
        .iter()
        .map(|term| (term, loss_with(problem, common, term)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(term, loss)| (term.clone(), loss))
}

/// Pattern search over the logarithms of the shape parameters and the onset.
pub(crate) fn refined(problem: &Problem, common: &[&Term], start: Term, blocks: &Blocks) -> Term {
    let score = |term: &Term| loss_with(problem, common, term);
    let fitted = fit(problem, common, blocks);
    let effort = effort_beside(problem, common, &start, blocks)
        .unwrap_or_else(|| modelled_effort(problem, common, &fitted));
    let bounds = shape_bounds(problem, start.cause, &start.shape);
    let mut best = (score(&start), start);
    let mut stride = STRIDE;
    let mut halvings = 0;
    for _ in 0..MOST_ROUNDS {
        let before = best.0;
        for direction in directions(best.1.numbers().len(), best.1.onset_s.is_some()) {
            let mut along = direction.iter().enumerate();
            if along.any(|(place, by)| *by != 0.0 && is_sign(best.1.cause, place)) {
                continue;
            }
            let Some(moved) = moved(problem, &best.1, &direction, stride, &bounds, &effort) else {
                continue;
            };
            let loss = score(&moved);
            if loss < best.0 {
                best = (loss, moved);
            }
        }
        if best.0 > (1.0 - LEAST_IMPROVEMENT) * before {
            stride *= 0.5;
            halvings += 1;
        }
        let limit = if best.1.onset_s.is_some() {
            ONSET_HALVINGS
        } else {
            STRIDE_HALVINGS
        };
        if halvings == limit {
            break;
        }
    }
    taken_again(problem, common, best, blocks)
}

fn taken_again(problem: &Problem, common: &[&Term], start: (f64, Term), blocks: &Blocks) -> Term {
    let (loss, mut term) = start;
    for _ in 0..TAKEN_AGAIN {
        let mut terms = common.to_vec();
        terms.push(&term);
        let fitted = fit(problem, &terms, blocks);
        let again = problem
            .shape_over(&term, own_coefficients(&term, &fitted))
            .and_then(|shape| realise(problem, term.cause, &shape, term.onset_s, &[]))
            .filter(|again| loss_with(problem, common, again) <= NO_WORSE * loss);
        match again {
            Some(again) => term = again,
            None => break,
        }
    }
    term
}

/// The directions of the pattern: each parameter alone both ways, and pairs of shape parameters
/// together.
fn directions(shape: usize, onset: bool) -> Vec<Vec<f64>> {
    let size = shape + usize::from(onset);
    let unit = |index: usize, sign: f64| {
        (0..size)
            .map(|k| if k == index { sign } else { 0.0 })
            .collect()
    };
    let mut all: Vec<Vec<f64>> = (0..size)
        .flat_map(|k| [unit(k, 1.0), unit(k, -1.0)])
        .collect();
    if shape == 2 {
        for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mut pair: Vec<f64> = vec![a, b];
            pair.resize(size, 0.0);
            all.push(pair);
        }
    }
    all
}

/// The term with its shape scaled by `1 + stride` along a direction, and its onset moved by the
/// last component. `None` outside the bounds.
fn moved(
    problem: &Problem,
    term: &Term,
    direction: &[f64],
    stride: f64,
    bounds: &[(f64, f64)],
    effort: &[f64],
) -> Option<Term> {
    let mut shape = term.shape.clone();
    let own = match is_periodic(term.cause) {
        true => PERIOD_STRIDE * stride,
        false => stride,
    };
    for ((value, along), (low, high)) in shape.iter_mut().zip(direction).zip(bounds) {
        *value *= 1.0 + own * along;
        if *value < *low || *value > *high {
            return None;
        }
    }
    let length_s = problem.run.clock().duration_s();
    let mut onset_s = term.onset_s;
    if let (Some(onset), Some(along)) = (&mut onset_s, direction.get(term.numbers().len())) {
        *onset += ONSET_STRIDE * stride * along * length_s;
        let share = (*onset - problem.run.clock().start_s) / length_s;
        if !(ONSET_MARGIN..1.0 - ONSET_MARGIN).contains(&share) {
            return None;
        }
    }
    realise(problem, term.cause, &shape, onset_s, effort)
}
