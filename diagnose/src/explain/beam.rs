//! This file searches among sets of terms with a beam: several explanations stay alive at once, so
//! that the order in which terms enter decides nothing.

use super::are_forms;
use super::fitted::{Fitted, Folds};
use super::refine::refined;
use super::score::{Judge, is_impossible};
use crate::problem::{Problem, Term};
use crate::rules::{BEAM, KEPT, MOST_TERMS};
use rayon::prelude::*;
use std::collections::BTreeMap;

type Names = Vec<String>;

/// Every explanation that was kept, one for each set of causes, the best evidence first. The
/// leading ones of each size have refined shapes.
pub fn search(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    tried: &[Term],
    exchanges: usize,
) -> Vec<Fitted> {
    let mut kept: BTreeMap<Names, Fitted> = BTreeMap::from([(Names::new(), bare.clone())]);
    let mut living = vec![bare.clone()];
    for size in 1..=MOST_TERMS {
        // All single causes are kept. A cause that begins late may explain nothing when it is
        // fitted to the whole recording.
        let most = if size == 1 { usize::MAX } else { BEAM + KEPT };
        let ranked = children(problem, folds, judge, &living, tried, most);
        let (near, far) = ranked.split_at(ranked.len().min(BEAM));
        let near: Vec<Fitted> = near
            .par_iter()
            .map(|fitted| refined(problem, folds, judge, bare, fitted.clone()))
            .collect();
        let near = by_evidence(folds, judge, near);
        for fitted in near.iter().chain(far) {
            kept.insert(names(problem, &fitted.terms), fitted.clone());
        }
        living = near.into_iter().take(BEAM).collect();
    }
    for _ in 0..exchanges {
        let leading: Vec<Fitted> = kept.values().cloned().collect();
        let leading: Vec<Fitted> = by_evidence(folds, judge, leading)
            .into_iter()
            .take(BEAM)
            .collect();
        let exchanged = exchanged(problem, folds, judge, bare, &leading, tried);
        for fitted in exchanged {
            let names = names(problem, &fitted.terms);
            let evidence = judge.evidence(folds, &fitted);
            if kept
                .get(&names)
                .is_none_or(|own| judge.evidence(folds, own) < evidence)
            {
                kept.insert(names, fitted);
            }
        }
    }
    by_evidence(folds, judge, kept.into_values().collect())
}

/// The leading explanations with one term removed or exchanged, one for each set of causes. The
/// best of them have refined shapes.
fn exchanged(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    leading: &[Fitted],
    tried: &[Term],
) -> Vec<Fitted> {
    let fewer = leading.iter().flat_map(|own| {
        (0..own.terms.len()).map(|index| {
            let mut terms = own.terms.clone();
            terms.remove(index);
            bare.of(folds, &terms)
        })
    });
    let fewer: Vec<Fitted> = fewer.collect();
    let all = children(problem, folds, judge, &fewer, tried, KEPT);
    let (near, far) = all.split_at(all.len().min(BEAM));
    let near = near.par_iter();
    let near: Vec<Fitted> = near
        .map(|own| refined(problem, folds, judge, bare, own.clone()))
        .collect();
    near.into_iter()
        .chain(far.iter().cloned())
        .chain(fewer)
        .collect()
}

/// The best extension by one term for each set of causes, the best evidence first, at most so many.
///
/// Thousands of terms are tried on every parent. Only what is kept is fitted twice, so that the
/// fits of all of them are never in memory together.
fn children(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    living: &[Fitted],
    tried: &[Term],
    most: usize,
) -> Vec<Fitted> {
    let mut best: BTreeMap<Names, (f64, &Fitted, &Term)> = BTreeMap::new();
    for parent in living {
        let open = tried
            .par_iter()
            .filter(|term| may_join(&parent.terms, term));
        let scored = open.filter_map(|term| {
            let fitted = parent.with(folds, term);
            let evidence = || judge.evidence(folds, &fitted);
            (!is_impossible(problem, &fitted)).then(|| (evidence(), term))
        });
        let own: Vec<(f64, &Term)> = scored.collect();
        for (evidence, term) in own {
            let names = names(problem, parent.terms.iter().chain([term]));
            if best.get(&names).is_none_or(|(other, ..)| evidence > *other) {
                best.insert(names, (evidence, parent, term));
            }
        }
    }
    let mut all: Vec<(f64, &Fitted, &Term)> = best.into_values().collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.truncate(most);
    all.into_par_iter()
        .map(|(_, parent, term)| parent.with(folds, term))
        .collect()
}

fn by_evidence(folds: &Folds, judge: &Judge, all: Vec<Fitted>) -> Vec<Fitted> {
    let mut all: Vec<(f64, Fitted)> = all
        .into_iter()
        .map(|fitted| (judge.evidence(folds, &fitted), fitted))
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().map(|(_, fitted)| fitted).collect()
}

/// Whether a term may be added. A cause enters once at each place, in one form: a second one would
/// only correct the shape of the first.
pub fn may_join(terms: &[Term], term: &Term) -> bool {
    let same = |own: &Term| {
        own.cause.at == term.cause.at && are_forms(own.cause.mechanism, term.cause.mechanism)
    };
    !terms.iter().any(same)
}

/// The sorted names of the causes: the key of a set.
pub fn names<'a>(problem: &Problem, terms: impl IntoIterator<Item = &'a Term>) -> Names {
    let mut names: Names = terms
        .into_iter()
        .map(|term| problem.run.cause_name(term.cause))
        .collect();
    names.sort();
    names
}
