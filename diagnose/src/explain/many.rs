//! This file explains a recording of a plant with many places: one explanation grows and is pruned
//! term by term, compared by cross-validation.
//!
//! A beam over sets would be too wide: several places usually lack something at once.

use super::beam::may_join;
use super::discrepancy::rows_a_sample;
use super::explanations::becomes;
use super::fitted::Fitted;
use super::folds::Folds;
use super::score::{Judge, is_impossible};
use super::walk::{self, Sets, Tried};
use super::{Explanation, Explanations, living, selected, shapes_of};
use crate::candidates::is_plain;
use crate::cause::{Cause, Place};
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit, free_columns, reduced_target};
use crate::rules::MOST_OF_MANY;
use crate::selection::{Selection, usable_rms};
use rayon::prelude::*;
use rigproof_model::effects::facts;
use rigproof_model::effects::facts::Family;
use rigproof_spec::effect::Mechanism;
use std::collections::{BTreeMap, BTreeSet};

/// Explains a recording of many places on top of the terms of its nominal model.
pub fn explain_many(problem: &mut Problem, mut nominal: Vec<Term>) -> (Selection, Explanations) {
    // The noise model is estimated with every term without a shape free. Whatever an explanation
    // leaves beyond that is not noise.
    let raw = plain_residual(problem, &nominal);
    problem.rewhiten(usable_rms(problem, &raw));
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    // Once more, now that each equation has its own noise.
    let raw = plain_residual(problem, &nominal);
    let noise = usable_rms(problem, &raw).max(problem.floor);
    problem.rewhiten(noise);
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    let white = problem.whitener.whiten(&raw);
    let rows = rows_a_sample(problem, &Folds::of(problem), &white);
    problem.rows_a_sample = rows;
    let round = Round::of(problem, &nominal, noise, rows);
    let living = round.weighed(problem, noise);
    let likest = None;
    let explanations = Explanations { living, likest }.led_by_the_sure();
    (selected(problem, nominal, &explanations), explanations)
}

/// The residual with every term free that has no shape parameter.
fn plain_residual(problem: &Problem, nominal: &[Term]) -> Vec<f64> {
    let tried = terms_of(problem, nominal);
    let plain = tried.iter().filter(|term| term.shape.is_empty());
    let all: Vec<&Term> = nominal.iter().chain(plain).collect();
    fit(problem, &all, &Blocks::new(problem)).residual
}

/// The mechanisms that the nominal model does not leave open, in every shape of the grid.
fn terms_of(problem: &Problem, nominal: &[Term]) -> Vec<Term> {
    let kept = shapes_of(problem, nominal, true).into_iter();
    kept.filter_map(|own| problem.whole(&own)).collect()
}

/// Whether it corrects the inertia of a link that an effort depends on.
fn is_link(term: &Term) -> bool {
    let acts = || {
        term.free
            .iter()
            .any(|own| own.raw.iter().any(|x| *x != 0.0))
    };
    term.cause.mechanism == Mechanism::LinkInertia && acts()
}

/// Whether a cause may stand beside these terms. A law that bends before it slides and the plain one
/// that it becomes do not stand at one place: one would only correct the shape of the other.
fn may_stand(terms: &[Term], cause: Cause) -> bool {
    let mut others = terms.iter().map(|own| own.cause);
    may_join(terms, cause) && !others.any(|own| becomes(own, cause) || becomes(cause, own))
}

/// One search under one noise model.
struct Round {
    folds: Folds,
    judge: Judge,
    bare: Fitted,
    tried: Vec<Term>,
}

impl Round {
    fn of(problem: &Problem, nominal: &[Term], noise: f64, rows_a_sample: f64) -> Round {
        let folds = Folds::of(problem);
        let common: Vec<&Term> = nominal.iter().collect();
        let target = reduced_target(problem, &common).white;
        Round {
            bare: Fitted::bare(&folds, &target, &free_columns(problem, &common)),
            judge: Judge::of(problem, noise, rows_a_sample),
            tried: terms_of(problem, nominal),
            folds,
        }
    }

    fn score(&self, problem: &Problem, fitted: &Fitted) -> f64 {
        self.judge.score(problem, &self.folds, fitted)
    }

    /// The better of two searches: one starts from nothing, the other from corrected inertias of
    /// all links. Inertias of neighbouring links often explain something only together.
    fn searched(&self, problem: &Problem) -> Fitted {
        let links = self.tried.iter().filter(|term| is_link(term)).cloned();
        let links = self.bare.of(&self.folds, &links.collect::<Vec<_>>());
        let from_links = self.climbed(problem, (self.score(problem, &links), links), false);
        let from_links = self.pruned(problem, from_links);
        let nothing = (self.score(problem, &self.bare), self.bare.clone());
        let ends = [nothing, from_links].map(|start| self.climbed(problem, start, true));
        let best = ends.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or_else(|| self.bare.clone(), |own| own.1)
    }

    /// Adds terms as long as one makes the explanation more probable. If `prunes`, removes terms in
    /// the same way after each addition, and exchanges one, or laws with shapes at one place, where
    /// none helps.
    fn climbed(&self, problem: &Problem, mut best: (f64, Fitted), prunes: bool) -> (f64, Fitted) {
        let mut hopeful = vec![true; self.tried.len()];
        while best.1.terms.len() < MOST_OF_MANY {
            let grown = self.grown(problem, &best, &mut hopeful).or_else(|| {
                // A term that did not help a smaller set may help now.
                hopeful = vec![true; self.tried.len()];
                self.grown(problem, &best, &mut hopeful)
            });
            let better = match prunes {
                true => grown
                    .or_else(|| self.reshaped(problem, &best))
                    .or_else(|| self.exchanged(problem, &best))
                    .or_else(|| self.plainer(problem, &best)),
                false => grown,
            };
            let Some(better) = better else { break };
            best = match prunes {
                true => self.pruned(problem, better),
                false => better,
            };
        }
        best
    }

    /// The explanation with the term that helps most. Terms that do not help are skipped until
    /// nothing else helps.
    fn grown(
        &self,
        problem: &Problem,
        best: &(f64, Fitted),
        hopeful: &mut [bool],
    ) -> Option<(f64, Fitted)> {
        let scores: Vec<Option<f64>> = self
            .tried
            .par_iter()
            .zip(hopeful.par_iter())
            .map(|(term, hoped)| {
                if !hoped || !may_stand(&best.1.terms, term.cause) {
                    return None;
                }
                let fitted = best.1.with(&self.folds, term);
                (!is_impossible(problem, &fitted)).then(|| self.score(problem, &fitted))
            })
            .collect();
        for (hoped, score) in hopeful.iter_mut().zip(&scores) {
            *hoped = score.is_some_and(|score| score > best.0);
        }
        let ranked = scores.iter().enumerate();
        let ranked = ranked.filter_map(|(k, score)| Some((k, (*score)?)));
        let (place, score) = ranked.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let term = self.tried.get(place).filter(|_| score > best.0)?;
        Some((score, best.1.with(&self.folds, term)))
    }

    /// The explanation with a law in another shape, or one that bends before it slides instead of
    /// the plain one that it becomes; `None` where none makes it more probable.
    fn reshaped(&self, problem: &Problem, best: &(f64, Fitted)) -> Option<(f64, Fitted)> {
        self.replaced(problem, best, |own, term| {
            own.cause == term.cause || becomes(term.cause, own.cause)
        })
    }

    /// The explanation with one term exchanged for another; `None` where none makes it more
    /// probable.
    fn exchanged(&self, problem: &Problem, best: &(f64, Fitted)) -> Option<(f64, Fitted)> {
        self.replaced(problem, best, |own, term| own.cause != term.cause)
    }

    /// The best explanation with a term instead of one that gives way to it.
    fn replaced(
        &self,
        problem: &Problem,
        best: &(f64, Fitted),
        gives_way: impl Fn(&Term, &Term) -> bool + Sync,
    ) -> Option<(f64, Fitted)> {
        let of_each = self.tried.par_iter().filter_map(|term| {
            self.with_instead(problem, &best.1, term, |own| gives_way(own, term))
        });
        let better = of_each.max_by(|a, b| a.0.total_cmp(&b.0));
        better.filter(|own| own.0 > best.0)
    }

    /// The explanation with the plain laws of friction at a place in place of those with a shape:
    /// two of these together pass for two plain ones. `None` where it makes none more probable.
    fn plainer(&self, problem: &Problem, best: &(f64, Fitted)) -> Option<(f64, Fitted)> {
        let is_shaped = |term: &Term| {
            let family = facts(term.cause.mechanism).map(|own| own.family);
            let is_friction =
                |own| matches!(own, Family::FrictionOfMotion | Family::MemoryOfMotion);
            !term.shape.is_empty() && family.is_some_and(is_friction)
        };
        let shaped = || best.1.terms.iter().filter(|term| is_shaped(term));
        let places = shaped().map(|term| term.cause.at);
        let places: BTreeSet<Place> = places.collect();
        let plainer = places.into_iter().map(|at| {
            let here = |term: &&Term| term.cause.at == at && is_plain(term.cause.mechanism);
            let gives_way = |term: &&Term| here(term) || term.cause.at == at && is_shaped(term);
            let kept = best.1.terms.iter().filter(|term| !gives_way(term));
            let terms = kept.chain(self.tried.iter().filter(here)).cloned();
            let fitted = self.bare.of(&self.folds, &terms.collect::<Vec<_>>());
            self.pruned(problem, (self.score(problem, &fitted), fitted))
        });
        let possible = plainer.filter(|own| !is_impossible(problem, &own.1));
        let better = possible.max_by(|a, b| a.0.total_cmp(&b.0));
        better.filter(|own| own.0 > best.0)
    }

    /// The best explanation with a term instead of one of those that may give way.
    fn with_instead(
        &self,
        problem: &Problem,
        own: &Fitted,
        term: &Term,
        may_give_way: impl Fn(&Term) -> bool,
    ) -> Option<(f64, Fitted)> {
        let stays_beside = |index: usize| {
            let mut others = own.terms.iter().enumerate().filter(|(k, _)| *k != index);
            others.all(|(_, other)| may_stand(core::slice::from_ref(other), term.cause))
        };
        let given = own.terms.iter().enumerate();
        let given = given.filter(|(_, own)| may_give_way(own));
        let given = given.filter(|(index, _)| stays_beside(*index));
        let given: Vec<usize> = given.map(|(index, _)| index).collect();
        if given.is_empty() {
            return None;
        }
        let more = own.with(&self.folds, term);
        let fitted = given.into_iter().map(|index| self.without(&more, index));
        let fitted = fitted.filter(|own| !is_impossible(problem, own));
        let scored = fitted.map(|own| (self.score(problem, &own), own));
        scored.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The explanation without the terms whose removal makes it more probable.
    fn pruned(&self, problem: &Problem, mut best: (f64, Fitted)) -> (f64, Fitted) {
        loop {
            let fewer = (0..best.1.terms.len()).into_par_iter().map(|index| {
                let fitted = self.without(&best.1, index);
                (self.score(problem, &fitted), fitted)
            });
            let better = fewer.max_by(|a, b| a.0.total_cmp(&b.0));
            match better.filter(|better| better.0 > best.0) {
                Some(better) => best = better,
                None => return best,
            }
        }
    }

    fn without(&self, own: &Fitted, index: usize) -> Fitted {
        own.without(&self.folds, index).unwrap_or_else(|| {
            let mut terms = own.terms.clone();
            terms.remove(index);
            self.bare.of(&self.folds, &terms)
        })
    }

    /// The explanations that random walks from the leading one meet, the most probable first.
    fn weighed(&self, problem: &Problem, noise: f64) -> Vec<Explanation> {
        let leading = self.searched(problem);
        let start = (self.score(problem, &leading), leading);
        let sets = Of {
            round: self,
            problem,
        };
        // What is below the rounding of the sum of all weights is not kept.
        let met = walk::met(&sets, &start, &self.reachable(problem, &start));
        living(problem, self.folds.count(), met, noise, f64::EPSILON)
    }

    /// One term of each cause: that of the explanation, or in the shape with which it joins it best.
    /// The nearer its posterior then is, the more often it is tried.
    fn reachable<'a>(&'a self, problem: &Problem, start: &'a (f64, Fitted)) -> Vec<Tried<'a>> {
        let (score, own) = start;
        let weight = |other: f64| 1.0 / (1.0 + (score - other).abs());
        let inside = own.terms.iter().enumerate().map(|(index, term)| Tried {
            term,
            weight: weight(self.score(problem, &self.without(own, index))),
        });
        let outside = self.tried.par_iter().filter_map(|term| {
            if own.causes().any(|cause| cause == term.cause) {
                return None;
            }
            let joined = may_stand(&own.terms, term.cause).then(|| own.with(&self.folds, term));
            let joined = joined.filter(|own| !is_impossible(problem, own));
            let joined = joined.map(|own| self.score(problem, &own));
            let instead = || {
                Some(
                    self.with_instead(problem, own, term, |own| own.cause != term.cause)?
                        .0,
                )
            };
            Some((joined.or_else(instead)?, term))
        });
        let mut best: BTreeMap<Cause, (f64, &Term)> = BTreeMap::new();
        for (score, term) in outside.collect::<Vec<_>>() {
            let same = best.entry(term.cause).or_insert((score, term));
            if score > same.0 {
                *same = (score, term);
            }
        }
        let outside = best.into_values().map(|(score, term)| Tried {
            term,
            weight: weight(score),
        });
        inside.chain(outside).collect()
    }
}

/// The sets of terms of a round.
struct Of<'a> {
    round: &'a Round,
    problem: &'a Problem<'a>,
}

impl Sets for Of<'_> {
    fn score(&self, own: &Fitted) -> f64 {
        match is_impossible(self.problem, own) {
            true => f64::NEG_INFINITY,
            false => self.round.score(self.problem, own),
        }
    }

    fn with(&self, own: &Fitted, term: &Term) -> Option<Fitted> {
        may_stand(&own.terms, term.cause).then(|| own.with(&self.round.folds, term))
    }

    fn without(&self, own: &Fitted, index: usize) -> Fitted {
        self.round.without(own, index)
    }
}
