//! This file whitens correlated residuals: by an autoregressive model of stationary noise within
//! each unbroken stretch of windows, or by the Cholesky factor of a banded covariance.

pub use crate::rules::NOISE_ORDER;

/// A noise model that whitens rows.
#[derive(Clone, Debug)]
pub enum Whitener {
    /// Prediction-error filters of order 0 to `NOISE_ORDER`, so that the first windows of a stretch
    /// are whitened too.
    Stationary {
        /// For each order, the predictor's coefficients and the standard deviation of its error.
        filters: Vec<(Vec<f64>, f64)>,
        /// Window ranges `(first, end)` without a gap.
        stretches: Vec<(usize, usize)>,
    },
    /// The rows of a Cholesky factor.
    Banded(Vec<FactorRow>),
    /// One noise model for each output, whose rows take turns.
    Apart(Vec<Whitener>),
}

/// One row of a banded Cholesky factor.
#[derive(Clone, Debug)]
pub struct FactorRow {
    /// The row of the problem that it whitens.
    row: usize,
    /// Its entries left of the diagonal; the last one is next to it.
    before: Vec<f64>,
    /// Its diagonal entry.
    diagonal: f64,
}

impl Whitener {
    /// The noise model with this autocovariance (one value per lag, in windows) over the usable
    /// windows.
    pub fn new(covariance: &[f64], usable: &[bool]) -> Whitener {
        let mut covariance: Vec<f64> = covariance.iter().take(NOISE_ORDER + 1).copied().collect();
        if let Some(variance) = covariance.first_mut() {
            // A ridge at rounding level keeps the recursion well conditioned.
            *variance = *variance * (1.0 + 1e-6) + 1e-300;
        }
        Whitener::Stationary {
            filters: levinson(&covariance),
            stretches: stretches(usable),
        }
    }

    /// The noise model with this covariance of two rows, which is 0 for rows more than `band` apart.
    pub fn banded(
        usable: &[bool],
        band: usize,
        covariance: impl Fn(usize, usize) -> f64,
    ) -> Whitener {
        let mut rows: Vec<FactorRow> = Vec::new();
        for (row, _) in usable.iter().enumerate().filter(|(_, u)| **u) {
            let first = rows.partition_point(|earlier| earlier.row + band < row);
            let mut before: Vec<f64> = Vec::new();
            for earlier in rows.iter().skip(first) {
                let shared = earlier.before.len().min(before.len());
                let mine = before.iter().rev().take(shared);
                let known: f64 = mine
                    .zip(earlier.before.iter().rev())
                    .map(|(a, b)| a * b)
                    .sum();
                before.push((covariance(row, earlier.row) - known) / earlier.diagonal);
            }
            // A ridge at rounding level keeps the factor real.
            let variance = covariance(row, row) * (1.0 + 1e-6) + 1e-300;
            let known: f64 = before.iter().map(|x| x * x).sum();
            rows.push(FactorRow {
                row,
                before,
                diagonal: (variance - known).max(1e-6 * variance).sqrt(),
            });
        }
        Whitener::Banded(rows)
    }

    /// White rows: the prediction error of each usable window, divided by its standard deviation.
    ///
    /// Unusable windows become 0 and carry no weight.
    pub fn whiten(&self, rows: &[f64]) -> Vec<f64> {
        match self {
            Whitener::Stationary { filters, stretches } => {
                predicted_apart(filters, stretches, rows)
            }
            Whitener::Banded(factor) => substituted(factor, rows),
            Whitener::Apart(outputs) => apart(outputs, rows, Whitener::whiten),
        }
    }

    /// The rows whose white rows these are: the inverse of [`Whitener::whiten`] on usable windows.
    pub fn coloured(&self, white: &[f64]) -> Vec<f64> {
        match self {
            Whitener::Stationary { filters, stretches } => {
                let mut rows = vec![0.0; white.len()];
                for_each_predicted(filters, stretches, |k, predict, deviation| {
                    let value = predict(&rows) + deviation * white.get(k).copied().unwrap_or(0.0);
                    rows.get_mut(k).into_iter().for_each(|row| *row = value);
                });
                rows
            }
            Whitener::Banded(factor) => multiplied(factor, white),
            Whitener::Apart(outputs) => apart(outputs, white, Whitener::coloured),
        }
    }
}

/// What each noise model makes of the rows of its output, which take turns.
fn apart(
    outputs: &[Whitener],
    rows: &[f64],
    of: impl Fn(&Whitener, &[f64]) -> Vec<f64>,
) -> Vec<f64> {
    let mut all = vec![0.0; rows.len()];
    for (output, own) in outputs.iter().enumerate() {
        let mine = rows.iter().skip(output).step_by(outputs.len());
        let mine = of(own, &mine.copied().collect::<Vec<_>>());
        let slots = all.iter_mut().skip(output).step_by(outputs.len());
        slots.zip(mine).for_each(|(slot, value)| *slot = value);
    }
    all
}

/// The product of a factor and white rows.
fn multiplied(factor: &[FactorRow], white: &[f64]) -> Vec<f64> {
    let mut rows = vec![0.0; white.len()];
    let at = |line: &FactorRow| white.get(line.row).copied().unwrap_or(0.0);
    for (place, line) in factor.iter().enumerate() {
        let past = factor.get(place - line.before.len()..place);
        let past = past.unwrap_or_default().iter().zip(&line.before);
        let value = past.map(|(other, l)| at(other) * l).sum::<f64>() + at(line) * line.diagonal;
        rows.get_mut(line.row)
            .into_iter()
            .for_each(|row| *row = value);
    }
    rows
}

/// Forward substitution through a factor.
fn substituted(factor: &[FactorRow], rows: &[f64]) -> Vec<f64> {
    let mut white = vec![0.0; rows.len()];
    let mut solved: Vec<f64> = Vec::with_capacity(factor.len());
    for line in factor {
        let past = solved.iter().rev().zip(line.before.iter().rev());
        let known: f64 = past.map(|(w, l)| w * l).sum();
        let value = (rows.get(line.row).copied().unwrap_or(0.0) - known) / line.diagonal;
        solved.push(value);
        if let Some(out) = white.get_mut(line.row) {
            *out = value;
        }
    }
    white
}

fn predicted_apart(
    filters: &[(Vec<f64>, f64)],
    stretches: &[(usize, usize)],
    rows: &[f64],
) -> Vec<f64> {
    let mut white = vec![0.0; rows.len()];
    for_each_predicted(filters, stretches, |k, predict, deviation| {
        if let (Some(out), Some(x)) = (white.get_mut(k), rows.get(k)) {
            *out = (x - predict(rows)) / deviation;
        }
    });
    white
}

/// Takes each row of the stretches with what predicts it from earlier rows, and the standard
/// deviation of that prediction's error.
fn for_each_predicted(
    filters: &[(Vec<f64>, f64)],
    stretches: &[(usize, usize)],
    mut take: impl FnMut(usize, &dyn Fn(&[f64]) -> f64, f64),
) {
    for &(first, end) in stretches {
        for k in first..end {
            let order = (k - first).min(filters.len() - 1);
            let Some((coefficients, deviation)) = filters.get(order) else {
                continue;
            };
            let predict = |rows: &[f64]| -> f64 {
                let past = rows.get(k - order..k).unwrap_or_default().iter().rev();
                coefficients.iter().zip(past).map(|(c, x)| c * x).sum()
            };
            take(k, &predict, *deviation);
        }
    }
}

/// Ranges of consecutive usable windows.
fn stretches(usable: &[bool]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut first = None;
    for (k, &ok) in usable.iter().chain([&false]).enumerate() {
        match (first, ok) {
            (None, true) => first = Some(k),
            (Some(start), false) => {
                found.push((start, k));
                first = None;
            }
            _ => {}
        }
    }
    found
}

/// Levinson-Durbin: the best predictors of every order from an autocovariance.
fn levinson(covariance: &[f64]) -> Vec<(Vec<f64>, f64)> {
    let lag = |k: usize| covariance.get(k).copied().unwrap_or(0.0);
    let mut coefficients: Vec<f64> = Vec::new();
    let mut variance = lag(0);
    let mut filters = vec![(coefficients.clone(), variance.sqrt())];
    for order in 1..covariance.len() {
        let known: f64 = coefficients
            .iter()
            .enumerate()
            .map(|(j, c)| c * lag(order - 1 - j))
            .sum();
        let reflection = (lag(order) - known) / variance;
        // Rounding can make the covariance inconsistent: stop at the last order that is sound.
        if reflection.abs() >= 1.0 {
            break;
        }
        let mirrored: Vec<f64> = coefficients
            .iter()
            .zip(coefficients.iter().rev())
            .map(|(c, r)| c - reflection * r)
            .collect();
        coefficients = mirrored;
        coefficients.push(reflection);
        variance *= 1.0 - reflection * reflection;
        filters.push((coefficients.clone(), variance.sqrt()));
    }
    filters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coloured_sequence_comes_out_white() {
        // A linear congruential sequence as noise, coloured by a moving average of four.
        let mut seed = 12_345_u64;
        let mut noise = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (12f64).sqrt() * ((seed >> 40) as f64 / (1u64 << 24) as f64 - 0.5)
        };
        let weights = [0.1, 0.3, 0.5, 1.1];
        let raw: Vec<f64> = (0..6000).map(|_| noise()).collect();
        let coloured: Vec<f64> = raw
            .windows(4)
            .map(|w| w.iter().zip(weights).map(|(x, c)| c * x).sum())
            .collect();
        let covariance: Vec<f64> = (0..=NOISE_ORDER)
            .map(|lag| {
                weights
                    .iter()
                    .zip(weights.iter().skip(lag))
                    .map(|(a, b)| a * b)
                    .sum()
            })
            .collect();
        let usable: Vec<bool> = (0..coloured.len()).map(|k| k % 400 != 0).collect();
        let white = Whitener::new(&covariance, &usable).whiten(&coloured);
        for lag in 0..=4 {
            let products = white.iter().zip(white.iter().skip(lag)).map(|(a, b)| a * b);
            let mean = products.sum::<f64>() / white.len() as f64;
            let expected = if lag == 0 { 1.0 } else { 0.0 };
            assert!((mean - expected).abs() < 0.05, "lag {lag}: {mean}");
        }
    }

    #[test]
    fn colouring_gives_the_usable_rows_back() {
        let rows: Vec<f64> = (0..90).map(|k| libm::sin(0.7 * f64::from(k))).collect();
        let usable: Vec<bool> = (0..90).map(|k| k % 17 != 5 && k % 13 != 2).collect();
        let covariance = [1.0, 0.4, 0.1];
        let of_lag = |a: usize, b: usize| covariance.get(a.abs_diff(b)).copied().unwrap_or(0.0);
        let halves: Vec<bool> = usable.iter().step_by(2).copied().collect();
        let models = [
            (Whitener::new(&covariance, &usable), &usable),
            (Whitener::banded(&usable, 2, of_lag), &usable),
        ];
        for (model, usable) in models {
            let back = model.coloured(&model.whiten(&rows));
            for (k, _) in usable.iter().enumerate().filter(|(_, u)| **u) {
                assert!((back[k] - rows[k]).abs() < 1e-12, "row {k}: {}", back[k]);
            }
        }
        let own = Whitener::new(&covariance, &halves);
        let apart = Whitener::Apart(vec![own.clone(), own]);
        let back = apart.coloured(&apart.whiten(&rows));
        for k in (0..90).filter(|k| halves[k / 2]) {
            assert!((back[k] - rows[k]).abs() < 1e-12, "row {k}: {}", back[k]);
        }
    }
}
