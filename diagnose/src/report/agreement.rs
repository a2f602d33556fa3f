//! This file is whether the held-out part agrees with what windows and noise predict for it.

use serde::Serialize;

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
