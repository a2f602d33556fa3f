//! This file explains a recording by sets of mechanisms, compared by cross-validation.
//!
//! Every set is granted the same model discrepancy, because no model is exact.

mod beam;
mod discrepancy;
mod explanations;
mod factor;
mod fitted;
mod folds;
mod late;
mod many;
mod refine;
mod score;
mod walk;

use crate::candidates::{all_causes, is_at_an_end};
use crate::cause::Cause;
use crate::problem::{Kept, Problem, Term};
use crate::regression::{Blocks, fit, free_columns, paired, reduced_target};
use crate::rules::{AS_ONE, BEAM, EXCHANGES, EXPLAINED_LEFT, LISTED, ROWS_A_SAMPLE};
use crate::selection::{Found, Selection, Stage, centred, refined, usable_rms};
use beam::Beam;
pub use explanations::{Explanation, Explanations, status};
use explanations::{is_form_of, kind};
use fitted::Fitted;
use folds::Folds;
use late::Late;
pub use many::explain_many;
use rayon::prelude::*;
use score::{Judge, prior};
use std::sync::Arc;

/// Explains a recording on top of the terms of its nominal model.
///
/// The noise of a round of search is what the best explanation of the round before leaves. Where a
/// round names nothing although it found what leaves much less, if need be with more terms, its
/// noise was unexplained physics, and another follows. The leading explanations of a round compete
/// in the next one.
pub fn explain(problem: &mut Problem, mut nominal: Vec<Term>) -> (Selection, Explanations) {
    let mut round = Round::of(problem, &nominal, problem.floor, ROWS_A_SAMPLE, 0, &[]);
    let living = loop {
        let rows_a_sample = round.rows_a_sample(problem);
        let left = round.leaves(problem, &nominal);
        let mut found = round.leading();
        problem.rewhiten(left);
        let terms = nominal.iter_mut().chain(found.iter_mut().flatten());
        terms.for_each(|term| problem.refresh(term));
        let noise = left.max(problem.floor);
        round = Round::of(problem, &nominal, noise, rows_a_sample, EXCHANGES, &found);
        let living = round.weighed(problem, noise);
        let names_nothing = living.first().is_none_or(|own| own.terms.is_empty());
        if names_nothing {
            round.all.append(&mut round.larger);
        }
        let least = round.leaves(problem, &nominal).max(problem.floor);
        if !names_nothing || least > EXPLAINED_LEFT * noise {
            break living;
        }
    };
    let likest = round.likest();
    let explanations = Explanations { living, likest }.led_by_the_sure();
    (selected(problem, nominal, &explanations), explanations)
}

/// One search among sets of terms, with everything that it fitted.
struct Round {
    folds: Folds,
    bare: Fitted,
    all: Vec<Fitted>,
    /// Sets of more terms. They compete but do not say what is noise: with all of them at hand, one
    /// leaves a little less in every recording.
    larger: Vec<Fitted>,
    /// Those in which a described law changes. They do not say what is noise either.
    changed: Vec<Fitted>,
}

impl Round {
    /// `noise` is the standard deviation of a row before whitening. `exchanges` counts the rounds
    /// in which terms are exchanged. `found` are sets of terms that compete in any case.
    fn of(
        problem: &Problem,
        nominal: &[Term],
        noise: f64,
        rows_a_sample: f64,
        exchanges: usize,
        found: &[Vec<Term>],
    ) -> Round {
        let folds = Folds::of(problem);
        let judge = Judge::of(problem, noise, rows_a_sample);
        let common: Vec<&Term> = nominal.iter().collect();
        let target = reduced_target(problem, &common).white;
        let bare = Fitted::bare(&folds, &target, &free_columns(problem, &common));
        let tried = shapes_of(problem, nominal, true);
        let known = found.iter().map(|terms| bare.of(&folds, terms)).collect();
        let beam = Beam {
            problem,
            folds: &folds,
            judge: &judge,
            bare: &bare,
            tried: &tried,
        };
        let mut all = beam.search(exchanges, known);
        let leading = beam.by_score(all.clone());
        let late = Late {
            problem,
            folds: &folds,
            judge: &judge,
            bare: &bare,
        };
        let begun = late.found(&leading, &tried);
        let (mut larger, mut changed) = (Vec::new(), Vec::new());
        // The first round only says what is noise.
        if !found.is_empty() {
            larger = beam.larger(&leading);
            let leading = [leading, begun.clone()].concat();
            changed = late.changed(&leading, &tried, &shapes_of(problem, nominal, false));
            changed.retain(|own| !begun.iter().any(|other| own.is_like(other)));
        }
        all.extend(begun);
        Round {
            folds,
            bare,
            all,
            larger,
            changed,
        }
    }

    /// The cause that alone takes away most of what the nominal model leaves, and its share of that.
    fn likest(&self) -> Option<(Cause, f64)> {
        let alone = self.all.iter().filter(|own| own.terms.len() == 1);
        let best = alone.min_by(|a, b| a.left().total_cmp(&b.left()))?;
        let share = 1.0 - best.left() / self.bare.left().max(1e-300);
        Some((best.terms.first()?.cause, share))
    }

    fn predicts_best(&self) -> Option<&Fitted> {
        self.all.iter().min_by(|a, b| a.left().total_cmp(&b.left()))
    }

    /// The terms of the leading explanations without an onset, which stand first.
    fn leading(&self) -> Vec<Vec<Term>> {
        let from_start = |own: &&Fitted| own.terms.iter().all(|term| term.onset_s.is_none());
        let best = self.predicts_best().into_iter();
        let leading = best.chain(self.all.iter().take(BEAM)).filter(from_start);
        leading.map(|own| own.terms.clone()).collect()
    }

    /// What the best explanation leaves of the effort. The median block sets its level, so that a
    /// disturbance in a few blocks does not count as noise everywhere.
    fn leaves(&self, problem: &Problem, nominal: &[Term]) -> f64 {
        let best = self.predicts_best().map_or(&[][..], |own| &own.terms);
        let terms: Vec<&Term> = nominal.iter().chain(best).collect();
        let residual = fit(problem, &terms, &Blocks::new(problem)).residual;
        self.folds.typical(&residual)
    }

    fn rows_a_sample(&self, problem: &Problem) -> f64 {
        let best = self.predicts_best();
        let residual = best.map(|own| own.residual(&self.folds));
        discrepancy::rows_a_sample(problem, &self.folds, &residual.unwrap_or_default())
    }

    fn weighed(&self, problem: &Problem, noise: f64) -> Vec<Explanation> {
        let judge = Judge::of(problem, noise, self.rows_a_sample(problem));
        let Round {
            folds,
            bare,
            all,
            larger,
            changed,
        } = self;
        let possible = all.iter().chain(larger).chain(changed).filter(|own| {
            let mut terms = own.terms.iter();
            judge.all_matter(folds, bare, own) && !terms.any(|term| is_at_an_end(problem, term))
        });
        let possible = self.of_one_unit(problem, noise, possible.collect());
        let judged = possible.into_iter();
        let judged = judged.map(|own| Judged::of(judge.score(problem, folds, own), own));
        living(problem, folds.count(), judged.collect(), noise, LISTED)
    }

    /// The explanations by which the description has the units and signs of the recording, if one of
    /// them leaves little of the nominal model's residual and of the effort; else all.
    fn of_one_unit<'a>(
        &self,
        problem: &Problem,
        noise: f64,
        mut possible: Vec<&'a Fitted>,
    ) -> Vec<&'a Fitted> {
        let effort = self.folds.count() * (problem.effort_size / noise).powi(2);
        let least = EXPLAINED_LEFT * EXPLAINED_LEFT * self.bare.left().min(effort);
        let is_sound = |own: &&Fitted| !own.is_another_unit(problem);
        let explains = |own: &&Fitted| is_sound(own) && own.left() < least;
        if possible.iter().any(explains) {
            possible.retain(is_sound);
        }
        possible
    }
}

/// An explanation with its log posterior, up to a constant, before it is weighed.
#[derive(Clone)]
struct Judged {
    score: f64,
    /// Its squared residual over all left-out blocks.
    left: f64,
    terms: Vec<Term>,
}

impl Judged {
    fn of(score: f64, own: &Fitted) -> Judged {
        Judged {
            score,
            left: own.left(),
            terms: own.terms.clone(),
        }
    }
}

/// Explanations with their probability, the best first, without those below `least`. Of those whose
/// odds are those of the best but for rounding, the one whose causes stand first in the vocabulary
/// leads.
fn living(
    problem: &Problem,
    rows: f64,
    mut judged: Vec<Judged>,
    noise: f64,
    least: f64,
) -> Vec<Explanation> {
    judged.sort_by(|a, b| b.score.total_cmp(&a.score));
    let most = judged.first().map_or(0.0, |own| own.score);
    let equal = judged.partition_point(|own| most - own.score <= AS_ONE);
    let (equal, _) = judged.split_at_mut(equal);
    equal.sort_by_key(|own| sorted(own.terms.iter().map(|term| term.cause)));
    let sum: f64 = judged.iter().map(|own| libm::exp(own.score - most)).sum();
    let listed = judged.into_iter().map(|own| Explanation {
        weight: libm::exp(own.score - most) / sum,
        evidence: own.score - prior(problem, &own.terms),
        leaves: (own.left / rows).sqrt() * noise / problem.floor,
        terms: own.terms,
    });
    listed.filter(|own| own.weight >= least).collect()
}

/// Causes in the order of the vocabulary: the key of a set.
fn sorted(causes: impl Iterator<Item = Cause>) -> Vec<Cause> {
    let mut causes: Vec<Cause> = causes.collect();
    causes.sort();
    causes
}

/// The mechanisms in every shape of the grid: those that the nominal model does not leave open, or
/// those that it does.
fn shapes_of(problem: &Problem, nominal: &[Term], are_new: bool) -> Vec<Arc<Kept>> {
    let common: Vec<&Term> = nominal.iter().collect();
    let plain = fit(problem, &common, &Blocks::new(problem));
    let is_new = |cause: &Cause| {
        let mut own = nominal.iter().filter(|term| term.cause == *cause);
        own.all(|term| term.known.is_some())
    };
    let causes = all_causes(problem).into_iter();
    let open: Vec<Cause> = causes.filter(|own| is_new(own) == are_new).collect();
    let of_cause = |cause: Cause| -> Vec<Arc<Kept>> {
        let shapes = problem.run.shapes(cause, &problem.windows, &plain.residual);
        let tried = shapes.iter().filter_map(|shape| {
            let changed = || unfitted(problem, cause, shape, None).map(Kept::Whole);
            problem
                .kept(cause, shape)
                .or_else(|| changed().map(Arc::new))
        });
        tried.collect()
    };
    open.into_par_iter().flat_map_iter(of_cause).collect()
}

/// A term of a cause, with its columns taken from the recorded signals alone.
pub(crate) fn unfitted(
    problem: &Problem,
    cause: Cause,
    shape: &[f64],
    onset_s: Option<f64>,
) -> Option<Term> {
    let term = problem.term(cause, shape, onset_s);
    term.or_else(|| problem.drive_term(cause, shape, onset_s, &[]))
}

/// Terms with their shapes refined on all blocks. A change of the drive keeps the shape with which
/// it was compared.
fn polished(problem: &Problem, nominal: &[Term], terms: &[Term]) -> Vec<Term> {
    let blocks = Blocks::new(problem);
    let mut all = terms.to_vec();
    for index in 0..all.len() {
        let mut others = all.clone();
        let own = others.remove(index);
        if own.cause.is_of_drive() || own.shape.is_empty() && own.onset_s.is_none() {
            continue;
        }
        let common: Vec<&Term> = nominal.iter().chain(&others).collect();
        if let Some(slot) = all.get_mut(index) {
            let own = refined(problem, &common, own, &blocks);
            *slot = centred(problem, &common, &own).unwrap_or(own);
        }
    }
    all
}

/// The greatest share of the squared residual of one output that a term removes.
fn most_removed(problem: &Problem, without: &[f64], with: &[f64]) -> f64 {
    let outputs = problem.windows.outputs;
    let left = |residual: &[f64], output: usize| -> f64 {
        let rows = residual.iter().zip(&problem.windows.usable);
        let own = rows
            .skip(output)
            .step_by(outputs)
            .filter(|(_, usable)| **usable);
        own.map(|(row, _)| row * row).sum()
    };
    let removed = (0..outputs).map(|k| 1.0 - left(with, k) / left(without, k).max(1e-300));
    removed.fold(0.0, f64::max)
}

/// The leading explanation as a `Selection`.
fn selected(problem: &Problem, nominal: Vec<Term>, explanations: &Explanations) -> Selection {
    let blocks = Blocks::new(problem);
    let leading = explanations.living.first();
    let terms = leading.map_or(Vec::new(), |own| polished(problem, &nominal, &own.terms));
    let fitted = |terms: &[&Term]| {
        let all: Vec<&Term> = nominal.iter().chain(terms.iter().copied()).collect();
        fit(problem, &all, &blocks)
    };
    let (before, after) = (fitted(&[]), fitted(&terms.iter().collect::<Vec<_>>()));
    let found: Vec<Found> = terms
        .iter()
        .enumerate()
        .map(|(index, term)| {
            let others = terms.iter().enumerate().filter(|(k, _)| *k != index);
            let without = fitted(&others.map(|(_, own)| own).collect::<Vec<_>>());
            let same = terms.iter().take(index);
            let before = same.filter(|own| own.cause == term.cause).count();
            let even = vec![1.0; without.block_loss.len()];
            let (gain, z) = paired(&without.block_loss, &after.block_loss, &even);
            let share = match problem.rules.many {
                true => most_removed(problem, &without.residual, &after.residual),
                false => gain / without.left_out().max(1e-300),
            };
            Found {
                term: term.clone(),
                z,
                share,
                probability: explanations.probability(term.cause, before + 1),
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
        stages,
        before,
        after,
        nominal,
    }
}
