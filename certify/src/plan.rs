//! This file is the plan of a campaign: everything that its result depends on.

use serde::{Deserialize, Serialize};

use crate::built_in::BuiltIn;
use crate::calibration::Calibration;
use crate::controller::Source;
use crate::declared::{Claim, Declared};
use crate::digest;
use crate::error::Error;
use crate::foreign::Limits;
use crate::law::Law;
use crate::metrics::METRICS;
use crate::requirement::Asked;
use crate::scenario::{Rig, Scenario};

/// The form of plans, journals and certificates; another form is another number.
pub const FORM: u32 = 5;

/// What a campaign runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// [`FORM`].
    pub form: u32,
    /// What people call the change.
    pub name: String,
    /// What is to be certified.
    pub controller: Subject,
    /// What is on the rig now.
    pub baseline: Option<Subject>,
    /// The layouts.
    pub rigs: Vec<Rig>,
    /// The seed of every scenario.
    pub seed: u64,
    /// How many scenarios.
    pub scenarios: u64,
    /// Samples of a trial.
    pub ticks: u32,
    /// What the plant has beyond the thesis's.
    pub calibration: Option<Calibration>,
    /// Trials of the search for a worse case, for every law and metric; 0 for none.
    pub search: u32,
    /// What 95 of 100 trials must not exceed, in the order of the metrics.
    pub limits: [Option<f64>; METRICS],
    /// By how much the mean may be worse than the baseline's.
    pub regressions: [Option<f64>; METRICS],
    /// In how many trials the premise of every law has to be met at least.
    pub least_met: u64,
    /// What the laboratory asks for, in its own words.
    pub requirements: Vec<Asked>,
}

/// A controller and what it says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// Which.
    pub what: What,
    /// What it promises.
    pub declared: Declared,
}

/// Which controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// A law of the rig.
    BuiltIn(BuiltIn),
    /// One that the caller brings.
    Given {
        /// Its name: a file, or a word.
        name: String,
        /// The SHA-256 of its code.
        sha256: String,
        /// What its process is given; `None` where it has none.
        process: Option<Limits>,
        /// What of the protection from it the system did not give, a sentence each.
        lacks: Vec<String>,
    },
}

impl Subject {
    /// A law of the rig, which promises what its kind says.
    pub fn built_in(law: BuiltIn) -> Subject {
        Subject {
            declared: law.declared(),
            what: What::BuiltIn(law),
        }
    }

    /// A law of the rig of which one of so many samples is set beside the reference.
    pub fn beside(law: BuiltIn, every: u32) -> Subject {
        let mut own = Subject::built_in(law);
        own.declared.reference = Some(Claim { law, every });
        own
    }

    /// What makes it, if it is a law of the rig.
    pub fn source(&self) -> Option<&dyn Source> {
        match &self.what {
            What::BuiltIn(law) => Some(law),
            What::Given { .. } => None,
        }
    }
}

/// What makes the controllers of a plan.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// What is to be certified.
    pub controller: &'a dyn Source,
    /// What is on the rig now.
    pub baseline: Option<&'a dyn Source>,
}

/// In how many of so many trials the premise of a law has to be met, unless a description says otherwise: one in a hundred.
pub const fn least_met(scenarios: u64) -> u64 {
    scenarios.div_ceil(100)
}

impl Plan {
    /// A controller by itself in 1000 trials of 10 s: beside no baseline, on the thesis's plant, with nothing else asked for.
    pub fn alone(name: &str, controller: Subject, rigs: Vec<Rig>) -> Plan {
        Plan {
            form: FORM,
            name: name.to_owned(),
            controller,
            baseline: None,
            rigs,
            seed: 1,
            scenarios: 1000,
            ticks: 10_000,
            calibration: None,
            search: 0,
            limits: [None; METRICS],
            regressions: [None; METRICS],
            least_met: 1,
            requirements: Vec::new(),
        }
    }

    /// The scenario of an index.
    pub fn scenario(&self, index: u64) -> Scenario {
        let calibration = self.calibration.as_ref();
        Scenario {
            left_out: calibration.map_or_else(Vec::new, |found| found.drawn(self.seed, index)),
            ..Scenario::drawn(self.seed, index, &self.rigs, self.ticks)
        }
    }

    /// Why a law cannot be judged; `None` where it can.
    pub fn not_looked_at(&self, law: Law) -> Option<&'static str> {
        let is_passive = self
            .calibration
            .as_ref()
            .is_none_or(Calibration::is_passive);
        match law {
            Law::Passivity if !is_passive => Some(
                "the calibration names what stores energy or gives it, which the rig's motion does not tell",
            ),
            Law::BrakedJoints if self.rigs == [Rig::FourBrake] => {
                Some("every joint of the 4-brake layout has a brake")
            }
            law => law.not_looked_at(&self.controller.declared),
        }
    }

    /// The SHA-256 of the plan.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn digest(&self) -> Result<String, Error> {
        digest::of_value(self)
    }

    /// What makes its controllers, if they are laws of the rig.
    pub fn sources(&self) -> Option<Sources<'_>> {
        let baseline = match &self.baseline {
            Some(subject) => Some(subject.source()?),
            None => None,
        };
        Some(Sources {
            controller: self.controller.source()?,
            baseline,
        })
    }
}
