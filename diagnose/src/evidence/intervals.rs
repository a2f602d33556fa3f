//! This file gives the found numbers their 95 % intervals, by leaving out one block of time after another.
//!
//! Residuals are neither white nor of one size where a law of another family stands in for the true one, and blocks are few: the jackknife over blocks is
//! on the safe side there (MacKinnon, Nielsen and Webb 2023), with Student's t of as many blocks as a number really lives in
//! (after Carter, Schnepel and Steigerwald 2017). Where more than noise is left the law is not the true one, and what is left may look like the effect everywhere
//! alike, which no block shows: there they are wider by what is left over the noise (Birge 1932), up to a bound: blocks show what is left by themselves.

use super::{Number, Sensitivity, coefficients_by_term, parameter_count, sensitivities};
use crate::filter::rms;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, covariance, dot};
use crate::rules::{LEAST_FREEDOM, TIMES_BY_FORM};
use crate::selection::{Selection, change_with_onset, onset_interval, refs, usable_rms};
use crate::student::half_width;
use nalgebra::{DMatrix, DVector};
use rigproof_spec::effect::Mechanism;

/// Half widths of the 95 % intervals of every parameter of every term, and of the plant's own numbers where they are estimated.
#[derive(Clone, Debug, Default)]
pub struct Intervals {
    /// Of the plant's own numbers; NaN where the recording does not determine one.
    pub nuisances: Vec<f64>,
    /// Of each term's parameters in the vocabulary's order; NaN where the recording does not determine one.
    pub terms: Vec<Vec<f64>>,
    /// The 95 % interval of each term's onset, s; `None` where it has none.
    pub onsets: Vec<Option<[f64; 2]>>,
}

/// 97.5 % of the normal distribution lie below.
const NORMAL: f64 = 1.959_963_984_540_054;

/// The intervals of a selection, shape parameters included through their sensitivities.
pub fn intervals(problem: &Problem, selection: &Selection) -> Intervals {
    let terms = refs(&selection.nominal, &selection.found);
    let columns = sensitivities(problem, &terms, selection);
    let white: Vec<&[f64]> = columns.iter().map(|c| c.values.as_slice()).collect();
    let residual = problem.whitener.whiten(&selection.after.residual);
    let halves = half_widths(&white, &residual, &Blocks::new(problem))
        .unwrap_or_else(|| vec![f64::NAN; white.len()]);
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

/// Of the nominal terms none has an onset.
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

/// How many times the variance of a term's onset grows with its shape unknown; `None` where it has none.
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
        covariance(&columns)?.get((0, 0)).copied()
    };
    let known = variance(columns.iter().filter(|column| !is_shape(column)).collect())?;
    let unknown = variance(columns.iter().collect())?;
    Some((unknown / known).max(1.0))
}

/// The standard deviation of what lies between two samples, in the unit of the term's parameters: a play ends somewhere on the way from one
/// sample to the next. 0 for any other mechanism.
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

/// Half widths of the coefficients' intervals, never less than white residuals of variance 1 would give; `None` where the columns are
/// not independent.
pub(super) fn half_widths(
    columns: &[&[f64]],
    residual: &[f64],
    blocks: &Blocks,
) -> Option<Vec<f64>> {
    let bread = covariance(columns)?;
    let whole = gram(columns, 0, residual.len());
    let ends = blocks.ranges.iter().skip(1).map(|(first, _)| *first);
    let firsts = blocks.ranges.iter().map(|(first, _)| *first);
    // What lies between two blocks belongs to the one before: here nothing is left out.
    let departures: Vec<DVector<f64>> = firsts
        .zip(ends.chain([residual.len()]))
        .map(|(first, end)| {
            let score = scores(columns, residual, first, end);
            let rest = (&whole - gram(columns, first, end)).cholesky();
            // Where a number lives in this block alone nothing is left without it.
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
        let white = bread.get((k, k)).map_or(f64::NAN, |v| v.max(0.0).sqrt());
        let scatter = half_width(jackknife, freedom(columns.get(k), blocks));
        scatter.unwrap_or_default().max(NORMAL * white)
    });
    Some(halves.collect())
}

/// Blocks that a column lives in, as many as of equal energy would be as uneven, less one.
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
