//! This file finds the explanations of a plant with many places that have a share in the posterior.
//!
//! Where several places lack something, thousands of sets may explain a recording about equally
//! well. A Markov chain over sets visits each as often as it is probable (Madigan and York,
//! International Statistical Review 63, 1995), so what it never meets hardly counts. Those that it met
//! are then weighed by their posterior, which has no error of sampling.

use super::fitted::Fitted;
use super::{Judged, sorted};
use crate::cause::Cause;
use crate::problem::Term;
use crate::rules::{WALK_STEPS, WALKS};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What a walk goes over.
pub trait Sets: Sync {
    /// The log posterior of a set, up to a constant; −∞ for one that is no physics.
    fn score(&self, own: &Fitted) -> f64;

    /// A set with one term more; `None` where the term may not join it.
    fn with(&self, own: &Fitted, term: &Term) -> Option<Fitted>;

    fn without(&self, own: &Fitted, index: usize) -> Fitted;
}

/// A set with its log posterior.
pub type Scored = (f64, Fitted);

/// A term with the weight with which a walk tries it.
pub struct Tried<'a> {
    pub term: &'a Term,
    pub weight: f64,
}

/// The sets that walks from `start` met. Their fits are not kept: there may be thousands.
pub fn met(sets: &impl Sets, start: &Scored, tried: &[Tried]) -> Vec<Judged> {
    let walks = (0..WALKS).into_par_iter().map(|seed| {
        let random = Pcg64Mcg::seed_from_u64(seed as u64);
        Walk {
            sets,
            tried,
            random,
        }
        .steps(start.clone())
    });
    let mut all = Met::new();
    for own in walks.collect::<Vec<_>>() {
        all.extend(own);
    }
    all.into_values().collect()
}

/// Sets by their causes.
type Met = BTreeMap<Vec<Cause>, Judged>;

/// One walk.
struct Walk<'a, S> {
    sets: &'a S,
    tried: &'a [Tried<'a>],
    random: Pcg64Mcg,
}

/// A step: the term that goes, the one that comes.
type Step<'a> = (Option<usize>, Option<&'a Term>);

impl<'a, S: Sets> Walk<'a, S> {
    /// The sets that it meets. One that it steps back from counts too: its posterior is known.
    fn steps(mut self, mut now: Scored) -> Met {
        let mut met = Met::new();
        met.insert(sorted(now.1.causes()), Judged::of(now.0, &now.1));
        for _ in 0..WALK_STEPS {
            let Some(step) = self.proposed(&now.1) else {
                continue;
            };
            let share = self.share();
            // Each proposal is as likely as its way back (Metropolis and others, Journal of
            // Chemical Physics 21, 1953).
            let accepts = |score: f64| share < libm::exp(score - now.0);
            let causes = sorted(after(&now.1, step));
            if met.get(&causes).is_some_and(|own| !accepts(own.score)) {
                continue;
            }
            let Some(next) = self.taken(&now.1, step) else {
                continue;
            };
            let score = self.sets.score(&next);
            met.entry(causes)
                .or_insert_with(|| Judged::of(score, &next));
            if accepts(score) {
                now = (score, next);
            }
        }
        met.retain(|_, own| own.score > f64::NEG_INFINITY);
        met
    }

    /// A term added or removed, or every other time one exchanged: half of these for another one
    /// at the same place, which often explains nearly the same.
    fn proposed(&mut self, now: &Fitted) -> Option<Step<'a>> {
        let exchanges = self.share() < 0.5;
        let term = self.drawn(exchanges)?;
        let place = now.causes().position(|cause| cause == term.cause);
        match (place, exchanges) {
            (Some(index), false) => Some((Some(index), None)),
            (None, false) => Some((None, Some(term))),
            (Some(_), true) => None,
            (None, true) => {
                let anywhere = self.share() < 0.5;
                let gives_way = |cause: Cause| anywhere || cause.at == term.cause.at;
                let causes = now.causes().enumerate();
                let given = causes.filter_map(|(k, own)| gives_way(own).then_some(k));
                let given: Vec<usize> = given.collect();
                let index = (self.share() * given.len() as f64) as usize;
                Some((Some(*given.get(index)?), Some(term)))
            }
        }
    }

    /// The set after a step; `None` where the term may not join it.
    fn taken(&self, now: &Fitted, (goes, comes): Step) -> Option<Fitted> {
        let fewer = goes.map(|index| self.sets.without(now, index));
        match comes {
            Some(term) => self.sets.with(fewer.as_ref().unwrap_or(now), term),
            None => fewer,
        }
    }

    /// A term by its weight, or each alike: the way back of an exchange draws another term.
    fn drawn(&mut self, alike: bool) -> Option<&'a Term> {
        let (share, tried) = (self.share(), self.tried);
        if alike {
            let index = (share * tried.len() as f64) as usize;
            return tried.get(index).map(|own| own.term);
        }
        let sum: f64 = tried.iter().map(|own| own.weight).sum();
        let mut left = share * sum;
        let drawn = tried.iter().find(|own| {
            left -= own.weight;
            left < 0.0
        });
        drawn.or(tried.last()).map(|own| own.term)
    }

    /// A number from 0 to below 1.
    fn share(&mut self) -> f64 {
        (self.random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The causes after a step.
fn after<'a>(now: &'a Fitted, (goes, comes): Step<'a>) -> impl Iterator<Item = Cause> + 'a {
    let stay = now
        .causes()
        .enumerate()
        .filter(move |(k, _)| Some(*k) != goes);
    stay.map(|(_, own)| own).chain(comes.map(|term| term.cause))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::folds::Folds;
    use crate::plants::five_bar::recorded::{problem, short_run};
    use crate::plants::five_bar::run::at;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    /// Terms with odds of their own; one is no physics beside another.
    struct Toy {
        folds: Folds,
        bare: Fitted,
        odds: Vec<(Cause, f64)>,
        apart: [Cause; 2],
    }

    impl Sets for Toy {
        fn score(&self, own: &Fitted) -> f64 {
            let holds = |cause: &Cause| own.causes().any(|own| own == *cause);
            if self.apart.iter().all(holds) {
                return f64::NEG_INFINITY;
            }
            let each = self.odds.iter().filter(|(cause, _)| holds(cause));
            each.map(|(_, odds)| odds).sum()
        }

        fn with(&self, own: &Fitted, term: &Term) -> Option<Fitted> {
            let is_new = own.causes().all(|cause| cause != term.cause);
            is_new.then(|| own.with(&self.folds, term))
        }

        fn without(&self, own: &Fitted, index: usize) -> Fitted {
            let mut terms = own.terms.clone();
            terms.remove(index);
            self.bare.of(&self.folds, &terms)
        }
    }

    #[test]
    fn a_walk_finds_every_set_that_counts_and_none_that_is_no_physics() {
        let run = short_run();
        let problem = problem(&run);
        let causes = [Joint::A, Joint::B, Joint::C].map(|joint| at(Mechanism::Viscous, joint));
        let terms = causes.map(|cause| problem.whole_term(cause, &[]).unwrap());
        let folds = Folds::of(&problem);
        let toy = Toy {
            bare: Fitted::bare(&folds, &problem.target.white, &[]),
            folds,
            odds: causes.into_iter().zip([2.0, -2.0, -1.0]).collect(),
            apart: [causes[1], causes[2]],
        };
        let weights = [0.3, 1.0, 0.5].into_iter();
        let tried: Vec<Tried> = terms
            .iter()
            .zip(weights)
            .map(|(term, weight)| Tried { term, weight })
            .collect();
        let found = met(&toy, &(0.0, toy.bare.clone()), &tried);
        let sets = found
            .iter()
            .map(|own| sorted(own.terms.iter().map(|term| term.cause)));
        let mut sets: Vec<Vec<Cause>> = sets.collect();
        sets.sort();
        let [a, b, c] = causes;
        let mut expected = vec![vec![], vec![a], vec![b], vec![c], vec![a, b], vec![a, c]];
        expected.sort();
        assert_eq!(sets, expected);
        let fitted = |own: &Judged| toy.bare.of(&toy.folds, &own.terms);
        assert!(found.iter().all(|own| own.score == toy.score(&fitted(own))));
    }
}
