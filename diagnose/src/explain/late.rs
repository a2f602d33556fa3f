//! This file looks for what begins in the middle of a recording: each term of an explanation from an onset on.

use super::fitted::{Fitted, Folds};
use super::score::{Judge, gives_energy};
use super::unfitted;
use crate::problem::{Problem, Term};
use crate::rules::{ONSET_GRID, ONSET_HALVINGS, ONSET_MARGIN};
use rayon::prelude::*;

/// For each term of each explanation, the explanation with this term from its best onset on.
pub fn late(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    leading: &[Fitted],
) -> Vec<Fitted> {
    let places = leading.iter().flat_map(|own| {
        let open = own.terms.iter().enumerate();
        let open = open.filter(|(_, term)| term.onset_s.is_none());
        open.map(move |(index, _)| (own, index))
    });
    let places: Vec<(&Fitted, usize)> = places.collect();
    let placed = places.into_par_iter();
    placed
        .filter_map(|(own, index)| from_best(problem, folds, judge, bare, own, index))
        .collect()
}

/// The explanation with one term from the onset on that predicts best: on a grid first, then between its neighbours.
fn from_best(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    own: &Fitted,
    index: usize,
) -> Option<Fitted> {
    let clock = problem.run.clock();
    let tried = |share: f64| {
        let inside = (ONSET_MARGIN..1.0 - ONSET_MARGIN).contains(&share);
        let onset_s = clock.start_s + share * clock.duration_s();
        let terms = begun(problem, &own.terms, index, onset_s).filter(|_| inside)?;
        let fitted = bare.of(folds, &terms);
        (!gives_energy(&fitted)).then(|| (judge.evidence(folds, &fitted), share, fitted))
    };
    let grid = (1..ONSET_GRID).filter_map(|k| tried(k as f64 / ONSET_GRID as f64));
    let mut best = grid.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut stride = 0.5 / ONSET_GRID as f64;
    for _ in 0..ONSET_HALVINGS {
        let around = [-stride, stride];
        let around = around.into_iter().filter_map(|by| tried(best.1 + by));
        if let Some(better) = around
            .filter(|own| own.0 > best.0)
            .max_by(|a, b| a.0.total_cmp(&b.0))
        {
            best = better;
        }
        stride *= 0.5;
    }
    Some(best.2)
}

fn begun(problem: &Problem, terms: &[Term], index: usize, onset_s: f64) -> Option<Vec<Term>> {
    let mut terms = terms.to_vec();
    let own = terms.get_mut(index)?;
    *own = unfitted(problem, own.cause, &own.shape, Some(onset_s))?;
    Some(terms)
}
