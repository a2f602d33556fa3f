//! This file computes 95 % intervals of the fitted parameters, by a jackknife over blocks of time.
//!
//! Residuals are neither white nor of equal variance where an approximate law replaces the true
//! one, and there are few blocks. The block jackknife is conservative in that case (MacKinnon,
//! Nielsen and Webb 2023). Student's t takes as many degrees of freedom as there are blocks that
//! determine the parameter (after Carter, Schnepel and Steigerwald 2017).
//!
//! A residual larger than noise shows that the law is not exact. Its error may be the same in every
//! block, so that no jackknife shows it. The intervals are therefore widened by the ratio of
//! residual to noise (Birge 1932), up to a bound.

use super::{Number, Sensitivity, coefficients_by_term, parameter_count, sensitivities};
use crate::candidates::{searched, shape_bounds};
use crate::filter::rms;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, covariance, dot};
use crate::rules::{LEAST_FREEDOM, TIMES_BY_FORM};
use crate::selection::{Selection, change_with_onset, onset_interval, refs, usable_rms};
use crate::student::half_width;
use nalgebra::{DMatrix, DVector};
use rigproof_spec::effect::Mechanism;

/// Half widths of the 95 % intervals of all parameters.
#[derive(Clone, Debug, Default)]
pub struct Intervals {
    /// Of the nuisance parameters; NaN where the recording does not determine one.
    pub nuisances: Vec<f64>,
    /// Of each term's parameters, in the vocabulary's order; NaN where the recording does not
    /// determine one.
    pub terms: Vec<Vec<f64>>,
    /// The 95 % interval of each term's onset, s; `None` without an onset.
    pub onsets: Vec<Option<[f64; 2]>>,
}

/// The 97.5 % quantile of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

/// The intervals of a selection. Shape parameters enter through their sensitivities.
pub fn intervals(problem: &Problem, selection: &Selection) -> Intervals {
    let terms = refs(&selection.nominal, &selection.found);
    let residual = problem.whitener.whiten(&selection.after.residual);
    let mut columns = sensitivities(problem, &terms, selection);
    let mut halves = halves_of(problem, &columns, &residual);
    let is_given = |(column, half): (&Sensitivity, &f64)| match column.number {
        Number::Of(term, parameter) => terms
            .get(term)
            .is_some_and(|term| is_given(problem, term, parameter, *half)),
        Number::Nuisance(_) => false,
    };
    let given: Vec<bool> = columns.iter().zip(&halves).map(is_given).collect();
    if given.contains(&true) {
        let mut given = given.into_iter();
        columns.retain(|_| given.next() != Some(true));
        halves = halves_of(problem, &columns, &residual);
    }
    let left = usable_rms(problem, &selection.after.residual) / problem.floor;
    let form = left.clamp(1.0, TIMES_BY_FORM);
    let mut intervals = Intervals {
        nuisances: vec![f64::NAN; problem.nuisances.len()],
        terms: terms
            .iter()
            .map(|t| vec![f64::NAN; parameter_count(t)])
            .collect(),
        onsets: onsets(problem, selection, &columns),
    };
    for (column, half) in columns.iter().zip(halves) {
        let half = form * half;
        match column.number {
            Number::Nuisance(index) => {
                if let Some(slot) = intervals.nuisances.get_mut(index) {
                    *slot = half;
                }
            }
            Number::Of(term, parameter) => {
                let untold = terms.get(term).map_or(0.0, |t| between_samples(problem, t));
                let half = half.hypot(NORMAL * untold);
                let own = intervals.terms.get_mut(term);
                if let Some(slot) = own.and_then(|t| t.get_mut(parameter)) {
                    *slot = half;
                }
            }
        }
    }
    intervals
}

fn halves_of(problem: &Problem, columns: &[Sensitivity], residual: &[f64]) -> Vec<f64> {
    let white: Vec<&[f64]> = columns.iter().map(|c| c.values.as_slice()).collect();
    let ridge: Vec<f64> = columns.iter().map(|c| c.ridge).collect();
    half_widths(&white, &ridge, residual, &Blocks::new(problem))
        .unwrap_or_else(|| vec![f64::NAN; white.len()])
}

/// Whether a shape number stands for the simpler law and is not determined: it ended at a bound, and
/// its interval is wider than the range in which it was looked for.
fn is_given(problem: &Problem, term: &Term, parameter: usize, half: f64) -> bool {
    // A law may have a column more than linear parameters: that of its unknown zero.
    if parameter < term.free.len() {
        return false;
    }
    let shape = parameter.checked_sub(parameter_count(term) - term.numbers().len());
    shape.is_some_and(|shape| {
        let bounds = shape_bounds(problem, term.cause, &term.shape);
        let range = bounds.get(shape).map_or(0.0, |(low, high)| high - low);
        half > range && !searched(problem, term).any(|own| own == shape)
    })
}

/// Nominal terms have no onset.
fn onsets(
    problem: &Problem,
    selection: &Selection,
    columns: &[Sensitivity],
) -> Vec<Option<[f64; 2]>> {
    let first = selection.nominal.len();
    let found = (0..selection.found.len()).map(|index| {
        let imitated = imitated(problem, selection, first + index, columns).unwrap_or(1.0);
        onset_interval(problem, selection, index, imitated)
    });
    vec![None; first].into_iter().chain(found).collect()
}

/// The factor by which an unknown shape increases the variance of a term's onset; `None` without an
/// onset.
fn imitated(
    problem: &Problem,
    selection: &Selection,
    term: usize,
    columns: &[Sensitivity],
) -> Option<f64> {
    let terms = refs(&selection.nominal, &selection.found);
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let own = terms.get(term)?;
    let onset = change_with_onset(problem, own, coefficients.get(term)?)?;
    let is_shape = |column: &&Sensitivity| matches!(column.number, Number::Of(of, parameter) if of == term && parameter >= own.free.len());
    let variance = |others: Vec<&Sensitivity>| {
        let others = others.into_iter().map(|column| column.values.as_slice());
        let columns: Vec<&[f64]> = [onset.as_slice()].into_iter().chain(others).collect();
        covariance(&columns, &[])?.get((0, 0)).copied()
    };
    let known = variance(columns.iter().filter(|column| !is_shape(column)).collect())?;
    let unknown = variance(columns.iter().collect())?;
    Some((unknown / known).max(1.0))
}

/// The standard deviation that sampling adds, in the unit of the term's parameters: a backlash ends
/// somewhere between two samples. 0 for other mechanisms.
fn between_samples(problem: &Problem, term: &Term) -> f64 {
    if term.cause.mechanism != Mechanism::BacklashWidth {
        return 0.0;
    }
    let (motion, step_s) = (
        problem.run.motion(term.cause.at),
        problem.run.clock().step_s,
    );
    let moving = motion.iter().filter(|now| now.sense.abs() >= 1.0);
    let speeds: Vec<f64> = moving.map(|now| now.speed).collect();
    rms(&speeds) * step_s / 12f64.sqrt()
}

/// Half widths of the coefficients' intervals, at least those for white residuals of variance 1;
/// NaN where a coefficient is not determined. `ridge` is the precision of each without the
/// recording. `None` if the columns are linearly dependent.
pub(super) fn half_widths(
    columns: &[&[f64]],
    ridge: &[f64],
    residual: &[f64],
    blocks: &Blocks,
) -> Option<Vec<f64>> {
    let bread = covariance(columns, ridge)?;
    let known = DMatrix::from_diagonal(&DVector::from_column_slice(ridge));
    let whole = gram(columns, 0, residual.len()) + known;
    let ends = blocks.ranges.iter().skip(1).map(|(first, _)| *first);
    let firsts = blocks.ranges.iter().map(|(first, _)| *first);
    // The gap between two blocks is added to the block before it, because nothing is fitted without
    // it.
    let departures: Vec<DVector<f64>> = firsts
        .zip(ends.chain([residual.len()]))
        .map(|(first, end)| {
            let score = scores(columns, residual, first, end);
            let rest = (&whole - gram(columns, first, end)).cholesky();
            // If only this block determines a parameter, the fit without it is singular.
            rest.map_or_else(|| &bread * &score, |rest| rest.solve(&score))
        })
        .collect();
    let count = departures.len() as f64;
    let halves = (0..columns.len()).map(|k| {
        let own: Vec<f64> = departures
            .iter()
            .filter_map(|d| d.get(k))
            .map(|d| d * d)
            .collect();
        let jackknife = ((count - 1.0) / count * own.iter().sum::<f64>()).sqrt();
        let variance = bread.get((k, k)).copied().unwrap_or(f64::NAN);
        let scatter = half_width(jackknife, freedom(columns.get(k), blocks)).unwrap_or_default();
        // A variance of rounding errors is not of the parameter, and `max` would pass over NaN.
        match variance > 0.0 && jackknife.is_finite() {
            true => scatter.max(NORMAL * variance.sqrt()),
            false => f64::NAN,
        }
    });
    Some(halves.collect())
}

/// Degrees of freedom of a column: the effective number of blocks that hold its energy, less one.
fn freedom(column: Option<&&[f64]>, blocks: &Blocks) -> f64 {
    let column = column.copied().unwrap_or_default();
    let energies = blocks.ranges.iter().map(|&(first, end)| {
        let own = column.get(first..end).unwrap_or_default();
        dot(own, own)
    });
    let (sum, squares) = energies.fold((0.0, 0.0), |(s, q), e| (s + e, q + e * e));
    (sum * sum / squares.max(1e-300) - 1.0).max(LEAST_FREEDOM)
}

fn gram(columns: &[&[f64]], first: usize, end: usize) -> DMatrix<f64> {
    let part = |k: usize| {
        columns
            .get(k)
            .and_then(|c| c.get(first..end))
            .unwrap_or_default()
    };
    DMatrix::from_fn(columns.len(), columns.len(), |i, j| dot(part(i), part(j)))
}

fn scores(columns: &[&[f64]], residual: &[f64], first: usize, end: usize) -> DVector<f64> {
    let rest = residual.get(first..end).unwrap_or_default();
    let own = columns
        .iter()
        .map(|c| dot(c.get(first..end).unwrap_or_default(), rest));
    DVector::from_iterator(columns.len(), own)
}
