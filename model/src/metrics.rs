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

/// Shortest and longest time from sample to sample that is taken for one, s.
const SAMPLING_PERIODS_S: [f64; 2] = [1e-9, 1e3];

/// Checks a time from sample to sample.
fn sampling_period(step_s: f64) -> Result<(), ModelError> {
    let [least, greatest] = SAMPLING_PERIODS_S;
    if (least..=greatest).contains(&step_s) {
        Ok(())
    } else {
        Err(ModelError::SettingRange {
            setting: "the sampling period",
            value: step_s,
            least,
            greatest,
            unit: "s",
        })
    }
}
