//! This file says how hard the operator had to push: (6.16b).

use rigproof_spec::methods::METRIC_CUTOFF_HZ;

use super::{Butterworth, enough, finite};
use crate::error::ModelError;

/// Time average of the tip force, N (6.16, the second of that number), after the filter of §6.5.2.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | F_xin, F_yin | `forces_n`, N samples, x and y | N |
/// | T | `step_s`, time from sample to sample | s |
///
/// # Errors
/// [`ModelError::TooFew`] for less than 16 samples; [`ModelError::NotFinite`]; [`ModelError::SettingRange`] for a step
/// that the filter cannot work with.
pub fn average_tip_force(forces_n: &[[f64; 2]], step_s: f64) -> Result<f64, ModelError> {
    finite("a tip force", "N", forces_n)?;
    let filter = Butterworth::low_pass(METRIC_CUTOFF_HZ, step_s)?;
    let x_n: Vec<f64> = forces_n.iter().map(|[x, _]| *x).collect();
    let y_n: Vec<f64> = forces_n.iter().map(|[_, y]| *y).collect();
    let (x_n, y_n) = (filter.both_ways(&x_n)?, filter.both_ways(&y_n)?);
    let filtered: Vec<[f64; 2]> = x_n.into_iter().zip(y_n).map(|(x, y)| [x, y]).collect();
    average_magnitude(&filtered)
}

/// Average magnitude of a record of vectors, in its own unit (6.16b).
///
/// ```text
/// F_avg = (1/N)·Σ_{k=1}^{N} √(F_xin,k² + F_yin,k²)
/// ```
///
/// # Errors
/// [`ModelError::TooFew`] for an empty record.
//= thesis (6.16b)
pub fn average_magnitude(forces_n: &[[f64; 2]]) -> Result<f64, ModelError> {
    enough(forces_n.len(), 1)?;
    let sum: f64 = forces_n.iter().map(|[x, y]| libm::hypot(*x, *y)).sum();
    Ok(sum / forces_n.len() as f64)
}
