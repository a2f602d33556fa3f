//! This file is least squares on whitened windows, with cross-validation over contiguous blocks of
//! time.

use crate::problem::{Problem, Rows, Term};
use crate::rules::{BLOCK_S, FEWEST_BLOCKS, LEAST_WEIGHT, MOST_BLOCKS, OWN_OF_COLUMN, PURGE};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The blocks of cross-validation.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// Row ranges `(first, end)`. Windows in the gap between two blocks belong to neither, so that
    /// no sample is in both.
    pub ranges: Vec<(usize, usize)>,
}

impl Blocks {
    /// Equal blocks over all windows of a problem.
    pub fn new(problem: &Problem) -> Blocks {
        let outputs = problem.windows.outputs;
        let windows = problem.windows.centres.len() / outputs;
        let lasting = (problem.run.clock().duration_s() / BLOCK_S) as usize;
        let (count, purge) = match problem.windows.are_alone() {
            true => (FEWEST_BLOCKS, 0),
            false => {
                let count = lasting.clamp(FEWEST_BLOCKS, MOST_BLOCKS);
                (count, PURGE.min(windows / (4 * count)))
            }
        };
        let ranges = (0..count)
            .map(|b| (b * windows / count, (b + 1) * windows / count - purge))
            .map(|(first, end)| (outputs * first, outputs * end))
            .collect();
        Blocks { ranges }
    }
}

/// The fit of a set of terms.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The coefficient of each free column, nuisance parameters first, then term by term; 0 for a
    /// redundant column.
    pub coefficients: Vec<f64>,
    /// Whether each free column is redundant: linearly dependent on the earlier ones.
    pub redundant: Vec<bool>,
    /// Sum of squared white residuals over all windows.
    pub loss: f64,
    /// The loss of each block when the coefficients come from the other blocks.
    pub block_loss: Vec<f64>,
    /// Residual before whitening, one value per window.
    pub residual: Vec<f64>,
}

impl Fit {
    /// The summed loss of the left-out blocks.
    pub fn left_out(&self) -> f64 {
        self.block_loss.iter().sum()
    }
}

/// Normal equations of a range of windows.
#[derive(Clone)]
struct Normal {
    gram: DMatrix<f64>,
    moment: DVector<f64>,
    square: f64,
}

/// Fits the terms and cross-validates them over the blocks.
pub fn fit(problem: &Problem, terms: &[&Term], blocks: &Blocks) -> Fit {
    let columns = free_columns(problem, terms);
    let target = reduced_target(problem, terms);
    let redundant = redundancy(&columns);
    let own = Kept::of(&columns, &redundant, problem.rows_a_sample);
    let all = normal(&own.white, &target.white, 0, target.white.len());
    let solution = solve(&all, &own.ridge);
    let block_loss = block_losses(&own, &target.white, blocks);
    let mut values = solution.iter();
    let coefficients: Vec<f64> = redundant
        .iter()
        .map(|&r| {
            if r {
                0.0
            } else {
                values.next().copied().unwrap_or(0.0)
            }
        })
        .collect();
    let mut residual = target.raw;
    for (rows, c) in columns.iter().zip(&coefficients) {
        for (r, x) in residual.iter_mut().zip(&rows.raw) {
            *r -= c * x;
        }
    }
    Fit {
        coefficients,
        redundant,
        loss: loss(&all, &solution),
        block_loss,
        residual,
    }
}

/// The loss over all windows, without cross-validation.
pub fn loss_of(problem: &Problem, terms: &[&Term]) -> f64 {
    let columns = free_columns(problem, terms);
    let target = reduced_target(problem, terms);
    let redundant = redundancy(&columns);
    let own = Kept::of(&columns, &redundant, problem.rows_a_sample);
    let all = normal(&own.white, &target.white, 0, target.white.len());
    loss(&all, &solve(&all, &own.ridge))
}

/// The summed left-out loss of a white target with these columns.
pub fn left_out_loss(target: &[f64], columns: &[Rows], blocks: &Blocks) -> f64 {
    let columns: Vec<&Rows> = columns.iter().collect();
    let redundant = redundancy(&columns);
    let own = Kept::of(&columns, &redundant, 1.0);
    block_losses(&own, target, blocks).iter().sum()
}

/// All free columns: nuisance parameters first, then term by term.
pub fn free_columns<'b>(problem: &'b Problem, terms: &[&'b Term]) -> Vec<&'b Rows> {
    let of_terms = terms
        .iter()
        .filter(|t| t.known.is_none())
        .flat_map(|t| t.free.iter().map(Arc::as_ref));
    problem.nuisances.iter().chain(of_terms).collect()
}

/// The target less the columns with given coefficients, window by window.
pub fn reduced_target(problem: &Problem, terms: &[&Term]) -> Rows {
    let mut target = Rows {
        prior_deviation: f64::INFINITY,
        signal: Vec::new(),
        raw: problem.target.raw.clone(),
        white: problem.target.white.clone(),
    };
    for term in terms {
        let known = term.known.iter().flatten().copied().zip(&term.free);
        for (times, rows) in known.chain(term.fixed.iter().map(|rows| (1.0, rows))) {
            for (x, y) in target.raw.iter_mut().zip(&rows.raw) {
                *x -= times * y;
            }
            for (x, y) in target.white.iter_mut().zip(&rows.white) {
                *x -= times * y;
            }
        }
    }
    target
}

/// The columns that are not redundant.
struct Kept<'b> {
    white: Vec<&'b [f64]>,
    /// The precision of each coefficient without the recording.
    ridge: Vec<f64>,
}

impl<'b> Kept<'b> {
    fn of(columns: &[&'b Rows], redundant: &[bool], rows_a_sample: f64) -> Kept<'b> {
        let own = || columns.iter().zip(redundant).filter(|(_, r)| !**r);
        Kept {
            white: own().map(|(rows, _)| rows.white.as_slice()).collect(),
            ridge: own().map(|(rows, _)| rows.ridge(rows_a_sample)).collect(),
        }
    }
}

/// Modified Gram-Schmidt in order. A column with little component orthogonal to the earlier ones is
/// redundant.
fn redundancy(columns: &[&Rows]) -> Vec<bool> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    columns
        .iter()
        .map(|rows| {
            let length = norm(&rows.white);
            let mut rest = rows.white.clone();
            for unit in &basis {
                let along = dot(&rest, unit);
                for (x, u) in rest.iter_mut().zip(unit) {
                    *x -= along * u;
                }
            }
            let own = norm(&rest);
            let redundant = own.is_nan() || own <= OWN_OF_COLUMN * length || length == 0.0;
            if !redundant {
                rest.iter_mut().for_each(|x| *x /= own);
                basis.push(rest);
            }
            redundant
        })
        .collect()
}

/// The loss of each block when the coefficients come from the other blocks.
fn block_losses(columns: &Kept<'_>, target: &[f64], blocks: &Blocks) -> Vec<f64> {
    let parts: Vec<Normal> = blocks
        .ranges
        .iter()
        .map(|&(first, end)| normal(&columns.white, target, first, end))
        .collect();
    let mut sum = normal(&columns.white, target, 0, 0);
    for part in &parts {
        sum.gram += &part.gram;
        sum.moment += &part.moment;
        sum.square += part.square;
    }
    parts
        .iter()
        .map(|part| {
            let others = Normal {
                gram: &sum.gram - &part.gram,
                moment: &sum.moment - &part.moment,
                square: sum.square - part.square,
            };
            loss(part, &solve(&others, &columns.ridge))
        })
        .collect()
}

fn normal(columns: &[&[f64]], target: &[f64], first: usize, end: usize) -> Normal {
    crate::stop::look();
    let columns: Vec<&[f64]> = columns
        .iter()
        .map(|column| column.get(first..end).unwrap_or_default())
        .collect();
    let target = target.get(first..end).unwrap_or_default();
    let size = columns.len();
    Normal {
        gram: DMatrix::from_fn(size, size, |i, j| match (columns.get(i), columns.get(j)) {
            (Some(a), Some(b)) if i <= j => dot(a, b),
            _ => 0.0,
        }),
        moment: DVector::from_iterator(size, columns.iter().map(|c| dot(c, target))),
        square: dot(target, target),
    }
}

/// Solves the normal equations with the precision of each coefficient without the recording. Each
/// column is scaled to length 1, and a ridge at rounding level keeps a block without excitation from
/// deciding.
#[expect(
    clippy::indexing_slicing,
    reason = "indices below the matrix's own size"
)]
fn solve(normal: &Normal, ridge: &[f64]) -> DVector<f64> {
    let size = normal.moment.len();
    let gram = with_ridge(&normal.gram, ridge);
    let scale = DVector::from_iterator(
        size,
        gram.diagonal().iter().map(|d| 1.0 / d.sqrt().max(1e-150)),
    );
    let mut scaled = DMatrix::from_fn(size, size, |i, j| gram[(i, j)] * scale[i] * scale[j]);
    for i in 0..size {
        scaled[(i, i)] += 1e-10;
    }
    let right = normal.moment.component_mul(&scale);
    match scaled.cholesky() {
        Some(factor) => factor.solve(&right).component_mul(&scale),
        None => DVector::zeros(size),
    }
}

fn symmetric(upper: &DMatrix<f64>) -> DMatrix<f64> {
    let mut full = upper.clone();
    full.fill_lower_triangle_with_upper_triangle();
    full
}

/// A symmetric matrix from its upper triangle, with the precision of each coefficient on its
/// diagonal; none where `ridge` is empty.
#[expect(
    clippy::indexing_slicing,
    reason = "a ridge is as long as the matrix, or empty"
)]
fn with_ridge(upper: &DMatrix<f64>, ridge: &[f64]) -> DMatrix<f64> {
    let mut full = symmetric(upper);
    for (k, own) in ridge.iter().enumerate() {
        full[(k, k)] += own;
    }
    full
}

fn loss(normal: &Normal, solution: &DVector<f64>) -> f64 {
    let quadratic = (symmetric(&normal.gram) * solution).dot(solution);
    (normal.square - 2.0 * normal.moment.dot(solution) + quadratic).max(0.0)
}

/// Covariance of the coefficients for white noise of variance 1, with the precision of each without
/// the recording; `None` if singular.
pub fn covariance(columns: &[&[f64]], ridge: &[f64]) -> Option<DMatrix<f64>> {
    let none = vec![0.0; columns.first().map_or(0, |c| c.len())];
    with_ridge(&normal(columns, &none, 0, none.len()).gram, ridge).try_inverse()
}

/// Paired comparison of block losses: `(total gain, z)`. Positive means that `after` is better.
///
/// `weight` is the gain expected of each block (its excitation, or 1). The scatter is taken about
/// that share, so that blocks without the mechanism do not judge it.
pub fn paired(before: &[f64], after: &[f64], weight: &[f64]) -> (f64, f64) {
    let mean_weight = weight.iter().sum::<f64>() / weight.len().max(1) as f64;
    let blocks: Vec<(f64, f64)> = before
        .iter()
        .zip(after)
        .zip(weight)
        .filter(|(_, w)| **w > LEAST_WEIGHT * mean_weight)
        .map(|((b, a), w)| (b - a, *w))
        .collect();
    let n = blocks.len() as f64;
    if blocks.len() < 3 {
        return (0.0, 0.0);
    }
    let gain: f64 = blocks.iter().map(|(g, _)| g).sum();
    let total: f64 = blocks.iter().map(|(_, w)| w).sum();
    let share = gain / total;
    let scatter: f64 = blocks
        .iter()
        .map(|(g, w)| (g - share * w) * (g - share * w))
        .sum();
    (gain, gain / (scatter * n / (n - 1.0)).sqrt().max(1e-300))
}

/// The inner product, in four running sums that the processor can overlap.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, a_rest) = a.as_chunks::<4>();
    let (b4, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (x, y) in a4.iter().zip(b4) {
        for (sum, (x, y)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum += x * y;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}

pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::joint::recorded::{Noise, exact_bench};
    use crate::problem::Problem;
    use rigproof_spec::effect::Mechanism;

    fn rows(white: Vec<f64>) -> Rows {
        Rows {
            signal: Vec::new(),
            raw: white.clone(),
            white,
            prior_deviation: f64::INFINITY,
        }
    }

    fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut noise = Noise::new(seed);
        (0..count).map(|_| noise.draw()).collect()
    }

    #[test]
    fn no_sample_reaches_into_two_blocks() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, run.windows_of(0.043));
        let blocks = Blocks::new(&problem);
        assert_eq!(blocks.ranges.len(), 9);
        let centres = &problem.windows.centres;
        let reach = problem.windows.bump.len() / 2;
        for pair in blocks.ranges.windows(2) {
            let last_sample = centres[pair[0].1 - 1] + reach;
            let first_sample = centres[pair[1].0] - reach;
            assert!(last_sample < first_sample, "{pair:?}");
        }
    }

    #[test]
    fn a_left_out_block_judges_a_fit_of_the_others() {
        let (x, e) = (noise(160, 3), noise(160, 4));
        let target: Vec<f64> = x.iter().zip(&e).map(|(x, e)| 1.9 * x + 0.3 * e).collect();
        let blocks = Blocks {
            ranges: (0..8).map(|b| (20 * b, 20 * b + 17)).collect(),
        };
        let found = left_out_loss(&target, &[rows(x.clone())], &blocks);
        let mut expected = 0.0;
        for left in &blocks.ranges {
            let others = blocks.ranges.iter().filter(|r| *r != left);
            let (mut xy, mut xx) = (0.0, 0.0);
            for k in others.flat_map(|r| r.0..r.1) {
                xy += x[k] * target[k];
                xx += x[k] * x[k];
            }
            let slope = xy / xx;
            expected += (left.0..left.1)
                .map(|k| (target[k] - slope * x[k]).powi(2))
                .sum::<f64>();
        }
        assert!(
            (found - expected).abs() < 1e-8 * expected,
            "{found} {expected}"
        );
    }

    #[test]
    fn what_is_known_without_the_recording_counts_as_one_sample() {
        let mut own = rows(vec![2.0, 0.0]);
        let target = [6.0, 0.0];
        own.prior_deviation = 0.5;
        // The slope alone is 3. One sample of precision 4·1 against one of 1/0.5² leaves half of it,
        // and a fifth where four rows are one sample.
        for (rows_a_sample, expected) in [(1.0, 1.5), (4.0, 0.6)] {
            let kept = Kept::of(&[&own], &[false], rows_a_sample);
            let all = normal(&kept.white, &target, 0, 2);
            let slope = solve(&all, &kept.ridge)[0];
            assert!((slope - expected).abs() < 1e-8, "{slope}");
            let variance = covariance(&kept.white, &kept.ridge).unwrap()[(0, 0)];
            assert!((variance - 1.0 / (4.0 + 4.0 * rows_a_sample)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_column_inside_the_earlier_ones_is_redundant() {
        let (a, b, c) = (noise(300, 21), noise(300, 22), noise(300, 23));
        let mixed = |share: f64| -> Rows {
            let sum = a.iter().zip(&b).zip(&c);
            rows(
                sum.map(|((a, b), c)| 1.3 * a - 0.7 * b + share * c)
                    .collect(),
            )
        };
        let (near, apart) = (mixed(0.005), mixed(0.3));
        let (a, b) = (rows(a.clone()), rows(b.clone()));
        assert_eq!(
            redundancy(&[&a, &b, &near, &apart]),
            [false, false, true, false]
        );
    }

    #[test]
    fn a_paired_gain_is_compared_with_its_scatter() {
        let before = [7.1, 8.3, 6.9, 9.2, 7.7];
        let gains = [0.9, 1.1, 1.3, 0.7, 1.0];
        let after: Vec<f64> = before.iter().zip(gains).map(|(b, g)| b - g).collect();
        let (gain, z) = paired(&before, &after, &[1.0; 5]);
        assert!((gain - 5.0).abs() < 1e-12);
        // Scatter about 1.0: 0.01 + 0.01 + 0.09 + 0.09 + 0 = 0.2, times 5/4.
        assert!((z - 5.0 / 0.25_f64.sqrt()).abs() < 1e-9, "{z}");
        assert!((paired(&after, &before, &[1.0; 5]).1 + z).abs() < 1e-9);
        let (_, few) = paired(&before, &after, &[1.0, 1.0, 0.01, 0.01, 0.01]);
        assert_eq!(few, 0.0);
    }
}
