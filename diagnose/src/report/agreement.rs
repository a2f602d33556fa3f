//! This file compares the held-out error with the error that noise, residual and parameter
//! intervals predict.

use crate::filter::rms;
use serde::Serialize;

/// The held-out error with the named mechanisms, beside the predicted one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// Whether the error is within the limit.
    pub agrees: bool,
    /// Root mean square of the held-out error, in the fit's unit.
    pub error: f64,
    /// The limit that follows from sensor noise, the residual of the windows, and the parameter
    /// intervals.
    pub allowed: f64,
    /// The time from which the error is larger than before, s; `None` if it agrees.
    pub departs_s: Option<f64>,
    /// The time of the greatest error, s.
    pub greatest_s: f64,
}

impl Agreement {
    /// Compares errors, each with its time in s, with the limit of their root mean square.
    pub(crate) fn of(errors: &[(f64, f64)], allowed: f64) -> Agreement {
        let values: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
        let error = rms(&values);
        let agrees = error <= allowed;
        let departs_s = departure(errors, allowed);
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

    /// A sentence on the disagreement; `None` if it agrees.
    pub fn said(&self, unit: &str) -> Option<String> {
        (!self.agrees).then(|| {
            let from = self.departs_s.map_or(String::new(), |departs_s| {
                format!("; it grows from {departs_s:.3} s on")
            });
            format!(
                "the held-out part does not agree: its error is {:.3e} {unit}, while noise and the intervals of the parameters allow {:.3e} {unit}{from}; it is greatest at {:.3} s",
                self.error, self.allowed, self.greatest_s
            )
        })
    }
}

/// The most likely time of a change in variance (likelihood ratio of two stretches with one
/// variance each). The limit is the least variance of either.
fn departure(errors: &[(f64, f64)], allowed: f64) -> Option<f64> {
    let whole: f64 = errors.iter().map(|(error, _)| error * error).sum();
    let cost = |squares: f64, count: usize| {
        let variance = (squares / count.max(1) as f64).max(allowed * allowed);
        count as f64 * libm::log(variance.max(f64::MIN_POSITIVE))
    };
    let mut before = 0.0;
    let divided = errors.iter().enumerate().map(|(k, (error, time_s))| {
        let both = cost(before, k) + cost(whole - before, errors.len() - k);
        before += error * error;
        (both, *time_s)
    });
    let best = divided.min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, time_s)| time_s)
}
