//! This file refines the shapes of an explanation's terms by a pattern search inside their bounds.

use super::fitted::Fitted;
use super::folds::Folds;
use super::score::{Judge, is_impossible, prior};
use super::unfitted;
use crate::candidates::{is_periodic, is_sign, shape_bounds};
use crate::problem::{Problem, Term};
use crate::rules::{
    MOST_MOVES, PEAK_EXPONENTS_FIVE_BAR, PERIOD_STRIDE, STRIDES, TAKEN_AGAIN, TOP_STRIDES,
};
use rayon::prelude::*;
use rigproof_model::effects::facts;
use rigproof_model::effects::facts::Shapes;

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
    for stride in TOP_STRIDES {
        for _ in 0..best.1.terms.len() {
            best = refining.topped(best, stride);
        }
    }
    let mut best = refining.taken_again(best);
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

    /// The first term at the top of the parabola through the evidence a stride up and a stride down, one
    /// number after the other, then put last.
    fn topped(&self, start: (f64, Fitted), stride: f64) -> (f64, Fitted) {
        let (before, start) = start;
        let Some((own, others)) = start.terms.split_first() else {
            return (before, start);
        };
        let others = self.bare.of(self.folds, others);
        let mut best = (before, others.with(self.folds, own));
        let evidence = |fitted: &Fitted| self.judge.evidence(self.folds, fitted);
        // A law that begins late is no more exact than its beginning.
        let numbers = match own.onset_s {
            Some(_) => 0,
            None => own.numbers().len(),
        };
        for place in 0..numbers {
            let Some(own) = best.1.terms.last() else {
                break;
            };
            let beside = |up| {
                let term = moved_by(self.problem, own, Move { place, up }, stride)?;
                Some(evidence(&others.with(self.folds, &term)))
            };
            let (Some(up), Some(down)) = rayon::join(|| beside(true), || beside(false)) else {
                continue;
            };
            let bend = 2.0 * best.0 - up - down;
            let part = 0.5 * (up - down) / bend;
            // No top where the evidence grows to one side.
            if bend <= 0.0 || part == 0.0 || part.abs() >= 1.0 {
                continue;
            }
            let by = Move {
                place,
                up: part > 0.0,
            };
            let tried = moved_by(self.problem, own, by, stride * part.abs()).map(|own| (by, own));
            if let Some((_, better)) =
                self.better(&others, tried.into_iter().collect(), best.0, evidence)
            {
                best = better;
            }
        }
        best
    }

    /// With columns that are straight for a small change taken anew at the change that was fitted,
    /// as long as the evidence grows.
    fn taken_again(&self, start: (f64, Fitted)) -> Fitted {
        let mut best = start;
        for _ in 0..TAKEN_AGAIN {
            let fitted = best.1.terms.iter().zip(best.1.by_term());
            let again = fitted.map(|(term, coefficients)| {
                let shape = self.problem.shape_over(term, coefficients);
                let again = shape
                    .and_then(|shape| unfitted(self.problem, term.cause, &shape, term.onset_s));
                again.unwrap_or_else(|| term.clone())
            });
            let terms: Vec<Term> = again.collect();
            let is_as_before = |(a, b): (&Term, &Term)| a.shape == b.shape;
            if terms.iter().zip(&best.1.terms).all(is_as_before) {
                break;
            }
            let again = self.bare.of(self.folds, &terms);
            let evidence = self.judge.evidence(self.folds, &again);
            if evidence <= best.0 {
                break;
            }
            best = (evidence, again);
        }
        best.1
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

fn is_anchored(term: &Term) -> bool {
    facts(term.cause.mechanism).is_some_and(|facts| facts.shapes == Shapes::Anchor)
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

    fn factor(self, stride: f64) -> f64 {
        match self.up {
            true => 1.0 + stride,
            false => 1.0 / (1.0 + stride),
        }
    }
}

/// A term with one shape parameter moved by a stride, up or down, for each parameter.
fn moves(problem: &Problem, own: &Term, stride: f64) -> Vec<(Move, Term)> {
    let each = (0..2 * own.numbers().len()).into_par_iter();
    let each = each.map(|k| Move {
        place: k / 2,
        up: k % 2 == 0,
    });
    let each = each.filter(|by| !is_sign(own.cause, by.place));
    each.filter_map(|by| Some((by, moved_by(problem, own, by, stride)?)))
        .collect()
}

/// A term with one shape parameter moved by a stride; of an anchor its distance and its direction
/// from the middle of what is searched. `None` outside the bounds.
fn moved_by(problem: &Problem, own: &Term, by: Move, stride: f64) -> Option<Term> {
    let bounds = shape_bounds(problem, own.cause, &own.shape);
    // The grid already knows a period to within a few percent, and a longer stride leads to another
    // period.
    let stride = match is_periodic(own.cause) {
        true => PERIOD_STRIDE * stride,
        false => stride,
    };
    let shape = match is_anchored(own) {
        true => moved_anchor(&own.shape, &bounds, by, stride)?,
        false => scaled(&own.shape, by, stride)?,
    };
    let mut moved = shape.iter().zip(&own.shape).zip(&bounds[..]);
    let stays = moved.all(|((to, from), &(low, high))| {
        to == from || (low.min(high)..=high.max(low)).contains(to)
    });
    match stays {
        true => unfitted(problem, own.cause, &shape, own.onset_s),
        false => None,
    }
}

/// A shape with one parameter longer or shorter by a share.
fn scaled(shape: &[f64], by: Move, stride: f64) -> Option<Vec<f64>> {
    let mut shape = shape.to_vec();
    *shape.get_mut(by.place)? *= by.factor(stride);
    Some(shape)
}

/// An anchor at another distance, or in another direction, from the middle of its bounds.
fn moved_anchor(shape: &[f64], bounds: &[(f64, f64)], by: Move, stride: f64) -> Option<Vec<f64>> {
    let ([x, y], [wide, high]) = (shape, bounds) else {
        return None;
    };
    let middle = [wide, high].map(|(low, high)| 0.5 * (low + high));
    let [x, y] = [x - middle[0], y - middle[1]];
    let (factor, angle) = match (by.place, by.up) {
        (0, _) => (by.factor(stride), 0.0),
        (_, true) => (1.0, stride),
        (_, false) => (1.0, -stride),
    };
    let (sine, cosine) = libm::sincos(angle);
    Some(vec![
        middle[0] + factor * (x * cosine - y * sine),
        middle[1] + factor * (x * sine + y * cosine),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [(f64, f64); 2] = [(-0.4, 0.6), (-0.2, 1.0)];

    fn moved(from: [f64; 2], place: usize, up: bool) -> [f64; 2] {
        let moved = moved_anchor(&from, &BOUNDS, Move { place, up }, 0.15).unwrap();
        [moved[0], moved[1]]
    }

    fn distance([x, y]: [f64; 2]) -> f64 {
        (x - 0.1).hypot(y - 0.4)
    }

    #[test]
    fn an_anchor_moves_away_and_around_and_across_the_axes() {
        let from = [0.31, 0.02];
        assert!((distance(moved(from, 0, true)) / distance(from) - 1.15).abs() < 1e-12);
        let [x, y] = moved(from, 1, false);
        assert!((distance([x, y]) - distance(from)).abs() < 1e-12);
        assert!(y < 0.0, "{y}");
        let back = moved([x, y], 1, true);
        assert!((back[0] - from[0]).hypot(back[1] - from[1]) < 1e-12);
    }

    #[test]
    fn what_is_no_point_in_a_plane_is_no_anchor() {
        let by = Move { place: 0, up: true };
        assert_eq!(moved_anchor(&[0.3], &BOUNDS, by, 0.15), None);
        assert_eq!(scaled(&[0.3], by, 0.15), Some(vec![0.3 * 1.15]));
        assert_eq!(scaled(&[], by, 0.15), None);
    }
}
