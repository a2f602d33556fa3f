//! This file says how far two series lie apart: the one comparison of the workspace.

use crate::error::TraceError;

/// The distance between a measured and a simulated series, both in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Pairs that both have a value.
    pub pairs: usize,
    /// Root mean square of the difference, in the unit of the series.
    pub rms: f64,
    /// Greatest absolute difference, in the unit of the series.
    pub maximum: f64,
    /// The rms as per cent of the measured series' standard deviation; `None` when that is zero.
    pub nrmse_percent: Option<f64>,
}

/// Compares two series of equal length sample by sample, leaving out pairs with a missing (NaN) value.
///
/// The standard deviation is that of the measured values in the pairs, divided by their number.
///
/// # Errors
/// The lengths differ, or no pair has both values.
pub fn compare(measured: &[f64], simulated: &[f64]) -> Result<Comparison, TraceError> {
    let mismatch = |advice| TraceError::Comparison {
        measured: measured.len(),
        simulated: simulated.len(),
        advice,
    };
    if measured.len() != simulated.len() {
        return Err(mismatch("sample both at the same times"));
    }
    let both = || {
        let pairs = measured.iter().zip(simulated);
        pairs.filter(|(a, b)| !a.is_nan() && !b.is_nan())
    };
    let pairs = both().count();
    if pairs == 0 {
        return Err(mismatch("no pair has both values"));
    }
    let n = pairs as f64;
    let rms = (both().map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / n).sqrt();
    let maximum = both().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let mean = both().map(|(a, _)| a).sum::<f64>() / n;
    let deviation = (both().map(|(a, _)| (a - mean) * (a - mean)).sum::<f64>() / n).sqrt();
    Ok(Comparison {
        pairs,
        rms,
        maximum,
        nrmse_percent: (deviation > 0.0).then(|| 100.0 * rms / deviation),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_values_are_left_out_on_both_sides() {
        let measured = [1.5, f64::NAN, -2.5, 4.0, 9.0];
        let simulated = [1.2, 77.0, -2.1, 4.0, f64::NAN];
        let distance = compare(&measured, &simulated).unwrap();
        assert_eq!(distance.pairs, 3);
        assert!((distance.maximum - 0.4).abs() < 1e-15);
        assert!((distance.rms - (0.25_f64 / 3.0).sqrt()).abs() < 1e-15);
        // Mean 1; squares 0.25, 12.25, 9.
        let expected = 100.0 * (0.25_f64 / 21.5).sqrt();
        assert!((distance.nrmse_percent.unwrap() - expected).abs() < 1e-12);
    }

    #[test]
    fn a_measurement_that_never_moves_has_no_nrmse() {
        let distance = compare(&[3.2, 3.2], &[3.1, 3.4]).unwrap();
        assert_eq!(distance.nrmse_percent, None);
        assert!(distance.rms > 0.1);
    }

    #[test]
    fn unequal_or_empty_series_are_refused() {
        assert!(compare(&[1.1, 2.2], &[1.1]).is_err());
        assert!(compare(&[f64::NAN], &[1.1]).is_err());
    }
}
