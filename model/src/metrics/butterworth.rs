//! This file is the fourth-order low-pass Butterworth filter of §6.5.2.

use core::f64::consts::PI;

use super::{enough, sampling_period};
use crate::error::ModelError;

/// Samples that are put before and after a record while it is filtered both ways, mirrored in its ends.
const PADDING: usize = 15;

/// A fourth-order low-pass Butterworth filter: two sections of second order, bilinear with the cut-off kept in place.
///
/// ```
/// use rigproof_model::metrics::Butterworth;
/// let filter = Butterworth::low_pass(25.0, 0.001)?;
/// // A constant passes.
/// assert!(filter.both_ways(&[0.731; 40])?.iter().all(|y| (y - 0.731).abs() < 1e-12));
/// # Ok::<(), rigproof_model::ModelError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Butterworth {
    sections: [Section; 2],
}

/// y = (b0 + b1·z⁻¹ + b2·z⁻²) / (1 + a1·z⁻¹ + a2·z⁻²)·x, of gain one at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

impl Butterworth {
    /// The filter for a cut-off frequency, Hz, and a time from sample to sample, s.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`] when the step is not positive and finite, or the cut-off not between 0 and half the
    /// sampling rate, both excluded.
    pub fn low_pass(cutoff_hz: f64, step_s: f64) -> Result<Butterworth, ModelError> {
        sampling_period(step_s)?;
        if !(cutoff_hz > 0.0 && cutoff_hz * step_s < 0.5) {
            return Err(ModelError::SettingRange {
                setting: "the cut-off of the filter",
                value: cutoff_hz,
                least: 0.0,
                greatest: 0.5 / step_s,
                unit: "Hz",
            });
        }
        let warped = libm::tan(PI * cutoff_hz * step_s);
        // The poles of the fourth order lie at 67.5° and 22.5° from the negative axis.
        let sections = [3.0, 1.0].map(|eighths| {
            let damping = 2.0 * libm::cos(eighths * PI / 8.0);
            let norm = 1.0 + damping * warped + warped * warped;
            let b_0 = warped * warped / norm;
            Section {
                b: [b_0, 2.0 * b_0, b_0],
                a: [
                    2.0 * (warped * warped - 1.0) / norm,
                    (1.0 - damping * warped + warped * warped) / norm,
                ],
            }
        });
        Ok(Butterworth { sections })
    }

    /// The record filtered once, from a filter at rest at the first sample: what a rig can do while it runs.
    pub fn one_way(&self, samples: &[f64]) -> Vec<f64> {
        let mut filtered = samples.to_vec();
        for section in self.sections {
            section.run(&mut filtered);
        }
        filtered
    }

    /// The record filtered forwards and backwards, without delay; the ends are continued by their point reflection, and
    /// the filter starts at rest at the first sample of each pass (gap `metric-filter`).
    ///
    /// # Errors
    /// [`ModelError::TooFew`] for less than 16 samples.
    pub fn both_ways(&self, samples: &[f64]) -> Result<Vec<f64>, ModelError> {
        enough(samples.len(), PADDING + 1)?;
        let mut filtered = self.one_way(&reflected(samples));
        filtered.reverse();
        filtered = self.one_way(&filtered);
        filtered.reverse();
        Ok(filtered
            .into_iter()
            .skip(PADDING)
            .take(samples.len())
            .collect())
    }
}

impl Section {
    /// Filters in place, transposed direct form II, from the state of an endless first sample.
    fn run(&self, samples: &mut [f64]) {
        let [b_0, b_1, b_2] = self.b;
        let [a_1, a_2] = self.a;
        let first = samples.first().copied().unwrap_or(0.0);
        let mut z_2 = (b_2 - a_2) * first;
        let mut z_1 = (b_1 - a_1) * first + z_2;
        for sample in samples {
            let x = *sample;
            let y = b_0 * x + z_1;
            z_1 = b_1 * x - a_1 * y + z_2;
            z_2 = b_2 * x - a_2 * y;
            *sample = y;
        }
    }
}

/// The record with its ends continued by point reflection.
fn reflected(samples: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
        return Vec::new();
    };
    let mut before: Vec<f64> = samples
        .iter()
        .skip(1)
        .take(PADDING)
        .map(|sample| 2.0 * first - sample)
        .collect();
    before.reverse();
    let after = samples.iter().rev().skip(1).take(PADDING);
    before
        .into_iter()
        .chain(samples.iter().copied())
        .chain(after.map(|sample| 2.0 * last - sample))
        .collect()
}
