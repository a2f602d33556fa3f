//! This file refines the shapes of an explanation's terms by a pattern search inside their bounds.

use super::fitted::{Fitted, Folds};
use super::score::{Judge, is_impossible, prior};
use super::unfitted;
use crate::candidates::shape_bounds;
use crate::problem::{Problem, Term};
use crate::rules::{MOST_MOVES, PEAK_EXPONENTS_FIVE_BAR, STRIDES};
use rigproof_model::effects::facts::Shapes;
use rigproof_model::effects::{entry, facts};
use rigproof_spec::effect::Mechanism;

/// The explanation with the shapes of the best evidence that the search meets.
pub fn refined(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    start: Fitted,
) -> Fitted {
    let mut best = (judge.evidence(folds, &start), start);
    for stride in STRIDES {
        // `moved` takes the first term and puts it last, so a full turn restores the order.
        for _ in 0..best.1.terms.len() {
            best = moved(problem, folds, judge, bare, best, stride);
        }
    }
    for _ in 0..best.1.terms.len() {
        best.1 = plainer(problem, folds, judge, bare, best.1);
    }
    best.1
}

/// The first term in a plainer form of its law, where that is at least as probable, then put last.
fn plainer(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    start: Fitted,
) -> Fitted {
    let Some((own, others)) = start.terms.split_first() else {
        return start;
    };
    let score = |fitted: &Fitted| judge.evidence(folds, fitted) + prior(problem, &fitted.terms);
    let others = bare.of(folds, others);
    let own = others.with(folds, own);
    let mut best = (score(&own), own);
    let count = best.1.terms.last().map_or(0, |own| own.shape.len());
    for place in 1..count {
        let Some(own) = best.1.terms.last() else {
            break;
        };
        let tried = plain_forms(problem, own, place).into_iter();
        let tried = tried.map(|term| others.with(folds, &term));
        let tried = tried.filter(|fitted| !is_impossible(problem, fitted));
        let better = tried
            .map(|fitted| (score(&fitted), fitted))
            .filter(|(score, _)| *score > best.0)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        best = better.unwrap_or(best);
    }
    best.1
}

/// A peak with its exponent as published, or without its travel. Nothing for other laws.
fn plain_forms(problem: &Problem, own: &Term, place: usize) -> Vec<Term> {
    let mechanism = own.cause.mechanism;
    if facts(mechanism).is_none_or(|facts| facts.shapes != Shapes::Peak) {
        return Vec::new();
    }
    let linear = entry(mechanism).map_or(0, |entry| entry.linear);
    let shapes: Vec<Vec<f64>> = match linear + place < mechanism.needed() {
        true => PEAK_EXPONENTS_FIVE_BAR
            .into_iter()
            .map(|exponent| {
                let mut shape = own.shape.clone();
                shape
                    .iter_mut()
                    .skip(place)
                    .take(1)
                    .for_each(|x| *x = exponent);
                shape
            })
            .collect(),
        false => vec![own.shape.iter().copied().take(place).collect()],
    };
    let realised = shapes.iter();
    realised
        .filter_map(|shape| unfitted(problem, own.cause, shape, own.onset_s))
        .collect()
}

/// The first term moved by strides as long as the evidence grows, then put last.
fn moved(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    start: (f64, Fitted),
    stride: f64,
) -> (f64, Fitted) {
    let (before, start) = start;
    let Some((own, others)) = start.terms.split_first() else {
        return (before, start);
    };
    let others = bare.of(folds, others);
    let mut best = (before, others.with(folds, own));
    let mut came_from = None;
    for _ in 0..MOST_MOVES {
        let Some(own) = best.1.terms.last() else {
            break;
        };
        let tried = moves(problem, own, stride).into_iter();
        let tried = tried.filter(|(by, _)| came_from != Some(by.back()));
        let tried = tried.map(|(by, term)| (by, others.with(folds, &term)));
        let tried = tried.filter(|(_, fitted)| !is_impossible(problem, fitted));
        let better = tried
            .map(|(by, fitted)| (judge.evidence(folds, &fitted), by, fitted))
            .filter(|(evidence, ..)| *evidence > best.0)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((evidence, by, fitted)) = better else {
            break;
        };
        came_from = Some(by);
        best = (evidence, fitted);
    }
    best
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Move {
    place: usize,
    up: bool,
}

impl Move {
    fn back(self) -> Move {
        Move {
            up: !self.up,
            ..self
        }
    }
}

/// A term with one shape parameter moved by a stride, up or down.
fn moves(problem: &Problem, own: &Term, stride: f64) -> Vec<(Move, Term)> {
    let bounds = shape_bounds(problem, own.cause);
    // The grid already knows a period to within a few percent, and a longer stride leads to another
    // period.
    let stride = match own.cause.mechanism {
        Mechanism::Ripple => 0.02 * stride,
        _ => stride,
    };
    let mut all = Vec::new();
    for (place, &(low, high)) in (0..own.shape.len()).zip(&bounds) {
        for (up, factor) in [(true, 1.0 + stride), (false, 1.0 / (1.0 + stride))] {
            let mut shape = own.shape.clone();
            let Some(value) = shape.get_mut(place) else {
                continue;
            };
            *value *= factor;
            if *value < low.min(high) || *value > high.max(low) {
                continue;
            }
            let moved = unfitted(problem, own.cause, &shape, own.onset_s);
            all.extend(moved.map(|term| (Move { place, up }, term)));
        }
    }
    all
}
