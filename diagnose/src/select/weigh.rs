//! This file weighs one mechanism in a fit: its coefficients, its contribution, its sign.

use super::{Found, floor_limit};
use crate::candidates::modelled_effort;
use crate::filter::rms;
use crate::problem::{Problem, Term, add};
use crate::regression::{Blocks, Fit, dot, fit, loss_of};
use crate::rules::RELINEARISE;
use rigproof_model::effects::entry;

/// The coefficients of the last term of a fit.
pub(super) fn own_coefficients<'f>(term: &Term, fitted: &'f Fit) -> &'f [f64] {
    let count = if term.known.is_some() {
        0
    } else {
        term.free.len()
    };
    let first = fitted.coefficients.len().saturating_sub(count);
    fitted.coefficients.get(first..).unwrap_or_default()
}

/// The coefficients of one found mechanism in the fit of all of them.
pub(super) fn coefficients_of<'f>(found: &[Found], index: usize, fitted: &'f Fit) -> &'f [f64] {
    let later: usize = found.iter().skip(index).map(|f| f.term.free.len()).sum();
    let count = found.get(index).map_or(0, |f| f.term.free.len());
    let first = fitted.coefficients.len().saturating_sub(later);
    fitted
        .coefficients
        .get(first..first + count)
        .unwrap_or_default()
}

/// Root-mean-square effort that a term contributes over the usable windows, N or N·m.
pub(super) fn contribution(problem: &Problem, term: &Term, coefficients: &[f64]) -> f64 {
    let mut sum = vec![0.0; problem.target.raw.len()];
    let columns = coefficients.iter().copied().zip(&term.free);
    for (c, rows) in columns.chain(term.fixed.iter().map(|rows| (1.0, rows))) {
        for (s, x) in sum.iter_mut().zip(&rows.raw) {
            *s += c * x;
        }
    }
    usable_rms(problem, &sum)
}

/// What a term contributes, white, row by row.
pub(super) fn acting(term: &Term, coefficients: &[f64]) -> Vec<f64> {
    let length = term
        .free
        .first()
        .or(term.fixed.as_ref())
        .map_or(0, |rows| rows.white.len());
    let mut sum = vec![0.0; length];
    let columns = coefficients.iter().copied().zip(&term.free);
    for (c, rows) in columns.chain(term.fixed.iter().map(|rows| (1.0, rows))) {
        add(&mut sum, &rows.white, c);
    }
    sum
}

/// White energy that a term contributes in each block: the gain that can be expected there.
pub(super) fn excitation(term: &Term, coefficients: &[f64], blocks: &Blocks) -> Vec<f64> {
    let sum = acting(term, coefficients);
    let blocks = blocks.ranges.iter();
    blocks
        .map(|&(first, end)| sum.get(first..end).map_or(0.0, |part| dot(part, part)))
        .collect()
}

/// Root mean square over the usable windows.
pub fn usable_rms(problem: &Problem, values: &[f64]) -> f64 {
    let usable: Vec<f64> = values
        .iter()
        .zip(&problem.windows.usable)
        .filter(|(_, u)| **u)
        .map(|(v, _)| *v)
        .collect();
    rms(&usable)
}

/// Whether a fit leaves nothing but sensor noise.
pub fn is_noise(problem: &Problem, fitted: &Fit) -> bool {
    usable_rms(problem, &fitted.residual) <= floor_limit(problem) * problem.floor
}

/// Whether a passive mechanism came out with a sign that gives energy.
pub(super) fn drives(term: &Term, own: &[f64]) -> bool {
    // Beyond the law's own numbers stands what goes with them, such as the rest angle of a spring: that has either sign.
    let passive = entry(term.cause.mechanism).filter(|entry| entry.passive);
    passive.is_some_and(|entry| own.iter().take(entry.linear).any(|c| *c < 0.0))
}

/// Whether a passive mechanism would come out with a sign that gives energy beside these terms.
pub fn gives_energy(problem: &Problem, common: &[&Term], term: &Term, blocks: &Blocks) -> bool {
    let mut terms = common.to_vec();
    terms.push(term);
    let fitted = fit(problem, &terms, blocks);
    drives(term, own_coefficients(term, &fitted))
}

/// Loss over all blocks with one more term.
pub(super) fn loss_with(problem: &Problem, common: &[&Term], term: &Term) -> f64 {
    let mut terms = common.to_vec();
    terms.push(term);
    loss_of(problem, &terms)
}

/// What the other terms give when a change of the drive stands beside them: the point to linearise about.
pub(super) fn effort_beside(
    problem: &Problem,
    common: &[&Term],
    drive: &Term,
    blocks: &Blocks,
) -> Option<Vec<f64>> {
    if !problem.run.is_linearised() {
        return None;
    }
    drive.fixed.as_ref()?;
    let mut term = drive.clone();
    let mut effort = Vec::new();
    for _ in 0..RELINEARISE {
        let mut terms = common.to_vec();
        terms.push(&term);
        let fitted = fit(problem, &terms, blocks);
        effort = modelled_effort(problem, common, &fitted);
        term = problem.drive_term(term.cause, &term.shape, term.onset_s, &effort)?;
    }
    Some(effort)
}
