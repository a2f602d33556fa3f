//! The metrics of §6.5.2: how accurate, how laborious and how smooth a recorded run was.

mod acceleration;
mod butterworth;
mod dft_sum;
mod path_error;
mod tip_force;

pub use acceleration::{acceleration, six_step_difference};
pub use butterworth::Butterworth;
pub use dft_sum::{dft_magnitudes, dft_sum, smoothness};
pub use path_error::{path_error, path_length, step_lengths};
pub use tip_force::{average_magnitude, average_tip_force};

use crate::error::ModelError;

/// Checks that every sample of a record is finite.
fn finite(
    quantity: &'static str,
    unit: &'static str,
    samples: &[[f64; 2]],
) -> Result<(), ModelError> {
    match samples.iter().flatten().find(|sample| !sample.is_finite()) {
        None => Ok(()),
        Some(value) => Err(ModelError::NotFinite {
            quantity,
            value: *value,
            unit,
        }),
    }
}

/// Checks that a record is long enough.
fn enough(count: usize, least: usize) -> Result<(), ModelError> {
    if count >= least {
        Ok(())
    } else {
        Err(ModelError::TooFew {
            what: "samples",
            count,
            least,
        })
    }
}

/// Checks a time from sample to sample.
fn sampling_period(step_s: f64) -> Result<(), ModelError> {
    if step_s > 0.0 && step_s.is_finite() {
        Ok(())
    } else {
        Err(ModelError::SettingRange {
            setting: "the sampling period",
            value: step_s,
            least: f64::MIN_POSITIVE,
            greatest: f64::MAX,
            unit: "s",
        })
    }
}
