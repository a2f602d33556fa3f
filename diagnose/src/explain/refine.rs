//! This file refines the shapes of an explanation's terms by a pattern search inside their bounds.

use super::fitted::{Fitted, Folds};
use super::score::{Judge, is_impossible, prior};
use super::unfitted;
use crate::candidates::shape_bounds;
use crate::problem::{Problem, Term};
use crate::rules::{MOST_MOVES, PEAK_EXPONENTS_FIVE_BAR, STRIDES};
use rigproof_model::effects::facts;
use rigproof_model::effects::facts::Shapes;
use rigproof_spec::effect::Mechanism;

/// The explanation with the shapes of the best evidence that the search meets, and then with peaks in
/// plainer forms where that is more probable.
pub fn refined(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    start: Fitted,
) -> Fitted {
    let refining = Refining {
        problem,
        folds,
        judge,
        bare,
    };
    let mut best = (judge.evidence(folds, &start), start);
    // A step takes the first term and puts it last, so a full turn restores the order.
    for stride in STRIDES {
        for _ in 0..best.1.terms.len() {
            best = refining.moved(best, stride);
        }
    }
    let mut best = best.1;
    if best.terms.iter().any(is_peak) {
        for _ in 0..best.terms.len() {
            best = refining.plainer(best);
        }
    }
    best
}

/// What a refinement is judged by.
struct Refining<'a> {
    problem: &'a Problem<'a>,
    folds: &'a Folds,
    judge: &'a Judge,
    bare: &'a Fitted,
}

impl Refining<'_> {
    /// The first term moved by strides as long as the evidence grows, then put last.
    fn moved(&self, start: (f64, Fitted), stride: f64) -> (f64, Fitted) {
        let (before, start) = start;
        let Some((own, others)) = start.terms.split_first() else {
            return (before, start);
        };
        let others = self.bare.of(self.folds, others);
        let mut best = (before, others.with(self.folds, own));
        let mut came_from = None;
        let evidence = |fitted: &Fitted| self.judge.evidence(self.folds, fitted);
        for _ in 0..MOST_MOVES {
            let Some(own) = best.1.terms.last() else {
                break;
            };
            let mut tried = moves(self.problem, own, stride);
            tried.retain(|(by, _)| came_from != Some(by.back()));
            let Some((by, better)) = self.better(&others, tried, best.0, evidence) else {
                break;
            };
            came_from = Some(by);
            best = better;
        }
        best
    }

    /// The first term in a plainer form of its law, where that is more probable, then put last.
    fn plainer(&self, start: Fitted) -> Fitted {
        let Some((own, others)) = start.terms.split_first() else {
            return start;
        };
        let score = |fitted: &Fitted| {
            self.judge.evidence(self.folds, fitted) + prior(self.problem, &fitted.terms)
        };
        let others = self.bare.of(self.folds, others);
        let own = others.with(self.folds, own);
        let mut best = (score(&own), own);
        for place in PLAINER {
            let own = best.1.terms.last();
            let tried = own.map_or(Vec::new(), |own| plain_forms(self.problem, own, place));
            let better = self.better(&others, tried, best.0, score);
            best = better.map_or(best, |(_, better)| better);
        }
        best.1
    }

    /// The best of the terms beside others, with its value and its label; `None` if none is worth
    /// more than `than`.
    fn better<T>(
        &self,
        others: &Fitted,
        tried: Vec<(T, Term)>,
        than: f64,
        value: impl Fn(&Fitted) -> f64,
    ) -> Option<(T, (f64, Fitted))> {
        tried
            .into_iter()
            .map(|(label, term)| (label, others.with(self.folds, &term)))
            .filter(|(_, fitted)| !is_impossible(self.problem, fitted))
            .map(|(label, fitted)| (label, (value(&fitted), fitted)))
            .filter(|(_, (value, _))| *value > than)
            .max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0))
    }
}

fn is_peak(term: &Term) -> bool {
    facts(term.cause.mechanism).is_some_and(|facts| facts.shapes == Shapes::Peak)
}

/// The part of a peak that becomes plainer.
#[derive(Clone, Copy)]
enum Plainer {
    Exponent,
    Travel,
}

/// In the order in which they are tried.
const PLAINER: [Plainer; 2] = [Plainer::Exponent, Plainer::Travel];

/// A peak with its exponent as published, or without its travel. Nothing for other laws.
fn plain_forms(problem: &Problem, own: &Term, part: Plainer) -> Vec<(Plainer, Term)> {
    if !is_peak(own) {
        return Vec::new();
    }
    let shapes: Vec<Vec<f64>> = match (part, own.shape.as_slice()) {
        (Plainer::Exponent, [speed, _, travel @ ..]) => {
            let published = PEAK_EXPONENTS_FIVE_BAR.into_iter();
            published
                .map(|exponent| [&[*speed, exponent], travel].concat())
                .collect()
        }
        (Plainer::Travel, [speed, exponent, _]) => vec![vec![*speed, *exponent]],
        _ => Vec::new(),
    };
    let realised = shapes.iter();
    realised
        .filter_map(|shape| Some((part, unfitted(problem, own.cause, shape, own.onset_s)?)))
        .collect()
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
