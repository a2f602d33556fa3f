//! This file says which sentence of the thesis, or of the laboratory, which law or metric stands for.

use serde::{Deserialize, Serialize};

use crate::law::Law;
use crate::metrics::Metric;
use crate::plan::Plan;
use crate::search::Target;
use crate::summary::{LawSummary, MetricSummary};

/// What a laboratory asks for, in its own words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    /// The sentence.
    pub says: String,
    /// The law that stands for it, or the metric whose limits do.
    pub by: Target,
}

/// A sentence, what stands for it, and how that fared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// The sentence.
    pub says: String,
    /// Who says it.
    pub source: String,
    /// The law or the metric.
    pub by: Target,
    /// Trials in which it was met or measured.
    pub trials: u64,
    /// The least margin; of a metric how far it stays below its nearest limit. None where nothing was met, measured or limited.
    pub margin: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// Whether it holds: the law in all trials that met it, and in as many as are asked for; the limits of the metric, of which there has to be one.
    pub holds: bool,
}

impl Requirement {
    /// Whether it is the laboratory's own sentence.
    pub fn is_own(&self) -> bool {
        self.source == LABORATORY
    }

    /// Whether neither a law nor a limit was held for it.
    pub fn stands_for_nothing(&self) -> bool {
        let is_nothing = self.trials == 0 || matches!(self.by, Target::Metric(_));
        !self.holds && self.margin.is_none() && is_nothing
    }
}

/// Who says what a laboratory asks for.
const LABORATORY: &str = "certify.toml";

/// The sentence that a law stands for, and where it is from.
const fn sentence(law: Law) -> (&'static str, &'static str) {
    match law {
        Law::Answers => ("Every sample is answered, in time.", "this project"),
        Law::CurrentLimit => ("A brake gets a current from 0 to 1 A.", "thesis, §3.2"),
        Law::BrakedJoints => ("The 3-brake layout has no brake at C.", "thesis, chapter 4"),
        Law::Safe => (
            "A rig that a person holds lets go when it does not know where it is.",
            "this project, decision 0124",
        ),
        Law::Repeats => ("The same samples give the same commands.", "this project"),
        Law::Dissipation => (
            "A brake may only apply force in a direction that opposes velocity.",
            "thesis, chapter 1 and §5.3.4",
        ),
        Law::Passivity => (
            "The brakes only take energy out; the operator's force is the only supply.",
            "thesis, §5.3.5",
        ),
        Law::BrakeCount => (
            "One brake acts at a time, or all of them, to immobilize.",
            "thesis, §6.1.2",
        ),
        Law::Lock => (
            "Locked if the input force points away from the path, or if the tip moves back.",
            "thesis, §6.2 and §6.3",
        ),
        Law::Gap => (
            "A gap surrounding the desired path within which no control action is taken.",
            "thesis, §6.5.1",
        ),
        Law::FreeSide => (
            "Control action would only be taken on the obstacle side of the path.",
            "thesis, §7.3",
        ),
        Law::TipForce => (
            "No brake asks for more than the greatest force at the tip.",
            "thesis, §6.1.2",
        ),
        Law::Influence => (
            "The brake that acts takes most rightly from the unwanted velocity.",
            "thesis, §6.3",
        ),
        Law::QuarterTurn => (
            "The brake that acts leads between the path's direction and the way to it.",
            "thesis, §6.2",
        ),
        Law::Reference => (
            "The currents are those of the law of the thesis that is claimed.",
            "thesis, chapter 6",
        ),
    }
}

/// Every sentence that a plan is about, the laboratory's first.
pub fn table(plan: &Plan, laws: &[LawSummary], metrics: &[MetricSummary]) -> Vec<Requirement> {
    let own = plan.requirements.iter();
    let own = own.map(|asked| (asked.says.clone(), LABORATORY, asked.by));
    let theirs = laws.iter().map(|law| {
        let (says, source) = sentence(law.law);
        (says.to_owned(), source, Target::Law(law.law))
    });
    own.chain(theirs)
        .map(|(says, source, by)| {
            let (trials, margin, holds) = match by {
                Target::Law(law) | Target::Premise(law) => of_law(law, laws),
                Target::Metric(metric) => of_metric(metric, metrics),
            };
            Requirement {
                says,
                source: source.to_owned(),
                by,
                trials,
                margin,
                unit: by.unit().to_owned(),
                holds,
            }
        })
        .collect()
}

fn of_law(law: Law, laws: &[LawSummary]) -> (u64, Option<f64>, bool) {
    let own = laws.iter().find(|own| own.law == law);
    own.map_or((0, None, false), |own| {
        (own.met.trials, own.worst_margin, own.holds())
    })
}

fn of_metric(metric: Metric, metrics: &[MetricSummary]) -> (u64, Option<f64>, bool) {
    let own = metrics.iter().find(|own| own.metric == metric);
    own.map_or((0, None, false), |own| {
        let below = own
            .limits
            .iter()
            .map(|limit| Some(limit.most - limit.value?));
        let margin = below.reduce(|one, other| Some(one?.min(other?)));
        let trials = own.controller.map_or(0, |own| own.trials);
        let holds = !own.limits.is_empty() && own.limits.iter().all(|limit| limit.holds);
        (trials, margin.flatten(), holds)
    })
}
