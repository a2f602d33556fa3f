//! This file searches for onsets: a term of an explanation that begins in the middle of a
//! recording.

use super::fitted::{Fitted, Folds};
use super::score::{Judge, gives_energy};
use super::unfitted;
use crate::problem::{Problem, Term};
use crate::rules::{BEAM, LATE, ONSET_GRID, ONSET_HALVINGS, ONSET_MARGIN};
use rayon::prelude::*;

/// An explanation in which one term begins at `share` of the recording.
struct Begun {
    evidence: f64,
    share: f64,
    fitted: Fitted,
}

/// Explanations in which one term has an onset.
///
/// Onsets are tried on a grid for every single cause and for the leading explanations. The best of
/// these are refined between the points of the grid.
pub fn late(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    ranked: &[Fitted],
) -> Vec<Fitted> {
    let tried = |own: &Fitted, index: usize, share: f64| {
        begun(problem, folds, judge, bare, &own.terms, index, share)
    };
    let open = ranked.iter().enumerate();
    let open = open.filter(|(place, own)| own.terms.len() == 1 || *place < LATE);
    let places: Vec<(&Fitted, usize)> = open
        .flat_map(|(_, own)| (0..own.terms.len()).map(move |index| (own, index)))
        .collect();
    let on_grid = places.into_par_iter().filter_map(|(own, index)| {
        let grid = (1..ONSET_GRID).map(|k| k as f64 / ONSET_GRID as f64);
        let all = grid.filter_map(|share| tried(own, index, share));
        let best = all.max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
        Some((own, index, best))
    });
    let mut on_grid: Vec<(&Fitted, usize, Begun)> = on_grid.collect();
    on_grid.sort_by(|a, b| b.2.evidence.total_cmp(&a.2.evidence));
    on_grid.truncate(BEAM);
    let placed = on_grid.into_par_iter().map(|(own, index, mut best)| {
        let mut stride = 0.5 / ONSET_GRID as f64;
        for _ in 0..ONSET_HALVINGS {
            for share in [best.share - stride, best.share + stride] {
                let moved = tried(own, index, share);
                best = moved
                    .filter(|moved| moved.evidence > best.evidence)
                    .unwrap_or(best);
            }
            stride *= 0.5;
        }
        best.fitted
    });
    placed.collect()
}

fn begun(
    problem: &Problem,
    folds: &Folds,
    judge: &Judge,
    bare: &Fitted,
    terms: &[Term],
    index: usize,
    share: f64,
) -> Option<Begun> {
    if !(ONSET_MARGIN..1.0 - ONSET_MARGIN).contains(&share) {
        return None;
    }
    let clock = problem.run.clock();
    let onset_s = clock.start_s + share * clock.duration_s();
    let mut terms = terms.to_vec();
    let own = terms.get_mut(index)?;
    *own = unfitted(problem, own.cause, &own.shape, Some(onset_s))?;
    let fitted = bare.of(folds, &terms);
    let evidence = judge.evidence(folds, &fitted);
    (!gives_energy(problem, &fitted)).then_some(Begun {
        evidence,
        share,
        fitted,
    })
}
