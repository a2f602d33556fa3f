//! This file says how the tip was accelerated, from where it was: (6.17), (6.18).

use rigproof_spec::methods::METRIC_CUTOFF_HZ;

use super::{Butterworth, enough, finite};
use crate::error::ModelError;

/// Samples between the two ends of the difference.
const SPAN: usize = 6;

/// Six-step balanced difference, in the unit of the samples per second (6.17), (6.18).
///
/// ```text
/// (dx/dt)_k = (x_{k+3} − x_{k−3}) / (6·T)
/// ```
///
/// The three samples at each end have no neighbour on one side: the result is six shorter (gap `metric-edges`).
//= thesis (6.17)
//= thesis (6.18)
pub fn six_step_difference(samples: &[f64], step_s: f64) -> Vec<f64> {
    samples
        .iter()
        .zip(samples.iter().skip(SPAN))
        .map(|(before, after)| (after - before) / (SPAN as f64 * step_s))
        .collect()
}

/// Acceleration of the tip, x and y, m/s²: differentiated twice, filtered after each time (§6.5.2); twelve samples shorter
/// than the positions.
///
/// # Errors
/// [`ModelError::TooFew`] for less than 28 samples; [`ModelError::NotFinite`]; [`ModelError::SettingRange`] for a step
/// that the filter cannot work with.
pub fn acceleration(tips_m: &[[f64; 2]], step_s: f64) -> Result<Vec<[f64; 2]>, ModelError> {
    enough(tips_m.len(), 28)?;
    finite("a tip position", "m", tips_m)?;
    let filter = Butterworth::low_pass(METRIC_CUTOFF_HZ, step_s)?;
    let twice = |positions_m: Vec<f64>| -> Result<Vec<f64>, ModelError> {
        let velocity_m_s = filter.both_ways(&six_step_difference(&positions_m, step_s))?;
        filter.both_ways(&six_step_difference(&velocity_m_s, step_s))
    };
    let x = twice(tips_m.iter().map(|[x, _]| *x).collect())?;
    let y = twice(tips_m.iter().map(|[_, y]| *y).collect())?;
    Ok(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect())
}
