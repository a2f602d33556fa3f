//! This file explains a recording: sets of mechanisms judged together, on data that they were not fitted to, against a model of what every model leaves open.

mod beam;
mod discrepancy;
mod fitted;
mod late;
mod refine;
mod score;

use crate::candidates::{all_causes, is_at_an_end};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit, free_columns, paired, reduced_target};
use crate::rules::{EXCHANGES, LATE, LISTED, NAMED, OFFERED, ROWS_A_SAMPLE, SUSPECTED};
use crate::select::{Found, Selection, Stage, is_noise, usable_rms};
use fitted::{Fitted, Folds};
use rayon::prelude::*;
use rigproof_model::effects::facts;
use rigproof_spec::effect::Mechanism;
use score::{Judge, prior};
use std::sync::Arc;

/// One explanation beside others.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// Its terms.
    pub terms: Vec<Term>,
    /// Its probability beside the others.
    pub weight: f64,
    /// Root mean square of what it leaves of left-out data, in standard deviations of the sensors' noise.
    pub leaves: f64,
}

/// The explanations of a recording, the most probable first.
#[derive(Clone, Debug)]
pub struct Explanations {
    /// Those with a noticeable weight.
    pub living: Vec<Explanation>,
}

impl Explanations {
    /// The probability of a cause: the weight of all explanations that hold it.
    pub fn probability(&self, cause: Cause) -> f64 {
        let holds = |own: &&Explanation| own.holds(cause);
        self.living.iter().filter(holds).map(|own| own.weight).sum()
    }

    /// What explains as much in the place of a cause of the leading explanation: the others of the explanations that lack it, as far as they
    /// weigh together.
    pub fn instead_of(&self, cause: Cause) -> Vec<Cause> {
        let Some((leading, others)) = self.living.split_first() else {
            return Vec::new();
        };
        let without = || others.iter().filter(|own| !own.holds(cause));
        let mut instead: Vec<Cause> = Vec::new();
        for term in without().flat_map(|own| &own.terms) {
            if !leading.holds(term.cause) && !instead.contains(&term.cause) {
                instead.push(term.cause);
            }
        }
        let weight = |other: &Cause| -> f64 {
            let holds = without().filter(|own| own.holds(*other));
            holds.map(|own| own.weight).sum()
        };
        instead.retain(|other| weight(other) >= OFFERED);
        instead.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
        instead
    }
}

impl Explanation {
    /// Whether it holds a cause, in whatever form.
    fn holds(&self, cause: Cause) -> bool {
        let same = |own: Cause| own.at == cause.at && kind(own.mechanism) == kind(cause.mechanism);
        self.terms.iter().any(|term| same(term.cause))
    }
}

/// The mechanism of which one is a form.
fn kind(mechanism: Mechanism) -> Mechanism {
    facts(mechanism)
        .and_then(|facts| facts.form_of)
        .unwrap_or(mechanism)
}

/// What is said of something with this probability.
pub const fn status(probability: f64) -> &'static str {
    if probability >= NAMED {
        "named"
    } else if probability >= SUSPECTED {
        "suspected"
    } else {
        "possible"
    }
}

/// Explains a recording on top of the terms of its nominal model.
pub fn explain(problem: &mut Problem, mut nominal: Vec<Term>) -> (Selection, Explanations) {
    let (weighed, rows_a_sample) = round_of(problem, &nominal, problem.floor, ROWS_A_SAMPLE, 0);
    let blocks = Blocks::new(problem);
    let best = weighed.first().map_or(&[][..], |own| &own.terms);
    let terms: Vec<&Term> = nominal.iter().chain(best).collect();
    let left = usable_rms(problem, &fit(problem, &terms, &blocks).residual);
    // What the best explanation leaves is noise of the next round.
    problem.rewhiten(left);
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    let noise = left.max(problem.floor);
    let (living, _) = round_of(problem, &nominal, noise, rows_a_sample, EXCHANGES);
    let explanations = Explanations { living };
    (selected(problem, nominal, &explanations), explanations)
}

fn round_of(
    problem: &Problem,
    nominal: &[Term],
    noise: f64,
    rows_a_sample: f64,
    exchanges: usize,
) -> (Vec<Explanation>, f64) {
    let folds = Folds::of(problem);
    let judge = Judge::of(problem, noise, rows_a_sample);
    let common: Vec<&Term> = nominal.iter().collect();
    let target = reduced_target(problem, &common).white;
    let free = free_columns(problem, &common).into_iter();
    let bare = Fitted::bare(
        &folds,
        target,
        free.map(|rows| Arc::new(rows.clone())).collect(),
    );
    let tried = candidates(problem, nominal);
    let mut all = beam::search(problem, &folds, &judge, &bare, &tried, exchanges);
    if exchanges > 0 {
        let leading = ranked(problem, &folds, &judge, all.clone());
        let leading: Vec<Fitted> = leading.into_iter().map(|(_, own)| own).take(LATE).collect();
        all.extend(late::late(problem, &folds, &judge, &bare, &leading));
    }
    let rows_a_sample = discrepancy::rows_a_sample(&folds, &all, &problem.windows.usable);
    let judge = Judge::of(problem, noise, rows_a_sample);
    (
        weigh(problem, &folds, &judge, &bare, all, noise),
        rows_a_sample,
    )
}

fn weigh(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    all: Vec<Fitted>,
    noise: f64,
) -> Vec<Explanation> {
    let all = all
        .into_iter()
        .filter(|own| judge.all_matter(folds, bare, own))
        .filter(|own| !own.terms.iter().any(|term| is_at_an_end(problem, term)));
    let scored = ranked(problem, folds, judge, all.collect());
    let most = scored.first().map_or(0.0, |(score, _)| *score);
    let sum: f64 = scored
        .iter()
        .map(|(score, _)| libm::exp(score - most))
        .sum();
    let listed = scored.into_iter().map(|(score, own)| Explanation {
        weight: libm::exp(score - most) / sum,
        leaves: (own.left() / folds.rows()).sqrt() * noise / problem.floor,
        terms: own.terms,
    });
    listed.filter(|own| own.weight >= LISTED).collect()
}

/// Explanations with the logarithm of their weight, the most probable first.
fn ranked(problem: &Problem, folds: &Folds, judge: &Judge, all: Vec<Fitted>) -> Vec<(f64, Fitted)> {
    let score = |own: &Fitted| judge.evidence(folds, own) + prior(problem, &own.terms);
    let mut scored: Vec<(f64, Fitted)> = all.into_iter().map(|own| (score(&own), own)).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored
}

/// Every mechanism in every shape that is tried.
fn candidates(problem: &Problem, nominal: &[Term]) -> Vec<Term> {
    let common: Vec<&Term> = nominal.iter().collect();
    let plain = fit(problem, &common, &Blocks::new(problem));
    let is_free = |cause: &Cause| {
        let mut own = nominal.iter().filter(|term| term.cause == *cause);
        own.all(|term| term.known.is_some())
    };
    let open = all_causes(problem).into_iter().filter(is_free).collect();
    let of_cause = |cause: Cause| -> Vec<Term> {
        let shapes = problem.run.shapes(cause, &problem.windows, &plain.residual);
        let tried = shapes.iter().filter_map(|shape| {
            let kept = problem.kept_term(cause, shape);
            kept.or_else(|| unfitted(problem, cause, shape, None))
        });
        tried.collect()
    };
    let open: Vec<Cause> = open;
    open.into_par_iter().flat_map_iter(of_cause).collect()
}

/// A term of a cause as the recording has it, whatever the other terms give.
pub(crate) fn unfitted(
    problem: &Problem,
    cause: Cause,
    shape: &[f64],
    onset_s: Option<f64>,
) -> Option<Term> {
    let term = problem.term(cause, shape, onset_s);
    term.or_else(|| problem.drive_term(cause, shape, onset_s, &[]))
}

/// The leading explanation as a selection.
fn selected(problem: &Problem, nominal: Vec<Term>, explanations: &Explanations) -> Selection {
    let blocks = Blocks::new(problem);
    let leading = explanations.living.first();
    let terms = leading.map_or(&[][..], |own| &own.terms);
    let fitted = |terms: &[&Term]| {
        let all: Vec<&Term> = nominal.iter().chain(terms.iter().copied()).collect();
        fit(problem, &all, &blocks)
    };
    let (before, after) = (fitted(&[]), fitted(&terms.iter().collect::<Vec<_>>()));
    let found: Vec<Found> = terms
        .iter()
        .map(|term| {
            let others = terms.iter().filter(|other| other.cause != term.cause);
            let without = fitted(&others.collect::<Vec<_>>());
            let even = vec![1.0; without.block_loss.len()];
            let (gain, z) = paired(&without.block_loss, &after.block_loss, &even);
            Found {
                term: term.clone(),
                z,
                share: gain / without.left_out().max(1e-300),
                at_floor: is_noise(problem, &after),
                probability: explanations.probability(term.cause),
            }
        })
        .collect();
    let stages = (1..=terms.len()).filter_map(|count| {
        let standing = terms.get(..count)?;
        let left = fitted(&standing.iter().collect::<Vec<_>>());
        Some(Stage {
            entered: standing.last()?.cause,
            standing: standing.iter().map(|term| term.cause).collect(),
            shapes: standing
                .iter()
                .map(|term| (term.shape.clone(), term.onset_s))
                .collect(),
            residual: usable_rms(problem, &left.residual),
        })
    });
    let stages: Vec<Stage> = stages.collect();
    Selection {
        found,
        too_small: Vec::new(),
        stages,
        before,
        after,
        nominal,
    }
}
