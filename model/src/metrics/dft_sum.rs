//! This file says how smooth a run was: (6.19), (6.20).

use rustfft::FftPlannerScalar;
use rustfft::num_complex::Complex;

use super::{acceleration, enough, sampling_period};
use crate::error::ModelError;

/// DFT sum of acceleration of a run, m/s³ (§6.5.2): of the magnitude of the [`acceleration`] of the tip positions.
///
/// # Errors
/// As [`acceleration`].
pub fn smoothness(tips_m: &[[f64; 2]], step_s: f64) -> Result<f64, ModelError> {
    let magnitudes: Vec<f64> = acceleration(tips_m, step_s)?
        .into_iter()
        .map(|[x, y]| libm::hypot(x, y))
        .collect();
    dft_sum(&magnitudes, step_s)
}

/// Sum of the magnitudes of the lower half of the discrete Fourier transform, each weighted by its frequency, in the
/// unit of the samples per second (6.20).
///
/// ```text
/// h_a = Σ_{k=0}^{N/2−1} |A_k|·k/(N·T)
/// ```
///
/// N/2 is rounded down.
///
/// # Differs from the thesis
///
/// The magnitude of A_k is taken; the print sums A_k itself, which (6.19) leaves complex (erratum `dft-magnitude`). The
/// sum grows with the length of the record to the power 1.5 (gap `dft-sum-scale`).
///
/// # Errors
/// [`ModelError::TooFew`] for less than two samples; [`ModelError::SettingRange`] for a step that is not positive.
//= thesis (6.20)
pub fn dft_sum(samples: &[f64], step_s: f64) -> Result<f64, ModelError> {
    enough(samples.len(), 2)?;
    sampling_period(step_s)?;
    let duration_s = samples.len() as f64 * step_s;
    Ok(dft_magnitudes(samples)
        .into_iter()
        .take(samples.len() / 2)
        .enumerate()
        .map(|(k, magnitude)| magnitude * (k as f64 / duration_s))
        .sum())
}

/// Magnitudes of the discrete Fourier transform of a record, in the unit of its samples (6.19).
///
/// ```text
/// A_n = Σ_{k=0}^{N−1} a_k·e^{2πjkn/N}
/// ```
///
/// The sign of the exponent does not change the magnitude of the transform of real samples.
//= thesis (6.19)
pub fn dft_magnitudes(samples: &[f64]) -> Vec<f64> {
    let mut transform: Vec<Complex<f64>> = samples.iter().map(|sample| (*sample).into()).collect();
    if !transform.is_empty() {
        FftPlannerScalar::new()
            .plan_fft_inverse(transform.len())
            .process(&mut transform);
    }
    transform
        .into_iter()
        .map(|value| libm::hypot(value.re, value.im))
        .collect()
}
