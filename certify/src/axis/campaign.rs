//! This file runs the trials of an axis side by side; what comes out depends on the plan alone.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::law::LAWS;
use super::plan::{Plan, Sources};
use super::trial::{Ending, Ran, run};
use crate::law::Fared;

/// One trial after it was run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Its number.
    pub index: u64,
    /// Samples.
    pub ticks: u32,
    /// How it ended.
    pub ending: Ending,
    /// How the laws fared.
    pub fared: [Fared; LAWS],
    /// The metrics.
    pub measured: [Option<f64>; 2],
    /// How the controller broke, if it did.
    pub failure: Option<String>,
    /// The baseline, in the same trial.
    pub baseline: Option<Beside>,
}

/// What is kept of the baseline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beside {
    /// How its trial ended.
    pub ending: Ending,
    /// Its metrics.
    pub measured: [Option<f64>; 2],
}

/// Runs every trial of a plan, and tells after each.
pub fn records(plan: &Plan, sources: &Sources<'_>, done: &(impl Fn() + Sync)) -> Vec<Record> {
    let each = (0..plan.scenarios).into_par_iter().map(|index| {
        let record = record(plan, sources, index);
        done();
        record
    });
    each.collect()
}

fn record(plan: &Plan, sources: &Sources<'_>, index: u64) -> Record {
    let Ran {
        ending,
        fared,
        measured,
        failure,
        told,
    } = run(plan, sources.controller, index, true);
    let baseline = sources.baseline.map(|source| {
        // It is measured, not judged.
        let ran = run(plan, source, index, false);
        Beside {
            ending: ran.ending,
            measured: ran.measured,
        }
    });
    Record {
        index,
        ticks: told.len() as u32,
        ending,
        fared,
        measured,
        failure: failure.map(|failure| failure.to_string()),
        baseline,
    }
}
