//! This file explains a recording in which many places lack something at once: names come to one explanation one by one and go again, each judged on data that it was not fitted to.

use super::beam::may_join;
use super::discrepancy::rows_a_sample;
use super::fitted::{Fitted, Folds};
use super::score::{Judge, gives_energy, prior};
use super::{Explanation, Explanations, candidates, living, selected};
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit, free_columns, reduced_target};
use crate::rules::MOST_OF_MANY;
use crate::selection::{Selection, usable_rms};
use rayon::prelude::*;
use rigproof_spec::effect::Mechanism;

/// Explains a recording of many places on top of the terms of its nominal model.
pub fn explain_many(problem: &mut Problem, mut nominal: Vec<Term>) -> (Selection, Explanations) {
    // Noise and its correlation are of what is left with everything plain free: whatever an explanation leaves beyond that is not noise.
    let raw = plain_residual(problem, &nominal);
    problem.rewhiten(usable_rms(problem, &raw));
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    // Again, with every equation weighed by its own noise.
    let raw = plain_residual(problem, &nominal);
    let noise = usable_rms(problem, &raw).max(problem.floor);
    problem.rewhiten(noise);
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    let white = problem.whitener.whiten(&raw);
    let rows = rows_a_sample(problem, &Folds::of(problem), &white);
    let round = Round::of(problem, &nominal, noise, rows);
    let leading = round.searched(problem);
    let explanations = Explanations {
        living: round.neighbours(problem, &leading, noise),
        samples: round.folds.rows() / rows,
    };
    (selected(problem, nominal, &explanations), explanations)
}

/// What is left of each row with every mechanism free that has no shape to be looked for.
fn plain_residual(problem: &Problem, nominal: &[Term]) -> Vec<f64> {
    let tried = candidates(problem, nominal);
    let plain = tried.iter().filter(|term| term.shape.is_empty());
    let all: Vec<&Term> = nominal.iter().chain(plain).collect();
    fit(problem, &all, &Blocks::new(problem)).residual
}

/// Whether it is other masses of a link on which some effort hangs.
fn is_link(term: &Term) -> bool {
    let acts = || {
        term.free
            .iter()
            .any(|own| own.raw.iter().any(|x| *x != 0.0))
    };
    term.cause.mechanism == Mechanism::LinkInertia && acts()
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
            tried: candidates(problem, nominal),
            folds,
        }
    }

    fn score(&self, problem: &Problem, fitted: &Fitted) -> f64 {
        self.judge.evidence(&self.folds, fitted) + prior(problem, &fitted.terms)
    }

    /// The better of two searches: from nothing, and from other masses of every link, which show beside one another only.
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

    /// The explanation to which nothing can be added, and if `prunes` from which nothing can be taken, that would make it more probable.
    fn climbed(&self, problem: &Problem, mut best: (f64, Fitted), prunes: bool) -> (f64, Fitted) {
        let mut hopeful = vec![true; self.tried.len()];
        while best.1.terms.len() < MOST_OF_MANY {
            let grown = self.grown(problem, &best, &mut hopeful).or_else(|| {
                // What was of no use beside fewer may be of use now.
                hopeful = vec![true; self.tried.len()];
                self.grown(problem, &best, &mut hopeful)
            });
            let Some(grown) = grown else { break };
            best = match prunes {
                true => self.pruned(problem, grown),
                false => grown,
            };
        }
        best
    }

    /// With the term that helps most; those that do not help are no longer hoped for.
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
                if !hoped || !may_join(&best.1.terms, term) {
                    return None;
                }
                let fitted = best.1.with(&self.folds, term);
                (!gives_energy(problem, &fitted)).then(|| self.score(problem, &fitted))
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

    /// Without the terms without which it is more probable.
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
        let mut terms = own.terms.clone();
        terms.remove(index);
        self.bare.of(&self.folds, &terms)
    }

    /// The leading explanation, those with one term fewer, and those with another one in its place at its joint.
    fn neighbours(&self, problem: &Problem, leading: &Fitted, noise: f64) -> Vec<Explanation> {
        let others = (0..leading.terms.len())
            .into_par_iter()
            .flat_map_iter(|index| {
                let fewer = self.without(leading, index);
                let place = leading.terms.get(index).map(|term| term.cause);
                let beside = self.tried.iter().filter(|term| {
                    place.is_some_and(|own| own.at == term.cause.at && own != term.cause)
                });
                let beside = beside.filter(|term| may_join(&fewer.terms, term));
                let exchanged = beside.map(|term| fewer.with(&self.folds, term));
                let exchanged = exchanged.filter(|own| !gives_energy(problem, own));
                let scored = exchanged.map(|own| (self.score(problem, &own), own));
                let best = scored.max_by(|a, b| a.0.total_cmp(&b.0));
                let fewer = (self.score(problem, &fewer), fewer.clone());
                [Some(fewer), best]
                    .into_iter()
                    .flatten()
                    .collect::<Vec<_>>()
            });
        let mut all: Vec<(f64, Fitted)> = others.collect();
        all.push((self.score(problem, leading), leading.clone()));
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        // An exchange that is better than what the search ended with leads.
        living(problem, self.folds.rows(), all, noise)
    }
}
