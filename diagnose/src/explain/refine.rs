//! This file refines the shapes of an explanation's terms by a pattern search inside their bounds.

use super::fitted::{Fitted, Folds};
use super::score::{Judge, gives_energy};
use super::unfitted;
use crate::candidates::shape_bounds;
use crate::problem::{Problem, Term};
use crate::rules::{MOST_MOVES, STRIDES};
use rigproof_spec::effect::Mechanism;

/// The explanation with the shapes that leave least.
pub fn refined(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    start: Fitted,
) -> Fitted {
    let mut best = (judge.evidence(folds, &start), start);
    for stride in STRIDES {
        for index in 0..best.1.terms.len() {
            for _ in 0..MOST_MOVES {
                let tried = moves(problem, &best.1, index, stride).into_iter();
                let tried = tried.map(|terms| bare.of(folds, &terms));
                let tried = tried.filter(|fitted| !gives_energy(fitted));
                let better = tried
                    .map(|fitted| (judge.evidence(folds, &fitted), fitted))
                    .filter(|(evidence, _)| *evidence > best.0)
                    .max_by(|a, b| a.0.total_cmp(&b.0));
                match better {
                    Some(better) => best = better,
                    None => break,
                }
            }
        }
    }
    best.1
}

/// The terms with one shape parameter of one of them moved by a stride either way.
fn moves(problem: &Problem, fitted: &Fitted, index: usize, stride: f64) -> Vec<Vec<Term>> {
    let Some(own) = fitted.terms.get(index) else {
        return Vec::new();
    };
    let bounds = shape_bounds(problem, own.cause);
    // A period is known to a small share of it before, and its neighbours are other periods.
    let stride = match own.cause.mechanism {
        Mechanism::Ripple => 0.02 * stride,
        _ => stride,
    };
    let mut all = Vec::new();
    for (place, &(low, high)) in (0..own.shape.len()).zip(&bounds) {
        for factor in [1.0 + stride, 1.0 / (1.0 + stride)] {
            let mut shape = own.shape.clone();
            let Some(value) = shape.get_mut(place) else {
                continue;
            };
            *value *= factor;
            if *value < low.min(high) || *value > high.max(low) {
                continue;
            }
            let Some(moved) = unfitted(problem, own.cause, &shape, own.onset_s) else {
                continue;
            };
            let mut terms = fitted.terms.clone();
            if let Some(slot) = terms.get_mut(index) {
                *slot = moved;
            }
            all.push(terms);
        }
    }
    all
}
