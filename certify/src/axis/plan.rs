//! This file is the plan of a campaign on an axis: everything that its result depends on.

use serde::{Deserialize, Serialize};

use super::controller::{Settings, Source};
use super::description::Asked;
use super::found::Found;
use super::law::Law;
use crate::foreign::Limits;

/// The form of plans and certificates of an axis; another form is another number.
pub const FORM: u32 = 1;

/// What a campaign runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// What people call the change.
    pub name: String,
    /// What is to be certified.
    pub controller: Library,
    /// What is on the axis now.
    pub baseline: Option<Library>,
    /// The axis.
    pub axis: Found,
    /// What trials are, and what is asked in them.
    pub asked: Asked,
    /// The seed of every trial.
    pub seed: u64,
    /// How many trials.
    pub scenarios: u64,
    /// Samples of a trial.
    pub ticks: u32,
}

/// A compiled controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Library {
    /// Its file.
    pub name: String,
    /// The SHA-256 of its file.
    pub sha256: String,
    /// What its process is given.
    pub process: Limits,
    /// What of the protection from it the system did not give, a sentence each.
    pub lacks: Vec<String>,
}

/// What makes the controllers of a plan.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// What is to be certified.
    pub controller: &'a dyn Source,
    /// What is on the axis now.
    pub baseline: Option<&'a dyn Source>,
}

impl Plan {
    /// What a controller is told at the beginning of a trial.
    pub const fn settings(&self) -> Settings {
        Settings {
            is_rotary: self.axis.is_rotary,
            sample_s: self.asked.sample_s,
            inertia: self.axis.inertia.value,
            greatest_effort: self.asked.limits.effort,
            position_quantum: self.axis.quantum,
        }
    }

    /// In how many trials the premise of every law has to be met.
    pub const fn least_met(&self) -> u64 {
        crate::plan::least_met(self.scenarios)
    }

    /// Why a law is not looked at; `None` where it is.
    pub fn not_looked_at(&self, law: Law) -> Option<&'static str> {
        match (law, self.asked.stiffness) {
            (Law::Passivity, None) => Some("no spring is declared: [declares] has no stiffness"),
            _ => None,
        }
    }
}
