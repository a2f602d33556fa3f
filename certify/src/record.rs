//! This file is what is kept of a trial: enough for every figure of the certificate.

use serde::{Deserialize, Serialize};

use crate::coverage::Met;
use crate::declared::Declared;
use crate::differential::tie::Ties;
use crate::error::Error;
use crate::law::{Fared, LAWS};
use crate::metrics::Measured;
use crate::plan::{Plan, Sources};
use crate::trial::{Ending, run};

/// One trial after it was run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// The scenario's number.
    pub index: u64,
    /// Samples.
    pub ticks: u32,
    /// How it ended.
    pub ending: Ending,
    /// How the laws fared.
    pub fared: [Fared; LAWS],
    /// Where their premises were met.
    pub met: [Met; LAWS],
    /// The samples that were ties beside the reference.
    pub ties: Ties,
    /// The metrics.
    pub measured: Measured,
    /// How the controller broke, if it did.
    pub failure: Option<String>,
    /// The baseline, in the same scenario.
    pub baseline: Option<Beside>,
}

/// What is kept of the baseline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beside {
    /// How its trial ended.
    pub ending: Ending,
    /// Its metrics.
    pub measured: Measured,
}

impl Record {
    /// Runs the scenario of an index.
    ///
    /// # Errors
    /// [`Error::Scenario`].
    pub fn of(plan: &Plan, sources: &Sources<'_>, index: u64) -> Result<Record, Error> {
        let scenario = plan.scenario(index);
        let none = || Error::Scenario(index);
        let ran = run(
            &scenario,
            sources.controller,
            &plan.controller.declared,
            false,
        );
        let ran = ran.ok_or_else(none)?;
        let baseline = match (&plan.baseline, sources.baseline) {
            (Some(_), Some(source)) => {
                // It is measured, not judged.
                let ran = run(&scenario, source, &Declared::default(), false);
                let ran = ran.ok_or_else(none)?;
                Some(Beside {
                    ending: ran.ending,
                    measured: ran.measured,
                })
            }
            _ => None,
        };
        Ok(Record {
            index,
            ticks: ran.ticks,
            ending: ran.ending,
            fared: ran.fared,
            met: ran.met,
            ties: ran.ties,
            measured: ran.measured,
            failure: ran.failure.map(|failure| failure.to_string()),
            baseline,
        })
    }
}
