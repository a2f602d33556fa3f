//! This file searches for onsets: a term of an explanation that begins in the middle of a
//! recording.

use super::beam::joins;
use super::fitted::Fitted;
use super::folds::Folds;
use super::refine::refined;
use super::score::{Judge, is_impossible};
use super::unfitted;
use crate::cause::Cause;
use crate::problem::{Kept, Problem, Term};
use crate::rules::{BEAM, LATE, ONSET_GRID, ONSET_HALVINGS, ONSET_MARGIN};
use rayon::prelude::*;
use std::sync::Arc;

/// What is needed to judge explanations with an onset.
pub struct Late<'a> {
    pub problem: &'a Problem<'a>,
    pub folds: &'a Folds,
    pub judge: &'a Judge,
    pub bare: &'a Fitted,
}

/// Where a term is tried from an onset on: the others, its cause and its shape.
type Place = (Fitted, Cause, Vec<f64>);

/// An explanation whose last term begins at `share` of the recording.
#[derive(Clone)]
struct Begun {
    evidence: f64,
    share: f64,
    fitted: Fitted,
}

impl Late<'_> {
    /// Explanations in which one term has an onset.
    ///
    /// Onsets are tried on a grid for every single cause and for the leading explanations. The best
    /// of these are refined between the points of the grid. Where one of them predicts better than
    /// every explanation without onset, every other term is tried from that onset on: the shape of
    /// a law over the whole recording says little about its shape after the onset.
    pub fn found(&self, ranked: &[Fitted], tried: &[Arc<Kept>]) -> Vec<Fitted> {
        let places = ranked.iter().enumerate();
        let places = places.filter(|(place, own)| own.terms.len() == 1 || *place < LATE);
        let moved = places.flat_map(|(_, own)| {
            let apart = (0..own.terms.len()).filter_map(|index| self.apart(own, index));
            apart.map(|(others, term)| (others, term.cause, term.shape))
        });
        self.begun_at_best(moved.collect(), ranked, tried)
    }

    /// Explanations in which a law whose numbers the description leaves open changes them: each term
    /// of `open` from an onset on, beside the nominal model and the leading explanations.
    pub fn changed(
        &self,
        ranked: &[Fitted],
        tried: &[Arc<Kept>],
        open: &[Arc<Kept>],
    ) -> Vec<Fitted> {
        let beside = || std::iter::once(self.bare).chain(ranked.iter().take(LATE));
        let places = open.iter().flat_map(|term| {
            beside().map(|own| (own.clone(), term.cause(), term.shape().to_vec()))
        });
        self.begun_at_best(places.collect(), ranked, &[tried, open].concat())
    }

    /// Each explanation with its term from the best onset on, and what takes the place of the best.
    fn begun_at_best(
        &self,
        places: Vec<Place>,
        ranked: &[Fitted],
        tried: &[Arc<Kept>],
    ) -> Vec<Fitted> {
        let found = self.placed(self.on_grid(places));
        let from_start = ranked
            .iter()
            .map(|own| self.judge.evidence(self.folds, own));
        let most = from_start.fold(f64::NEG_INFINITY, f64::max);
        let leading = found
            .iter()
            .max_by(|a, b| a.evidence.total_cmp(&b.evidence));
        let exchanged = leading.filter(|own| own.evidence > most).map(|leading| {
            let shapes = self.exchanged(leading, tried, most);
            self.placed(shapes)
        });
        let all = found.into_iter().chain(exchanged.into_iter().flatten());
        let best = self.best_of_each(all.collect()).into_iter();
        best.map(|own| own.fitted).collect()
    }

    /// Each explanation with each term from the best onset on a grid.
    fn on_grid(&self, places: Vec<Place>) -> Vec<Begun> {
        let begun = places.into_par_iter().filter_map(|(others, cause, shape)| {
            let grid = (1..ONSET_GRID).map(|k| k as f64 / ONSET_GRID as f64);
            let all = grid.filter_map(|share| self.begun(&others, cause, &shape, share));
            all.max_by(|a, b| a.evidence.total_cmp(&b.evidence))
        });
        begun.collect()
    }

    /// An explanation without one of its terms, and that term.
    fn apart(&self, own: &Fitted, index: usize) -> Option<(Fitted, Term)> {
        let mut others = own.terms.clone();
        (index < others.len())
            .then(|| others.remove(index))
            .map(|term| (self.bare.of(self.folds, &others), term))
    }

    /// The explanations with every other term in the place of the late one, from about the same
    /// onset on, where they predict better than every explanation from the start (`most`). The best
    /// get refined shapes.
    fn exchanged(&self, leading: &Begun, tried: &[Arc<Kept>], most: f64) -> Vec<Begun> {
        let last = leading.fitted.terms.len().saturating_sub(1);
        let Some((others, _)) = self.apart(&leading.fitted, last) else {
            return Vec::new();
        };
        let open = tried.par_iter();
        let open = open.filter(|own| joins(self.problem, &others.terms, own));
        let share = leading.share;
        let begun = open.filter_map(|own| self.begun(&others, own.cause(), own.shape(), share));
        // Each law from its own onset on: a little beside it, the right one may be among the last.
        let each = self.best_of_each(begun.collect()).into_par_iter();
        let each = each.filter(|own| own.evidence > most);
        let begun = each.filter_map(|own| self.at_its_onset(own));
        let mut best = self.ranked(begun.collect());
        best.truncate(BEAM);
        let refined = best.into_par_iter().map(|own| {
            let fitted = refined(self.problem, self.folds, self.judge, self.bare, own.fitted);
            Begun {
                evidence: self.judge.evidence(self.folds, &fitted),
                fitted,
                ..own
            }
        });
        refined.collect()
    }

    /// The best explanations, with onsets refined between the points of the grid.
    fn placed(&self, on_grid: Vec<Begun>) -> Vec<Begun> {
        let mut best = self.ranked(on_grid);
        best.truncate(BEAM);
        let placed = best.into_par_iter();
        placed.filter_map(|own| self.at_its_onset(own)).collect()
    }

    /// An explanation with its onset refined between the points of the grid.
    fn at_its_onset(&self, mut best: Begun) -> Option<Begun> {
        let last = best.fitted.terms.len().checked_sub(1)?;
        let (others, term) = self.apart(&best.fitted, last)?;
        let mut stride = 0.5 / ONSET_GRID as f64;
        for _ in 0..ONSET_HALVINGS {
            for share in [best.share - stride, best.share + stride] {
                let moved = self.begun(&others, term.cause, &term.shape, share);
                best = moved
                    .filter(|moved| moved.evidence > best.evidence)
                    .unwrap_or(best);
            }
            stride *= 0.5;
        }
        Some(best)
    }

    /// The best explanation of each set of causes, the best first.
    fn best_of_each(&self, all: Vec<Begun>) -> Vec<Begun> {
        let causes = |own: &Begun| -> Vec<Cause> {
            own.fitted.terms.iter().map(|term| term.cause).collect()
        };
        let mut best: Vec<Begun> = Vec::new();
        for own in self.ranked(all) {
            if !best.iter().any(|other| causes(other) == causes(&own)) {
                best.push(own);
            }
        }
        best
    }

    fn ranked(&self, mut all: Vec<Begun>) -> Vec<Begun> {
        all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        all
    }

    /// An explanation with one more term, from an onset on.
    fn begun(&self, others: &Fitted, cause: Cause, shape: &[f64], share: f64) -> Option<Begun> {
        if !(ONSET_MARGIN..1.0 - ONSET_MARGIN).contains(&share) {
            return None;
        }
        let clock = self.problem.run.clock();
        let onset_s = clock.start_s + share * clock.duration_s();
        let term = unfitted(self.problem, cause, shape, Some(onset_s))?;
        let fitted = others.with(self.folds, &term);
        let evidence = self.judge.evidence(self.folds, &fitted);
        (!is_impossible(self.problem, &fitted)).then_some(Begun {
            evidence,
            share,
            fitted,
        })
    }
}
