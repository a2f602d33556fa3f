//! This file is the certificate: what was run, how it fared, what was proved, tested and not looked at; a changed byte is refused.

mod reasons;

use std::path::Path;

use rigproof_spec::methods::BLEND_BOUNDARY_M;
use serde::{Deserialize, Serialize};

use self::reasons::reasons;
use crate::axis;
use crate::cluster::{Cluster, clusters};
use crate::digest;
use crate::error::Error;
use crate::finding::Named;
use crate::journal::Chunks;
use crate::metrics::Metric;
use crate::plan::{FORM, Plan};
use crate::proved::{Ledger, Proved, proved};
use crate::record::Record;
use crate::requirement::{self, Requirement};
use crate::search::NamedWorst;
use crate::shape;
use crate::summary::{
    Ended, LawSummary, MetricSummary, NotLookedAt, TieSummary, Visited, ended, laws, metrics,
    not_looked_at, ties, visited,
};
use crate::tool::Tool;

/// The files in which a campaign's folder shows its verdict: the certificate, its signature and its page.
pub const VERDICT: [&str; 3] = [
    "certificate.json",
    "certificate.json.sig",
    "certificate.html",
];

/// A certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`FORM`].
    pub form: u32,
    /// What people call the change.
    pub name: String,
    /// Whether it may go on the rig, as far as this campaign can say: written for whoever reads the file, and never read ([`Certificate::may_go`]).
    pub may_go_on_the_rig: bool,
    /// Why not, a sentence each.
    pub reasons: Vec<String>,
    /// What ran it.
    pub tool: Tool,
    /// What was run.
    pub plan: Plan,
    /// The hashes of what it depends on.
    pub sha256: Hashes,
    /// Tested: how the trials ended.
    pub ended: Ended,
    /// Samples of all trials.
    pub samples: u64,
    /// Tested: how every law fared.
    pub laws: Vec<LawSummary>,
    /// Tested: what is asked for, with what stands for it and how that fared.
    pub requirements: Vec<Requirement>,
    /// Tested: in which parts of workspace, speed, force and fault samples lay.
    pub visited: Visited,
    /// Tested: the samples in which the reference may decide otherwise, by why.
    pub ties: Vec<TieSummary>,
    /// Tested: the metrics.
    pub metrics: Vec<MetricSummary>,
    /// Searched: the worst cases that were found.
    pub worst: Vec<NamedWorst>,
    /// Proved.
    pub proved: Proved,
    /// Not looked at.
    pub not_looked_at: Vec<NotLookedAt>,
    /// What broke a law, in files beside this one.
    pub findings: Vec<Named>,
    /// What the trials that broke a law have in common, the most frequent first.
    pub clusters: Vec<Cluster>,
    /// The first 16 digits of the SHA-256 of the records of every chunk of scenarios, in their order.
    pub chunks: Vec<String>,
    /// The SHA-256 of this file with nothing between these quotes.
    pub digest: String,
}

/// What a result depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hashes {
    /// The controller: kind and parameters, or its code, and what it declares.
    pub controller: String,
    /// The baseline.
    pub baseline: Option<String>,
    /// The rigs: arms, brakes and inertias of the layouts, or the numbers of an axis and their intervals.
    pub rig: String,
    /// The plan: everything above, seed, number and length of the trials, limits.
    pub plan: String,
    /// The records of all scenarios.
    pub records: String,
}

impl Hashes {
    fn of(plan: &Plan, chunks: &[String]) -> Result<Hashes, Error> {
        let rigs = plan.rigs.iter();
        // Debug of a number is the shortest text that reads back as it.
        let rigs = rigs.map(|rig| {
            let parameters = rigproof_impl::plant::Parameters::of(rig.layout());
            format!("{parameters:?}")
        });
        let baseline = plan.baseline.as_ref().map(digest::of_value);
        Ok(Hashes {
            controller: digest::of_value(&plan.controller)?,
            baseline: baseline.transpose()?,
            rig: digest::of_bytes(rigs.collect::<Vec<_>>().join("\n").as_bytes()),
            plan: plan.digest()?,
            records: digest::of_value(&chunks)?,
        })
    }
}

/// The records of all chunks, in the order of the scenarios.
pub fn records(chunks: &Chunks) -> Vec<&Record> {
    chunks.values().flatten().collect()
}

/// The first digits of the SHA-256 of a chunk's records.
pub(crate) fn chunk_digest(records: &[impl Serialize]) -> Result<String, Error> {
    Ok(digest::of_value(&records)?.chars().take(16).collect())
}

impl Certificate {
    /// The certificate of a campaign that is whole.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn new(
        plan: &Plan,
        chunks: &Chunks,
        findings: Vec<Named>,
        worst: Vec<NamedWorst>,
        tool: Tool,
    ) -> Result<Certificate, Error> {
        let records = records(chunks);
        let digests: Result<Vec<String>, Error> =
            chunks.values().map(|c| chunk_digest(c)).collect();
        let digests = digests?;
        let certificate = Certificate {
            form: FORM,
            name: plan.name.clone(),
            may_go_on_the_rig: false,
            reasons: Vec::new(),
            tool,
            sha256: Hashes::of(plan, &digests)?,
            plan: plan.clone(),
            ended: ended(plan, &records),
            samples: records.iter().map(|record| u64::from(record.ticks)).sum(),
            laws: laws(plan, &records),
            requirements: Vec::new(),
            visited: visited(&records),
            ties: ties(&records),
            metrics: metrics(plan, &records),
            worst,
            proved: proved(&plan.controller)?,
            not_looked_at: not_looked_at(plan),
            findings,
            clusters: clusters(plan, &records),
            chunks: digests,
            digest: String::new(),
        };
        certificate.sealed()
    }

    /// With the examples of its clusters.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn with_examples(mut self, examples: Vec<Option<Named>>) -> Result<Certificate, Error> {
        for (cluster, example) in self.clusters.iter_mut().zip(examples) {
            cluster.example = example;
        }
        self.sealed()
    }

    /// With everything computed anew that follows from its plan, its figures and the hashes of its records: requirements, verdict, hashes and digest. That anybody can do;
    /// what it says is true only if its scenarios come to it when they are run again ([`crate::recheck`]).
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn sealed(mut self) -> Result<Certificate, Error> {
        self.requirements = requirement::table(&self.plan, &self.laws, &self.metrics);
        self.reasons = self.own_reasons();
        self.may_go_on_the_rig = self.reasons.is_empty();
        self.sha256 = Hashes::of(&self.plan, &self.chunks)?;
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

    /// A certificate from its file, every byte of it as it was written and every hash that follows from it recomputed.
    ///
    /// # Errors
    /// Something was changed.
    pub fn parse(text: &str, file: &Path) -> Result<Certificate, Error> {
        let refused = |problem: String| {
            let advice = "it was changed after it was written; run the campaign again";
            Error::unusable(file, format!("{problem}: {advice}"))
        };
        if axis::certificate::Certificate::is_one(text) {
            let problem = "it is the certificate of an axis: `rigproof certify --check` and `rigproof certify sign` take it";
            return Err(Error::unusable(file, problem));
        }
        let read: Certificate = serde_json::from_str(text)
            .map_err(|error| refused(format!("it is no certificate ({error})")))?;
        if read.form != FORM {
            let form = read.form;
            return Err(refused(format!("its form is {form}, not {FORM}")));
        }
        if read.to_json()? != text {
            return Err(refused(
                "it is not in the form this program writes".to_owned(),
            ));
        }
        let own = read.own_digest()?;
        if own != read.digest {
            return Err(refused(format!(
                "its SHA-256 is {own}, not {}",
                read.digest
            )));
        }
        if let Some(problem) = shape::problem(&read) {
            return Err(refused(problem));
        }
        let hashes = Hashes::of(&read.plan, &read.chunks)?;
        if hashes != read.sha256 {
            return Err(refused(
                "the hashes of controller, rig, plan or records do not follow from it".to_owned(),
            ));
        }
        if requirement::table(&read.plan, &read.laws, &read.metrics) != read.requirements {
            return Err(refused(
                "its table of requirements does not follow from its figures".to_owned(),
            ));
        }
        if read.own_reasons() != read.reasons || read.may_go_on_the_rig != read.reasons.is_empty() {
            return Err(refused(
                "its verdict does not follow from its figures".to_owned(),
            ));
        }
        if read.ledger()? == Ledger::Changed {
            return Err(refused(
                "what it calls proved is not what the ledger proves that it names".to_owned(),
            ));
        }
        Ok(read)
    }

    /// Whether it may go on the rig, by its figures.
    pub fn may_go(&self) -> bool {
        self.own_reasons().is_empty()
    }

    fn own_reasons(&self) -> Vec<String> {
        reasons(
            &self.laws,
            &self.ties,
            &self.findings,
            &self.metrics,
            &self.requirements,
        )
    }

    /// What a person is to look at although it is no reason against, a sentence each: a trial far off the path.
    pub fn cautions(&self) -> Vec<String> {
        let own = self
            .metrics
            .iter()
            .find(|own| own.metric == Metric::PathError);
        let greatest = own.and_then(|own| Some((own.controller?.greatest, own.worst_scenario?)));
        let far = greatest.filter(|(error_m, _)| *error_m > BLEND_BOUNDARY_M);
        let sentence = |(error_m, index): (f64, u64)| {
            format!(
                "in trial {index} the tip was {:.0} mm off the path in the mean, beyond the {:.0} mm at which the velocity field points straight back to it",
                1e3 * error_m,
                1e3 * BLEND_BOUNDARY_M
            )
        };
        far.map(sentence).into_iter().collect()
    }

    /// How what it calls proved lies to this program's ledger.
    ///
    /// # Errors
    /// The ledger is not as it was written.
    pub fn ledger(&self) -> Result<Ledger, Error> {
        Ok(self.proved.beside(&proved(&self.plan.controller)?))
    }
}
