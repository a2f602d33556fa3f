//! This file is whether the held-out part agrees with what windows and noise predict for it.

use crate::filter::rms;
use serde::Serialize;

/// Samples over which an error is taken when it is asked from when on it is too great.
const STRETCH: usize = 20;

/// The held-out error with the named mechanisms against the one that noise and the intervals of the numbers allow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// Whether the error is no greater than allowed.
    pub agrees: bool,
    /// Root mean square of the held-out error, in the fit's unit.
    pub error: f64,
    /// What the noise of the sensors, what the windows leave over, and the intervals of the numbers allow of it.
    pub allowed: f64,
    /// From when on the error is greater than allowed, s; nothing where it never is.
    pub departs_s: Option<f64>,
    /// When it is greatest, s.
    pub greatest_s: f64,
}

impl Agreement {
    /// The error of samples, each with its time, s, against what is allowed of their root mean square.
    pub(crate) fn of(errors: &[(f64, f64)], allowed: f64) -> Agreement {
        let values: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
        let error = rms(&values);
        let agrees = error <= allowed;
        // One sample may be off by chance, a stretch of them is not.
        let mut stretches = errors.windows(STRETCH.min(errors.len().max(1)));
        let departs = stretches.find(|stretch| {
            let squares = stretch.iter().map(|(error, _)| error * error);
            squares.sum::<f64>() > allowed * allowed * stretch.len() as f64
        });
        let departs_s = departs
            .and_then(|stretch| stretch.last())
            .map(|(_, time_s)| *time_s);
        let greatest = errors
            .iter()
            .max_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs()));
        Agreement {
            agrees,
            error,
            allowed,
            departs_s: departs_s.filter(|_| !agrees),
            greatest_s: greatest.map_or(0.0, |(_, time_s)| *time_s),
        }
    }

    /// What disagrees and where, in words; `None` where nothing does.
    pub fn said(&self, unit: &str) -> Option<String> {
        (!self.agrees).then(|| {
            let from = self.departs_s.map_or(String::new(), |departs_s| {
                format!(", it departs at {departs_s:.3} s")
            });
            format!(
                "the held-out part does not agree: its error is {:.3e} {unit} where noise and the intervals of the numbers allow {:.3e} {unit}{from} and is greatest at {:.3} s",
                self.error, self.allowed, self.greatest_s
            )
        })
    }
}
