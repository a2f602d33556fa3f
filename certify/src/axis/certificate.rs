//! This file is the certificate of a controller of an axis: what was run, how it fared, and what was not looked at.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::campaign::Record;
use super::law::Law;
use super::metrics::{MetricSummary, baseline_broke, metrics};
use super::plan::{FORM, Library, Plan};
use super::trial::Ending;
use crate::campaign::CHUNK;
use crate::certificate::{Hashes, chunk_digest};
use crate::digest;
use crate::error::Error;
use crate::summary::{ISOLATION, NotLookedAt};
use crate::tool::Tool;

/// What stands as `plant` in its file.
pub const PLANT: &str = "axis";

/// A certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`FORM`].
    pub form: u32,
    /// [`PLANT`].
    pub plant: String,
    /// What people call the change.
    pub name: String,
    /// Whether it may go on the rig: written for whoever reads the file, and never read ([`Certificate::may_go`]).
    pub may_go_on_the_rig: bool,
    /// Why not, a sentence each.
    pub reasons: Vec<String>,
    /// What ran it.
    pub tool: Tool,
    /// What was run.
    pub plan: Plan,
    /// The hashes of what it depends on.
    pub sha256: Hashes,
    /// How the trials ended; the ways exclude each other and sum to the trials.
    pub ended: Endings,
    /// Trials in which the baseline ended otherwise than by its time.
    pub baseline_broke: u64,
    /// Samples of all trials.
    pub samples: u64,
    /// How every law fared.
    pub laws: Vec<LawSummary>,
    /// The metrics.
    pub metrics: Vec<MetricSummary>,
    /// How the controller broke first, if it did.
    pub first_failure: Option<String>,
    /// Not looked at.
    pub not_looked_at: Vec<NotLookedAt>,
    /// The first 16 digits of the SHA-256 of the records of every eight trials, in their order.
    pub chunks: Vec<String>,
    /// The SHA-256 of this file with nothing between these quotes.
    pub digest: String,
}

/// How many trials ended in each way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Endings {
    /// Their time was over.
    pub time_over: u64,
    /// The axis came to a stop of its travel.
    pub at_stop: u64,
    /// The controller did not answer.
    pub no_answer: u64,
}

/// How one law fared in a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawSummary {
    /// The law.
    pub law: Law,
    /// What it says.
    pub words: String,
    /// Samples that were held to it.
    pub samples: u64,
    /// Trials with such a sample.
    pub met_in: u64,
    /// In how many trials that has to be.
    pub least_met: u64,
    /// Trials in which it was broken.
    pub broken_in: u64,
    /// The first of them.
    pub first_broken: Option<u64>,
    /// The least margin; none without samples, or where it was no number.
    pub worst_margin: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// The trial of the least margin.
    pub worst_scenario: Option<u64>,
}

impl Certificate {
    /// The certificate of a campaign whose trials have all been run.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn new(plan: &Plan, records: &[Record], tool: Tool) -> Result<Certificate, Error> {
        let chunks = records.chunks(CHUNK as usize).map(chunk_digest);
        let chunks = chunks.collect::<Result<Vec<String>, Error>>()?;
        let laws = Law::ALL.into_iter();
        let laws = laws.filter(|law| plan.not_looked_at(*law).is_none());
        let certificate = Certificate {
            form: FORM,
            plant: PLANT.to_owned(),
            name: plan.name.clone(),
            may_go_on_the_rig: false,
            reasons: Vec::new(),
            tool,
            plan: plan.clone(),
            sha256: hashes(plan, &chunks)?,
            ended: Endings::of(records),
            baseline_broke: baseline_broke(records),
            samples: records.iter().map(|own| u64::from(own.ticks)).sum(),
            laws: laws.map(|law| of_law(plan, law, records)).collect(),
            metrics: metrics(plan, records),
            first_failure: records.iter().find_map(|own| own.failure.clone()),
            not_looked_at: not_looked_at(plan),
            chunks,
            digest: String::new(),
        };
        certificate.sealed()
    }

    /// With everything computed anew that follows from its plan and its figures: verdict, hashes and digest. That anybody can do; what it says is true
    /// only if its trials come to it when they are run again ([`Certificate::unlike`]).
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn sealed(mut self) -> Result<Certificate, Error> {
        self.reasons = self.own_reasons();
        self.may_go_on_the_rig = self.reasons.is_empty();
        self.sha256 = hashes(&self.plan, &self.chunks)?;
        self.digest = self.own_digest()?;
        Ok(self)
    }

    fn own_digest(&self) -> Result<String, Error> {
        let blank = Certificate {
            digest: String::new(),
            ..self.clone()
        };
        Ok(digest::of_bytes(blank.to_json()?.as_bytes()))
    }

    /// As a file.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Whether a text is the certificate of an axis, whole or not.
    pub fn is_one(text: &str) -> bool {
        let read = serde_json::from_str::<serde_json::Value>(text);
        read.is_ok_and(|read| read.get("plant").and_then(|own| own.as_str()) == Some(PLANT))
    }

    /// A certificate from its file, every byte of it as it was written and every hash that follows from it recomputed.
    ///
    /// # Errors
    /// Something was changed.
    pub fn parse(text: &str, file: &Path) -> Result<Certificate, Error> {
        let refused = |problem: String| {
            let advice = "it was changed after it was written; run the campaign again";
            Error::unusable(file, format!("{problem}: {advice}"))
        };
        let read: Certificate = serde_json::from_str(text)
            .map_err(|error| refused(format!("it is no certificate of an axis ({error})")))?;
        if read.form != FORM || read.plant != PLANT || read.name != read.plan.name {
            return Err(refused("form, plant or name are others".to_owned()));
        }
        let own = read.own_digest()?;
        if read.to_json()? != text || own != read.digest {
            return Err(refused(format!(
                "its SHA-256 is {own}, not {}",
                read.digest
            )));
        }
        if hashes(&read.plan, &read.chunks)? != read.sha256 {
            return Err(refused("its hashes do not follow from it".to_owned()));
        }
        if read.own_reasons() != read.reasons || read.may_go_on_the_rig != read.may_go() {
            return Err(refused(
                "its verdict does not follow from its figures".to_owned(),
            ));
        }
        Ok(read)
    }

    /// Whether it may go on the rig, by its figures.
    pub fn may_go(&self) -> bool {
        self.own_reasons().is_empty()
    }

    /// What of it does not come to the same when it is built anew from all of its trials, a sentence each; the verdict follows from figures.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn unlike(&self, again: &[Record]) -> Result<Vec<String>, Error> {
        let anew = Certificate::new(&self.plan, again, self.tool.clone())?;
        let parts = [
            ("how its trials ended", self.ended != anew.ended),
            (
                "its baseline's trials",
                self.baseline_broke != anew.baseline_broke,
            ),
            ("its number of samples", self.samples != anew.samples),
            ("its laws", self.laws != anew.laws),
            ("its metrics", self.metrics != anew.metrics),
            (
                "its first failure",
                self.first_failure != anew.first_failure,
            ),
            (
                "what it did not look at",
                self.not_looked_at != anew.not_looked_at,
            ),
            ("the records of its trials", self.chunks != anew.chunks),
            ("its verdict", self.reasons != anew.reasons),
        ];
        let unlike = parts.into_iter().filter(|(_, is_unlike)| *is_unlike);
        Ok(unlike
            .map(|(what, _)| format!("{what} came out otherwise when all trials were run again"))
            .collect())
    }

    fn own_reasons(&self) -> Vec<String> {
        let not_run = self.plan.axis.not_run.iter().map(|own| {
            let (mechanism, why) = (&own.mechanism, &own.why);
            format!("the axis has `{mechanism}`, which no trial runs: {why}")
        });
        let laws = self.laws.iter().filter_map(LawSummary::reason);
        let metrics = self.metrics.iter().flat_map(MetricSummary::reasons);
        let broke = self.baseline_broke;
        let baseline = (broke > 0).then(|| {
            format!("the baseline came to a stop or did not answer in {broke} trials: what stands beside it is no measure")
        });
        not_run.chain(laws).chain(metrics).chain(baseline).collect()
    }
}

/// The hashes of a plan and of the records of its trials; the rig is the axis, its numbers and their intervals.
fn hashes(plan: &Plan, chunks: &[String]) -> Result<Hashes, Error> {
    let baseline = plan.baseline.as_ref().map(digest::of_value);
    Ok(Hashes {
        controller: digest::of_value(&plan.controller)?,
        baseline: baseline.transpose()?,
        rig: digest::of_value(&plan.axis)?,
        plan: digest::of_value(plan)?,
        records: digest::of_value(&chunks)?,
    })
}

impl Endings {
    fn of(records: &[Record]) -> Endings {
        let count = |ending: Ending| {
            let all = records.iter().filter(|own| own.ending == ending);
            all.count() as u64
        };
        Endings {
            time_over: count(Ending::Time),
            at_stop: count(Ending::AtStop),
            no_answer: count(Ending::NoAnswer),
        }
    }
}

impl LawSummary {
    /// Why it does not hold, as a sentence.
    fn reason(&self) -> Option<String> {
        let name = self.law.name();
        if let Some(first) = self.first_broken {
            let (count, words) = (self.broken_in, &self.words);
            return Some(format!(
                "the law {name} is broken in {count} trials, first in trial {first}: {words}"
            ));
        }
        let (met, least) = (self.met_in, self.least_met);
        (met < least).then(|| {
            format!(
                "the law {name} was looked at in {met} trials, and at least {least} are asked for: run more or longer trials, or declare less"
            )
        })
    }
}

fn of_law(plan: &Plan, law: Law, records: &[Record]) -> LawSummary {
    let mut summary = LawSummary {
        law,
        words: law.words().to_owned(),
        samples: 0,
        met_in: 0,
        least_met: plan.least_met(),
        broken_in: 0,
        first_broken: None,
        worst_margin: None,
        unit: law.unit(plan.axis.units()).to_owned(),
        worst_scenario: None,
    };
    let mut worst = f64::MAX;
    for record in records {
        let Some(fared) = record.fared.get(law as usize) else {
            continue;
        };
        summary.samples += fared.samples;
        summary.met_in += u64::from(fared.samples > 0);
        if fared.broken > 0 {
            summary.broken_in += 1;
            summary.first_broken.get_or_insert(record.index);
        }
        if fared.worst < worst {
            worst = fared.worst;
            summary.worst_scenario = Some(record.index);
        }
    }
    summary.worst_margin = (worst < f64::MAX && worst > f64::MIN).then_some(worst);
    summary
}

/// The laws that are not looked at, and what no campaign of an axis sees.
fn not_looked_at(plan: &Plan) -> Vec<NotLookedAt> {
    let laws = Law::ALL.into_iter();
    let laws = laws.filter_map(|law| Some((law.name(), plan.not_looked_at(law)?)));
    let noise = (plan.axis.noise == 0.0).then_some((
        "noise",
        "the axis states no noise of its position: none was drawn",
    ));
    let baseline = plan
        .baseline
        .is_none()
        .then_some(("baseline", "no controller stands beside it"));
    let always = [
        (
            "load",
            "efforts on the axis from outside, payloads beyond its intervals, and hands",
        ),
        ("faults", "samples that are missed, repeated or no numbers"),
        (
            "timing",
            "jitter of the sample time, and how long a sample takes on the rig's computer",
        ),
        (
            "amplifier",
            "what an amplifier does when no command comes: it needs a watchdog of its own",
        ),
    ];
    let lacks = std::iter::once(&plan.controller).chain(&plan.baseline);
    let lacks = lacks.flat_map(|own: &Library| own.lacks.iter().map(String::as_str));
    let mut isolation = vec![ISOLATION];
    isolation.extend(lacks);
    isolation.dedup();
    let isolation = isolation.into_iter().map(|why| ("isolation", why));
    let all = laws
        .chain(noise)
        .chain(baseline)
        .chain(always)
        .chain(isolation);
    all.map(|(what, why)| NotLookedAt {
        what: what.to_owned(),
        why: why.to_owned(),
    })
    .collect()
}
