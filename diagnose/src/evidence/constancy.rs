//! This file asks whether what was named is the same all along the recording, where more than noise is left beside it.
//!
//! A test of parameter constancy (Chow 1960, Hansen 1992): if the leading number of a name may differ from one short part of the
//! recording to the next and much of what is unexplained goes away with that, what was named is not one thing with one number: a
//! delay that swings, a constant torque that comes only with the motion.

use super::{Number, sensitivities};
use crate::cause::Cause;
use crate::problem::Problem;
use crate::regression::dot;
use crate::rules::{INCONSTANT_OWN_SHARE, INCONSTANT_SHARE, PART_S, ROWS_A_NUMBER};
use crate::select::{
    Selection, bends, elementary as elementary_mechanisms, floor_limit, is_elementary_friction,
    refs, usable_rms,
};
use nalgebra::{DMatrix, DVector};
use rigproof_model::effects::{Drive, Form, entry};
use rigproof_spec::effect::Mechanism;

/// The found mechanisms whose leading number is not constant along the recording; none where nothing but noise is left.
pub fn inconstant(problem: &Problem, selection: &Selection) -> Vec<Cause> {
    let ratio = usable_rms(problem, &selection.after.residual) / problem.floor;
    if ratio <= floor_limit(problem) || selection.found.is_empty() {
        return Vec::new();
    }
    let unexplained = 1.0 - 1.0 / (ratio * ratio);
    let terms = refs(&selection.nominal, &selection.found);
    let columns = sensitivities(problem, &terms, selection);
    let residual = problem.whitener.whiten(&selection.after.residual);
    let gone = |column: &[f64]| gone(problem, &[column], &residual);
    let elementary = elementary(problem)
        .iter()
        .map(|column| gone(column))
        .fold(0.0, f64::max);
    let least = (INCONSTANT_SHARE * unexplained).max(INCONSTANT_OWN_SHARE * elementary);
    let offset = selection.nominal.len();
    let found = selection.found.iter().enumerate();
    found
        .filter(|(_, found)| is_told_by_itself(found.term.cause.mechanism))
        .filter(|(_, found)| !is_beside_a_form(selection, found.term.cause))
        .filter(|(index, _)| {
            let leading = columns
                .iter()
                .find(|c| matches!(c.number, Number::Of(term, _) if term == offset + index));
            leading.is_some_and(|column| gone(&column.values) > least)
        })
        .map(|(_, found)| found.term.cause)
        .collect()
}

/// Whether plain friction stands beside a law that bends at its joint: what the form of that law lacks is along it, and differs with the motion.
fn is_beside_a_form(selection: &Selection, cause: Cause) -> bool {
    let mut found = selection.found.iter().map(|found| found.term.cause);
    is_elementary_friction(cause.mechanism)
        && found.any(|other| bends(other.mechanism) && other.at == cause.at)
}

/// Whether a mechanism's number acts without a memory. A memory of another family (Maxwell slip for a bristle) differs at every
/// reversal, which says nothing about its level.
pub fn is_told_by_itself(mechanism: Mechanism) -> bool {
    let Some(entry) = entry(mechanism) else {
        return false;
    };
    match entry.form {
        Form::Resistance(law) | Form::ShareOfBrake(law) => !law(&[1.0; 4]).remembers(),
        Form::Drive(Drive::Lag) | Form::Brake(_) => false,
        Form::Drive(Drive::Gain | Drive::Skew | Drive::Limit)
        | Form::Linkage(_)
        | Form::Sensor(_)
        | Form::Joint(_) => true,
    }
}

/// White columns of dry friction, drag and a constant effort at every place that moves by itself.
fn elementary(problem: &Problem) -> Vec<Vec<f64>> {
    let places = problem.run.moving_places();
    let causes = elementary_mechanisms()
        .into_iter()
        .flat_map(|mechanism| places.iter().map(move |at| Cause::at(mechanism, *at)));
    let terms = causes.filter_map(|cause| problem.term(cause, &[], None));
    terms
        .filter_map(|term| term.free.first().map(|rows| rows.white.clone()))
        .collect()
}

/// Share of the mean square of a white residual that goes when every part has coefficients of its own, freedoms counted.
fn gone(problem: &Problem, columns: &[&[f64]], residual: &[f64]) -> f64 {
    let windows = &problem.windows;
    let usable = &windows.usable;
    let a_part = (PART_S / (windows.hop as f64 * windows.step_s)) as usize;
    let rows = windows.outputs * a_part.max(1);
    let (mut explained, mut numbers, mut count) = (0.0, 0, 0);
    for first in (0..residual.len()).step_by(rows) {
        let end = (first + rows).min(residual.len());
        let own = |values: &[f64]| -> Vec<f64> {
            let pairs = (first..end).filter(|row| usable.get(*row) == Some(&true));
            pairs.filter_map(|row| values.get(row).copied()).collect()
        };
        let target = own(residual);
        count += target.len();
        if target.len() < ROWS_A_NUMBER * columns.len() {
            continue;
        }
        let parts: Vec<Vec<f64>> = columns.iter().map(|column| own(column)).collect();
        if let Some(along) = along(&parts, &target) {
            explained += along;
            numbers += columns.len();
        }
    }
    let total = dot(residual, residual).max(1e-300);
    let freedom = count.saturating_sub(numbers).max(1) as f64;
    1.0 - (total - explained) / freedom * count as f64 / total
}

/// Energy of a target along the span of some columns.
fn along(columns: &[Vec<f64>], target: &[f64]) -> Option<f64> {
    let unit: Vec<Vec<f64>> = columns
        .iter()
        .map(|column| {
            let length = dot(column, column).sqrt().max(1e-150);
            column.iter().map(|x| x / length).collect()
        })
        .collect();
    let entry = |i: usize, j: usize| match (unit.get(i), unit.get(j)) {
        (Some(a), Some(b)) => dot(a, b),
        _ => 0.0,
    };
    // A ridge, so that columns which are alike in a part do not decide.
    let gram = DMatrix::from_fn(unit.len(), unit.len(), |i, j| {
        entry(i, j) + if i == j { 1e-6 } else { 0.0 }
    });
    let moment = DVector::from_iterator(unit.len(), unit.iter().map(|u| dot(u, target)));
    Some(gram.cholesky()?.solve(&moment).dot(&moment))
}
