//! This file quantifies a selection: detection limits, stability under the block bootstrap, and
//! parameters that are not identifiable.

mod intervals;

use crate::candidates::{causes, modelled_effort, realise, white_variants};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, dot, fit, free_columns, norm};
use crate::report::{NotSeen, NullDirection};
use crate::rules::{GATE_SHARE, GATE_Z, INCLUSION_REPLICATES, POWER_Z, TELLABLE};
use crate::selection::{Found, Selection, refs};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use rigproof_model::effects::linear;
use rigproof_spec::effect::Mechanism;
use std::collections::BTreeMap;

pub use intervals::{Intervals, intervals};

fn parameter_count(term: &Term) -> usize {
    linear(term.cause.mechanism) + term.numbers().len()
}

/// A parameter of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    /// A nuisance parameter of the plant.
    Nuisance(usize),
    /// A parameter of a term: the indices of both.
    Of(usize, usize),
}

/// The whitened derivative of the modelled effort with respect to one parameter.
struct Sensitivity {
    number: Number,
    values: Vec<f64>,
    /// The precision of the parameter without the recording.
    ridge: f64,
}

fn sensitivities(problem: &Problem, terms: &[&Term], selection: &Selection) -> Vec<Sensitivity> {
    let fitted = &selection.after;
    let mut columns = Vec::new();
    let mut redundant = fitted.redundant.iter();
    let mut coefficients = fitted.coefficients.iter().copied();
    for (index, column) in problem.nuisances.iter().enumerate() {
        coefficients.next();
        if redundant.next() == Some(&false) {
            columns.push(Sensitivity {
                number: Number::Nuisance(index),
                values: column.white.clone(),
                ridge: column.ridge(1.0),
            });
        }
    }
    for (index, term) in terms.iter().enumerate() {
        let mut own: Vec<f64> = term.known.clone().unwrap_or_default();
        if term.known.is_none() {
            for (parameter, rows) in term.free.iter().enumerate() {
                own.push(coefficients.next().unwrap_or(0.0));
                if redundant.next() == Some(&false) {
                    columns.push(Sensitivity {
                        number: Number::Of(index, parameter),
                        values: rows.white.clone(),
                        ridge: rows.ridge(1.0),
                    });
                }
            }
            columns.extend(shape_sensitivities(problem, terms, selection, index, &own));
        }
    }
    columns
}

/// Relative step of the finite difference for a shape parameter.
const SHAPE_STEP: f64 = 1e-3;

fn shape_sensitivities(
    problem: &Problem,
    terms: &[&Term],
    selection: &Selection,
    index: usize,
    own: &[f64],
) -> Vec<Sensitivity> {
    let Some(term) = terms.get(index) else {
        return Vec::new();
    };
    // For a cause that moves the plant, the shape is only the step of a finite difference and not a
    // parameter.
    if problem.run.moves(term.cause) {
        return Vec::new();
    }
    let linear = linear(term.cause.mechanism);
    let effort = modelled_effort(problem, terms, &selection.after);
    let at = |shape: &[f64]| -> Option<Vec<f64>> {
        let moved = realise(problem, term.cause, shape, term.onset_s, &effort)?;
        let mut sum = vec![0.0; problem.windows.centres.len()];
        let scaled = own.iter().copied().zip(&moved.free);
        for (c, rows) in scaled.chain(moved.fixed.iter().map(|r| (1.0, r))) {
            crate::problem::add(&mut sum, &rows.white, c);
        }
        Some(sum)
    };
    (0..term.numbers().len())
        .filter_map(|k| {
            let step = SHAPE_STEP * term.shape.get(k)?.abs();
            let moved = |by: f64| {
                let mut shape = term.shape.clone();
                if let Some(value) = shape.get_mut(k) {
                    *value += by;
                }
                at(&shape)
            };
            let (ahead, behind) = (moved(step)?, moved(-step)?);
            let values = ahead
                .iter()
                .zip(&behind)
                .map(|(a, b)| (a - b) / (2.0 * step))
                .collect();
            Some(Sensitivity {
                number: Number::Of(index, linear + k),
                values,
                ridge: 0.0,
            })
        })
        .collect()
}

fn without(found: &[Found], index: usize) -> Vec<Found> {
    let others = found.iter().enumerate().filter(|(k, _)| *k != index);
    others.map(|(_, f)| f.clone()).collect()
}

/// Share of block-bootstrap replicates in which a found mechanism still reduces the left-out loss
/// by a relevant share.
pub fn inclusion(problem: &Problem, selection: &Selection, index: usize) -> f64 {
    let blocks = Blocks::new(problem);
    let others = without(&selection.found, index);
    let bare = fit(problem, &refs(&selection.nominal, &others), &blocks);
    let pairs: Vec<(f64, f64)> = bare
        .block_loss
        .iter()
        .copied()
        .zip(selection.after.block_loss.iter().copied())
        .collect();
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let passed = (0..INCLUSION_REPLICATES)
        .filter(|_| {
            let (mut before, mut after) = (0.0, 0.0);
            for _ in 0..pairs.len() {
                let drawn = (random.next_u64() % pairs.len() as u64) as usize;
                let (b, a) = pairs.get(drawn).copied().unwrap_or_default();
                before += b;
                after += a;
            }
            after < (1.0 - GATE_SHARE) * before
        })
        .count();
    passed as f64 / INCLUSION_REPLICATES as f64
}

/// The detection limit of every mechanism that was not named.
pub fn not_seen(problem: &Problem, selection: &Selection) -> Vec<NotSeen> {
    let (motion, driving) = (problem.run.motion_kind(), problem.run.driven_by());
    let terms = refs(&selection.nominal, &selection.found);
    let taken: Vec<Cause> = terms.iter().map(|t| t.cause).collect();
    let basis: Vec<&[f64]> = free_columns(problem, &terms)
        .iter()
        .map(|r| r.white.as_slice())
        .collect();
    let basis = orthonormal(&basis);
    causes(problem)
        .into_par_iter()
        .filter(|cause| !taken.contains(cause))
        .filter_map(|cause| {
            let tried = white_variants(problem, cause, &terms, &selection.after);
            let least = |t: &Term| least_size(t, &basis, selection.after.loss);
            let minimum = tried.iter().filter_map(least).fold(f64::INFINITY, f64::min);
            let parameter = cause.mechanism.parameters().first()?;
            minimum.is_finite().then(|| NotSeen {
                mechanism: cause.mechanism.name(),
                joint: problem.run.place_name(cause.at),
                parameter: parameter.name,
                minimum_detectable: minimum,
                unit: parameter.quantity.driven(motion, driving).to_string(),
            })
        })
        .collect()
}

/// The detection limit of a term, as a value of its leading parameter.
fn least_size(term: &Term, basis: &[Vec<f64>], loss: f64) -> Option<f64> {
    let (rows, unit) = match (&term.fixed, term.free.first()) {
        (Some(fixed), _) => (fixed, term.shape.first()?.abs()),
        (None, Some(free)) => (free, 1.0),
        (None, None) => return None,
    };
    let mut rest = rows.white.clone();
    for unit in basis {
        let along = dot(&rest, unit);
        for (x, u) in rest.iter_mut().zip(unit) {
            *x -= along * u;
        }
    }
    let own = norm(&rest);
    let needed = (GATE_Z + POWER_Z).max((GATE_SHARE * loss).sqrt());
    (own > TELLABLE * norm(&rows.white)).then(|| unit * needed / own)
}

fn orthonormal(columns: &[&[f64]]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let mut rest = column.to_vec();
        for unit in &basis {
            let along = dot(&rest, unit);
            for (x, u) in rest.iter_mut().zip(unit) {
                *x -= along * u;
            }
        }
        let own = norm(&rest);
        if own > 1e-9 * norm(column) {
            rest.iter_mut().for_each(|x| *x /= own);
            basis.push(rest);
        }
    }
    basis
}

/// Eigenvalue ratio below which a direction counts as not identifiable.
const NULL_RATIO: f64 = 1e-9;

/// Directions of the parameters that change nothing. For Bouc-Wen only the products of `β` with `γ`
/// and with `δ` enter the equation.
pub fn null_directions(problem: &Problem, selection: &Selection) -> Vec<NullDirection> {
    let terms = refs(&selection.nominal, &selection.found);
    let is_told = |term: &&Term| term.cause.mechanism == Mechanism::Hysteresis;
    if !terms.iter().any(is_told) {
        return Vec::new();
    }
    let columns = sensitivities(problem, &terms, selection);
    terms
        .iter()
        .enumerate()
        .filter(|(_, t)| is_told(t))
        .filter_map(|(index, term)| {
            let product = |parameter: usize| {
                let column = columns
                    .iter()
                    .find(|c| c.number == Number::Of(index, parameter))?;
                let value = term.shape.get(parameter - 1)?;
                Some(
                    column
                        .values
                        .iter()
                        .map(|x| x * value)
                        .collect::<Vec<f64>>(),
                )
            };
            // In relative changes, β changes both products, γ the first and δ the second.
            let (gamma, delta) = (product(1)?, product(2)?);
            let beta: Vec<f64> = gamma.iter().zip(&delta).map(|(g, d)| g + d).collect();
            smallest_direction(&["beta", "gamma", "delta"], &[beta, gamma, delta])
        })
        .collect()
}

fn smallest_direction(names: &[&str], columns: &[Vec<f64>]) -> Option<NullDirection> {
    let information = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
        match (columns.get(i), columns.get(j)) {
            (Some(a), Some(b)) => dot(a, b),
            _ => 0.0,
        }
    });
    let eigen = SymmetricEigen::new(information);
    let smallest = eigen.eigenvalues.imin();
    let ratio = eigen.eigenvalues.min().abs() / eigen.eigenvalues.max().max(1e-300);
    let column: DVector<f64> = eigen.eigenvectors.column(smallest).into();
    let sign = column
        .iter()
        .copied()
        .find(|x| x.abs() > 1e-6)
        .unwrap_or(1.0)
        .signum();
    let direction: BTreeMap<String, f64> = names
        .iter()
        .zip(column.iter())
        .map(|(name, x)| ((*name).to_owned(), sign * x))
        .collect();
    (ratio < NULL_RATIO).then(|| NullDirection {
        mechanism: Mechanism::Hysteresis.name(),
        direction,
        eigenvalue_ratio: ratio,
        meaning: "beta can be scaled up while gamma and delta are scaled down by the same factor without any change of the motion: only the products beta·gamma and beta·delta are determined".to_owned(),
    })
}

/// The parameters of a term in the vocabulary's order: linear ones from the fit, then the shape. A
/// spring's place of rest follows from its force at zero.
pub fn parameters(problem: &Problem, term: &Term, coefficients: &[f64]) -> Vec<f64> {
    let given = term.known.as_deref().unwrap_or(coefficients);
    let mechanism = term.cause.mechanism;
    if let (Mechanism::Spring, &[stiffness, level]) = (mechanism, given) {
        let stated = term.shape.first().copied().unwrap_or(0.0);
        // Where only the force at zero is determined, there is no place of rest.
        let away = if stiffness == 0.0 {
            0.0
        } else {
            level / stiffness
        };
        return vec![stiffness, stated - away];
    }
    let mut parameters = problem.run.linear(mechanism, given);
    // A zero that is fitted beside the law is none of its numbers. Of a law without a coefficient an
    // arm measures the shape itself.
    if linear(mechanism) > 0 {
        parameters.truncate(linear(mechanism));
    }
    parameters.extend_from_slice(term.numbers());
    parameters
}

/// The coefficients of the nuisance parameters, and those of each term of a selection, in order.
pub fn coefficients_by_term(problem: &Problem, selection: &Selection) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut values = selection.after.coefficients.iter().copied();
    let nuisances = values.by_ref().take(problem.nuisances.len()).collect();
    let terms = refs(&selection.nominal, &selection.found);
    let by_term = terms
        .iter()
        .map(|t| {
            if t.known.is_some() {
                Vec::new()
            } else {
                values.by_ref().take(t.free.len()).collect()
            }
        })
        .collect();
    (nuisances, by_term)
}

#[cfg(test)]
mod tests;
