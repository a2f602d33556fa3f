//! This file searches among sets of terms with a beam: several explanations stay alive at once, so
//! that the order in which terms enter decides nothing.

use super::fitted::Fitted;
use super::folds::Folds;
use super::is_form_of;
use super::refine::refined;
use super::score::{Judge, is_impossible};
use crate::candidates::is_periodic;
use crate::cause::Cause;
use crate::problem::{Kept, Key, Problem, Term, key};
use crate::rules::{BEAM, KEPT, MOST_TERMS, PEAKS_APART};
use core::f64::consts::TAU;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

type Names = Vec<String>;

/// What stands for an explanation whose terms are the same, shapes and all.
type Exact = Vec<Key>;

/// What a search needs.
pub struct Beam<'a> {
    pub problem: &'a Problem<'a>,
    pub folds: &'a Folds,
    pub judge: &'a Judge,
    pub bare: &'a Fitted,
    /// The terms that are tried.
    pub tried: &'a [Arc<Kept>],
}

/// The best explanation of each set of causes.
type Best = BTreeMap<Names, (f64, Fitted)>;

impl Beam<'_> {
    /// Every explanation that was kept, one for each set of causes, the best evidence first. The
    /// leading ones of each size have refined shapes.
    ///
    /// `known` are explanations that compete in any case. `exchanges` counts the rounds in which
    /// terms of the leading ones are removed or exchanged.
    pub fn search(&self, exchanges: usize, known: Vec<Fitted>) -> Vec<Fitted> {
        let mut best = Best::new();
        self.keep(&mut best, [self.bare.clone()].into_iter().chain(known));
        let mut living = vec![self.bare.clone()];
        let mut extended = BTreeSet::new();
        for size in 1..=MOST_TERMS {
            // All single causes are kept. A cause that begins late may explain nothing when it is
            // fitted to the whole recording.
            let most = if size == 1 { usize::MAX } else { BEAM + KEPT };
            extended.extend(living.iter().map(exact));
            let (near, far) = self.children(&living, most);
            living = self.by_evidence(near);
            self.keep(&mut best, living.iter().cloned().chain(far));
        }
        for _ in 0..exchanges {
            let mut leading = ranked(&best);
            leading.truncate(BEAM);
            let exchanged = self.exchanged(&leading, &mut extended);
            self.keep(&mut best, exchanged);
        }
        ranked(&best).into_iter().cloned().collect()
    }

    /// Explanations of more terms than a search tries on everything, as long as one term more makes
    /// the most probable one more probable. `leading` are those that were kept, the most probable
    /// first.
    pub fn larger(&self, leading: &[Fitted]) -> Vec<Fitted> {
        let best = |all: &[Fitted]| all.first().map_or(f64::NEG_INFINITY, |own| self.score(own));
        let mut most = best(leading);
        let full = leading.iter().filter(|own| own.terms.len() == MOST_TERMS);
        let mut living: Vec<Fitted> = full.take(BEAM).cloned().collect();
        let mut larger = Vec::new();
        loop {
            let (near, far) = self.children(&living, BEAM + KEPT);
            living = self.by_score(near);
            larger.extend(living.iter().cloned().chain(far));
            let score = best(&living);
            if score <= most {
                return larger;
            }
            most = score;
        }
    }

    /// Explanations, the most probable first.
    pub fn by_score(&self, all: Vec<Fitted>) -> Vec<Fitted> {
        best_first(all, |own| self.score(own))
    }

    /// The log posterior of an explanation, up to a constant.
    fn score(&self, own: &Fitted) -> f64 {
        self.judge.score(self.problem, self.folds, own)
    }

    /// Keeps an explanation where it is the best of its causes.
    fn keep(&self, best: &mut Best, all: impl IntoIterator<Item = Fitted>) {
        for own in all {
            let evidence = self.judge.evidence(self.folds, &own);
            let names = names(self.problem, own.causes());
            if best.get(&names).is_none_or(|(other, _)| evidence > *other) {
                best.insert(names, (evidence, own));
            }
        }
    }

    /// Explanations with one term removed or exchanged, one for each set of causes. The best of
    /// them have refined shapes. What was `extended` before is not extended again.
    fn exchanged(&self, leading: &[&Fitted], extended: &mut BTreeSet<Exact>) -> Vec<Fitted> {
        let mut fewer: Vec<Fitted> = Vec::new();
        for own in leading {
            for index in 0..own.terms.len() {
                let mut terms = own.terms.clone();
                terms.remove(index);
                let own = self.bare.of(self.folds, &terms);
                if extended.insert(exact(&own)) {
                    fewer.push(own);
                }
            }
        }
        let (near, far) = self.children(&fewer, KEPT);
        near.into_iter().chain(far).chain(fewer).collect()
    }

    /// The best extension by one term for each set of causes, at most so many: the leading ones
    /// with refined shapes, and the others.
    ///
    /// Thousands of terms are tried on every parent. Only what is kept is fitted twice, so that
    /// the fits of all of them are never in memory together.
    fn children(&self, living: &[Fitted], most: usize) -> (Vec<Fitted>, Vec<Fitted>) {
        let mut best: BTreeMap<Names, (f64, &Fitted, &Kept)> = BTreeMap::new();
        for parent in living {
            for (evidence, own) in self.extended(parent) {
                let names = names(self.problem, parent.causes().chain([own.cause()]));
                if best.get(&names).is_none_or(|(other, ..)| evidence > *other) {
                    best.insert(names, (evidence, parent, own));
                }
            }
        }
        let mut all: Vec<(f64, &Fitted, &Kept)> = best.into_values().collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all.truncate(most);
        let fitted = |(_, parent, own): &(f64, &Fitted, &Kept)| {
            Some(parent.with(self.folds, &self.problem.whole(own)?))
        };
        let (near, far) = all.split_at(all.len().min(BEAM));
        let near = near.par_iter().filter_map(fitted);
        let near = near.map(|own| refined(self.problem, self.folds, self.judge, self.bare, own));
        (near.collect(), far.par_iter().filter_map(fitted).collect())
    }

    /// The evidence of an explanation with each term that may join it.
    fn extended(&self, parent: &Fitted) -> Vec<(f64, &Kept)> {
        let open = self.tried.par_iter().map(Arc::as_ref);
        let open = open.filter(|own| joins(self.problem, &parent.terms, own));
        let scored = open.filter_map(|own| {
            let fitted = parent.with_kept(self.folds, own);
            let evidence = || self.judge.evidence(self.folds, &fitted);
            (!is_impossible(self.problem, &fitted)).then(|| (evidence(), own))
        });
        scored.collect()
    }

    fn by_evidence(&self, all: Vec<Fitted>) -> Vec<Fitted> {
        best_first(all, |own| self.judge.evidence(self.folds, own))
    }
}

/// Explanations by what each is worth, the best first.
fn best_first(all: Vec<Fitted>, worth: impl Fn(&Fitted) -> f64) -> Vec<Fitted> {
    let mut all: Vec<(f64, Fitted)> = all.into_iter().map(|own| (worth(&own), own)).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().map(|(_, own)| own).collect()
}

/// The kept explanations, the best evidence first.
fn ranked(best: &Best) -> Vec<&Fitted> {
    let mut all: Vec<&(f64, Fitted)> = best.values().collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().map(|(_, own)| own).collect()
}

fn exact(own: &Fitted) -> Exact {
    let of_term = |term: &Term| {
        let numbers: Vec<f64> = term.shape.iter().chain(&term.onset_s).copied().collect();
        key(term.cause, &numbers)
    };
    let mut exact: Exact = own.terms.iter().map(of_term).collect();
    exact.sort();
    exact
}

/// Whether a cause may be added. It enters once at each place, in one form: a second one would
/// only correct the shape of the first.
pub fn may_join(terms: &[Term], cause: Cause) -> bool {
    !terms.iter().any(|own| is_form_of(own, cause))
}

/// Whether a term may be added. What is periodic enters with several periods, as far apart as peaks
/// of a spectrum: a motor cogs by its poles and by its slots.
pub fn joins(problem: &Problem, terms: &[Term], own: &Kept) -> bool {
    let cause = own.cause();
    let is_apart = |other: &Term| {
        let travel = problem.run.travel(cause.at);
        let cycles = |shape: &[f64]| travel / shape.first().unwrap_or(&TAU);
        (cycles(&other.shape) - cycles(own.shape())).abs() > PEAKS_APART
    };
    let mut forms = terms.iter().filter(|own| is_form_of(own, cause));
    forms.all(|own| own.cause == cause && is_periodic(cause) && is_apart(own))
}

/// The sorted names of the causes: the key of a set.
pub fn names(problem: &Problem, causes: impl IntoIterator<Item = Cause>) -> Names {
    let causes = causes.into_iter();
    let mut names: Names = causes.map(|cause| problem.run.cause_name(cause)).collect();
    names.sort();
    names
}
