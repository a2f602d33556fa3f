//! This file measures a trial: how accurate, how laborious, how smooth, how restless and how long it was.

use rigproof_model::metrics::{average_tip_force, path_error, smoothness};
use rigproof_spec::methods::SAMPLE_STEP_S;
use serde::{Deserialize, Serialize};

use crate::way::Way;

/// A metric; for every one less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "`words` says what each is")]
pub enum Metric {
    PathError,
    TipForce,
    DftSum,
    Switching,
    Finish,
}

/// How many metrics there are.
pub const METRICS: usize = 5;

impl Metric {
    /// Every metric.
    pub const ALL: [Metric; METRICS] = [
        Metric::PathError,
        Metric::TipForce,
        Metric::DftSum,
        Metric::Switching,
        Metric::Finish,
    ];

    /// Its name in files, with its unit.
    pub const fn key(self) -> &'static str {
        match self {
            Metric::PathError => "path_error_m",
            Metric::TipForce => "tip_force_n",
            Metric::DftSum => "dft_sum_m_s3",
            Metric::Switching => "switching_per_s",
            Metric::Finish => "finish_s",
        }
    }

    /// What it is.
    pub const fn words(self) -> &'static str {
        match self {
            Metric::PathError => "average path error (6.14)",
            Metric::TipForce => "average tip force (6.16b)",
            Metric::DftSum => "DFT sum of acceleration (6.20)",
            Metric::Switching => "changes of the set of brakes that have current",
            Metric::Finish => "time to the end of the path",
        }
    }

    /// Its unit.
    pub const fn unit(self) -> &'static str {
        match self {
            Metric::PathError => "m",
            Metric::TipForce => "N",
            Metric::DftSum => "m/s³",
            Metric::Switching => "1/s",
            Metric::Finish => "s",
        }
    }
}

/// The metrics of a trial, in the order of [`Metric::ALL`]; `None` where there is nothing to measure.
pub type Measured = [Option<f64>; METRICS];

/// What a trial was, up to the end of the path, as far as it is measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// The tip, m.
    pub tips_m: Vec<[f64; 2]>,
    /// The hand's force, N.
    pub forces_n: Vec<[f64; 2]>,
    /// How often the set of brakes with current changed.
    pub switches: u64,
    /// When the end of the path was reached, s.
    pub finish_s: Option<f64>,
}

impl Track {
    /// The metrics. A trial shorter than the filters need, or one whose tip never moved, has none of those.
    pub fn measured(&self, way: &Way) -> Measured {
        let time_s = self.tips_m.len() as f64 * SAMPLE_STEP_S;
        let rate = (time_s > 0.0).then(|| self.switches as f64 / time_s);
        [
            path_error(way, &self.tips_m).ok(),
            average_tip_force(&self.forces_n, SAMPLE_STEP_S).ok(),
            smoothness(&self.tips_m, SAMPLE_STEP_S).ok(),
            rate,
            self.finish_s,
        ]
    }
}
