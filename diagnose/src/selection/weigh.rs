//! This file evaluates one term in a fit: its coefficients, its contribution, its loss.

use super::floor_limit;
use crate::candidates::modelled_effort;
use crate::filter;
use crate::problem::{Problem, Term, add};
use crate::regression::{Blocks, Fit, fit, loss_of};
use crate::rules::RELINEARISE;

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

/// The whitened contribution of a term, row by row.
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

/// Root mean square over the usable windows.
pub fn usable_rms(problem: &Problem, values: &[f64]) -> f64 {
    filter::usable_rms(values, &problem.windows.usable)
}

/// Whether a fit leaves nothing but sensor noise.
pub fn is_noise(problem: &Problem, fitted: &Fit) -> bool {
    usable_rms(problem, &fitted.residual) <= floor_limit(problem) * problem.floor
}

/// The loss over all blocks with one more term.
pub(super) fn loss_with(problem: &Problem, common: &[&Term], term: &Term) -> f64 {
    let mut terms = common.to_vec();
    terms.push(term);
    loss_of(problem, &terms)
}

/// The effort of the other terms beside a change of the drive: the point about which the change is
/// linearised.
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
