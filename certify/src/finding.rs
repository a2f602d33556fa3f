//! This file is a finding: a law, a scenario that breaks it, and the recording of that.

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_trace::mcap::{Extras, to_bytes};
use rigproof_trace::{Channel, Trace};
use serde::{Deserialize, Serialize};

use crate::controller::Source;
use crate::digest;
use crate::error::Error;
use crate::law::Law;
use crate::plan::{FORM, Plan, Subject};
use crate::record::Record;
use crate::scenario::Scenario;
use crate::search::{Met, Target};
use crate::shrink::{Shrunk, shrink};
use crate::trial::{Ran, run};

/// Most samples of a scenario: an hour.
pub(crate) const MOST_TICKS: u32 = 3_600_000;

/// A broken law with a scenario that anybody can run again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// [`FORM`].
    pub form: u32,
    /// The law.
    pub law: Law,
    /// What it says.
    pub words: String,
    /// The scenario of the campaign in which it was seen first, or in which the search began that met it.
    pub scenario_index: u64,
    /// What was searched for when it was met; `None` where the scenario was drawn.
    pub searched: Option<Target>,
    /// The sample that breaks it, after shrinking.
    pub tick: u32,
    /// The least margin.
    pub margin: f64,
    /// How the controller broke, if it did, after shrinking.
    pub failure: Option<String>,
    /// Trials that shrinking took.
    pub trials: u32,
    /// The controller.
    pub controller: Subject,
    /// The scenario, as short and plain as it was made.
    pub scenario: Scenario,
    /// The SHA-256 of this file with nothing between these quotes.
    pub digest: String,
}

/// A finding as the certificate names it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// The law.
    pub law: Law,
    /// The scenario of the campaign, or that in which the search began.
    pub scenario: u64,
    /// What was searched for when it was met; `None` where it was drawn.
    pub searched: Option<Target>,
    /// Rig time until the law is broken, after shrinking, s.
    pub time_s: f64,
    /// How the controller broke, if it did.
    pub failure: Option<String>,
    /// The file, beside the certificate.
    pub file: String,
    /// Its SHA-256.
    pub sha256: String,
}

impl Finding {
    /// The shrunk findings of a campaign, one of every law that is broken: in the first scenario that was drawn and breaks it, or else in the one that
    /// a search met. A law that is broken once and not again in the scenario that was drawn has none: the verdict stands all the same.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn all(
        plan: &Plan,
        source: &dyn Source,
        records: &[&Record],
        met: &[Met],
    ) -> Result<Vec<Finding>, Error> {
        let of = |law: Law| {
            let mut drawn = records.iter();
            let drawn = drawn.find(|record| {
                let fared = record.fared.get(law as usize);
                fared.is_some_and(|fared| fared.broken > 0)
            });
            match drawn {
                Some(record) => Finding::of(plan, source, law, record.index),
                None => {
                    let met = met.iter().find(|met| met.law == law);
                    met.map(|met| Finding::met(plan, source, met)).transpose()
                }
            }
        };
        let all = Law::ALL.into_iter().map(of);
        all.filter_map(Result::transpose).collect()
    }

    /// The shrunk finding of a law in a scenario of a plan; `None` where the law is not broken there.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn of(
        plan: &Plan,
        source: &dyn Source,
        law: Law,
        index: u64,
    ) -> Result<Option<Finding>, Error> {
        let declared = &plan.controller.declared;
        let shrunk = shrink(&plan.scenario(index), law, source, declared);
        let found = shrunk.map(|shrunk| Finding::new(plan, law, index, None, shrunk));
        found.transpose()
    }

    /// The shrunk finding of what a search met; as it was met where it is not broken again, so that it is not lost.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn met(plan: &Plan, source: &dyn Source, met: &Met) -> Result<Finding, Error> {
        let shrunk = shrink(&met.scenario, met.law, source, &plan.controller.declared);
        let shrunk = shrunk.unwrap_or_else(|| Shrunk {
            scenario: met.scenario.clone(),
            tick: met.tick,
            margin: met.margin,
            failure: met.failure.clone(),
            trials: 1,
        });
        Finding::new(plan, met.law, met.begun_in, Some(met.target), shrunk)
    }

    fn new(
        plan: &Plan,
        law: Law,
        scenario_index: u64,
        searched: Option<Target>,
        shrunk: Shrunk,
    ) -> Result<Finding, Error> {
        let finding = Finding {
            form: FORM,
            law,
            words: law.words().to_owned(),
            scenario_index,
            searched,
            tick: shrunk.tick,
            margin: shrunk.margin,
            failure: shrunk.failure,
            trials: shrunk.trials,
            controller: plan.controller.clone(),
            scenario: shrunk.scenario,
            digest: String::new(),
        };
        finding.sealed()
    }

    /// Whether it is what a certificate names.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn is(&self, named: &Named) -> Result<bool, Error> {
        Ok(self.named()? == *named)
    }

    /// Whether its law is broken again by as much, at the same sample.
    ///
    /// # Errors
    /// [`Error::Scenario`].
    pub fn comes_again(&self, source: &dyn Source) -> Result<bool, Error> {
        let ran = self.replayed(source)?;
        let own = ran.fared.get(self.law as usize);
        Ok(own.is_some_and(|own| own.first == Some(self.tick) && own.worst == self.margin))
    }

    /// The file's name, without its ending.
    pub fn stem(&self) -> String {
        Finding::stem_of(self.law)
    }

    /// The name of the file of a law's finding, without its ending.
    pub fn stem_of(law: Law) -> String {
        format!("finding-{}", law.name())
    }

    /// With its own SHA-256 computed.
    fn sealed(mut self) -> Result<Finding, Error> {
        self.digest = self.own_digest()?;
        Ok(self)
    }

    fn own_digest(&self) -> Result<String, Error> {
        let blank = Finding {
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

    /// A finding from its file.
    ///
    /// # Errors
    /// It is not as it was written.
    pub fn parse(text: &str, file: &Path) -> Result<Finding, Error> {
        let finding: Finding = serde_json::from_str(text).map_err(|error| {
            let advice = "hand over the file as `rigproof certify` wrote it";
            Error::unusable(file, format!("it is no finding: {error}; {advice}"))
        })?;
        if finding.scenario.ticks > MOST_TICKS {
            let ticks = finding.scenario.ticks;
            let problem = format!("its scenario has {ticks} samples; give at most {MOST_TICKS}");
            return Err(Error::unusable(file, problem));
        }
        if finding.form != FORM {
            let form = finding.form;
            let problem = format!(
                "it has form {form}, this program reads form {FORM}; take the program that wrote it"
            );
            return Err(Error::unusable(file, problem));
        }
        if finding.to_json()? != text || finding.own_digest()? != finding.digest {
            let advice = "it was changed after it was written; hand over the file as `rigproof certify` wrote it";
            let problem = format!("its SHA-256 is not that of what it says: {advice}");
            return Err(Error::unusable(file, problem));
        }
        Ok(finding)
    }

    /// How the certificate names it.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn named(&self) -> Result<Named, Error> {
        Ok(Named {
            law: self.law,
            scenario: self.scenario_index,
            searched: self.searched,
            time_s: f64::from(self.tick + 1) * SAMPLE_STEP_S,
            failure: self.failure.clone(),
            file: self.stem() + ".json",
            sha256: digest::of_bytes(self.to_json()?.as_bytes()),
        })
    }

    /// Runs it again.
    ///
    /// # Errors
    /// [`Error::Scenario`].
    pub fn replayed(&self, source: &dyn Source) -> Result<Ran, Error> {
        let ran = run(&self.scenario, source, &self.controller.declared, true);
        ran.ok_or(Error::Scenario(self.scenario_index))
    }

    /// Its recording as an MCAP file, with the finding attached.
    ///
    /// # Errors
    /// It cannot be run or written.
    pub fn to_mcap(&self, source: &dyn Source) -> Result<Vec<u8>, Error> {
        let ran = self.replayed(source)?;
        let attached = (
            self.stem() + ".json",
            "application/json".to_owned(),
            self.to_json()?.into_bytes(),
        );
        let extras = Extras {
            attachments: vec![attached],
            texts: BTreeMap::from([("law".to_owned(), self.words.clone())]),
        };
        to_bytes(&trace(&ran), &extras)
            .map_err(|problem| Error::unusable(Path::new(&self.stem()), problem))
    }
}

/// A trial as a recording: what the plant did, what was told, what was commanded. What is infinite is left out as missing.
fn trace(ran: &Ran) -> Trace {
    let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
    let mut channels = Vec::new();
    let mut add = |name: &str, unit: &str, samples: Vec<f64>| {
        channels.push(Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples: samples.into_iter().map(finite).collect(),
        });
    };
    let of = |value: fn(&crate::trial::State) -> f64| ran.states.iter().map(value).collect();
    add("theta_a", "rad", of(|state| state.theta_rad[0]));
    add("theta_b", "rad", of(|state| state.theta_rad[1]));
    add("tip_x", "m", of(|state| state.tip_m[0]));
    add("tip_y", "m", of(|state| state.tip_m[1]));
    add("force_x", "N", of(|state| state.force_n[0]));
    add("force_y", "N", of(|state| state.force_n[1]));
    for (joint, name) in ["current_a", "current_e", "current_b", "current_c"]
        .into_iter()
        .enumerate()
    {
        let currents = ran.told.iter().filter_map(|(_, a)| a.get(joint).copied());
        add(name, "A", currents.collect());
    }
    let told = |value: fn(&rigproof_impl::tick::Sensed<f64>) -> f64| {
        ran.told.iter().map(|(sensed, _)| value(sensed)).collect()
    };
    add("told_number", "", told(|sensed| f64::from(sensed.number)));
    add(
        "told_count_a",
        "",
        told(|sensed| f64::from(sensed.counts[0])),
    );
    add(
        "told_count_b",
        "",
        told(|sensed| f64::from(sensed.counts[1])),
    );
    add("told_force_x", "N", told(|sensed| sensed.tip_force_n.x));
    add("told_force_y", "N", told(|sensed| sensed.tip_force_n.y));
    let time = (0..ran.told.len()).map(|tick| tick as f64 * SAMPLE_STEP_S);
    Trace {
        time_s: time.collect(),
        channels,
    }
}
