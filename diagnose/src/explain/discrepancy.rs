//! This file says how many neighbouring rows of a residual count as one independent sample.

use super::fitted::Folds;
use crate::rules::{LEAST_CORRELATION, ROWS_A_SAMPLE};

/// The number of rows that carry as much information as one independent sample.
///
/// It is `ROWS_A_SAMPLE` times the integrated autocorrelation of the best explanation's residual,
/// at most one block: blocks are taken as independent.
pub fn rows_a_sample(folds: &Folds, residual: &[f64], usable: &[bool]) -> f64 {
    (ROWS_A_SAMPLE * correlation(residual, usable))
        .min(folds.mean_rows())
        .max(ROWS_A_SAMPLE)
}

/// The integrated autocorrelation of white rows, in rows: 1 where they are independent.
fn correlation(residual: &[f64], usable: &[bool]) -> f64 {
    let usable_or_none = |(r, usable): (&f64, &bool)| if *usable { *r } else { 0.0 };
    let rows: Vec<f64> = residual.iter().zip(usable).map(usable_or_none).collect();
    let covariance = |lag: usize| -> f64 {
        let later = rows.iter().skip(lag);
        rows.iter().zip(later).map(|(a, b)| a * b).sum()
    };
    let variance = covariance(0).max(1e-300);
    let lags = (1..rows.len() / 4).map(|lag| covariance(lag) / variance);
    let alike = lags.take_while(|own| *own >= LEAST_CORRELATION);
    1.0 + 2.0 * alike.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wandering(keeps: f64) -> Vec<f64> {
        let mut state = 1_u64;
        let mut value = 0.0;
        let rows = (0..4000).map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            value = keeps * value + (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            value
        });
        rows.collect()
    }

    #[test]
    fn independent_rows_are_one_apiece() {
        assert!((correlation(&wandering(0.0), &[true; 4000]) - 1.0).abs() < 0.2);
    }

    #[test]
    fn a_wandering_rest_says_less() {
        // The integrated autocorrelation of an autoregressive process is (1 + a)/(1 - a).
        let own = correlation(&wandering(0.8), &[true; 4000]);
        assert!((own - 9.0).abs() < 2.5, "{own}");
    }
}
