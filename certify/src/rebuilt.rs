//! This file builds a certificate's figures anew from records and says which of them disagree; what only some of the records are at hand for is held to what they allow.

use serde::Serialize;

use crate::certificate::{Certificate, records};
use crate::cluster::{self, Cluster, MOST};
use crate::digest;
use crate::error::Error;
use crate::finding::{Finding, Named};
use crate::journal::Chunks;
use crate::law::Law;
use crate::plan::Sources;
use crate::record::Record;
use crate::search::{Worst, search, targets};
use crate::summary::{self, LawSummary, MetricSummary};

impl Certificate {
    /// The figures that do not come out of the records of all its scenarios, a sentence each.
    ///
    /// # Errors
    /// It cannot be written as JSON.
    pub fn unlike(&self, chunks: &Chunks) -> Result<Vec<String>, Error> {
        let (findings, worst) = (self.findings.clone(), self.worst.clone());
        let own = Certificate::new(&self.plan, chunks, findings, worst, self.tool.clone())?;
        let mut wrong = Vec::new();
        let pairs = own.laws.iter().zip(&self.laws);
        for (own, said) in pairs.filter(|(own, said)| !same(own, said)) {
            let (name, own, said) = (own.law.name(), own.broken_in, said.broken_in);
            wrong.push(format!("what it says of the law {name} is not what its records say: it is broken in {own} scenarios, and it says {said}, or another of its figures differs"));
        }
        let pairs = own.metrics.iter().zip(&self.metrics);
        for (own, _) in pairs.filter(|(own, said)| !same(own, said)) {
            let key = own.metric.key();
            wrong.push(format!(
                "what it says of the metric {key} is not what its records say"
            ));
        }
        let others = [
            ("how the trials ended", same(&own.ended, &self.ended)),
            (
                "the number of its samples",
                same(&own.samples, &self.samples),
            ),
            ("the ties beside the reference", same(&own.ties, &self.ties)),
            (
                "what the trials that broke a law have in common",
                same(&own.clusters, &bare(&self.clusters)),
            ),
            ("which cells it visited", same(&own.visited, &self.visited)),
            (
                "its table of requirements",
                same(&own.requirements, &self.requirements),
            ),
            ("the hashes of its records", same(&own.chunks, &self.chunks)),
            ("its reasons", same(&own.reasons, &self.reasons)),
        ];
        let others = others.into_iter().filter(|(_, is_same)| !is_same);
        wrong.extend(others.map(|(what, _)| format!("{what} is not what its records say")));
        let drawn = targets(&self.plan, &records(chunks));
        let named = self.worst.iter();
        let named: Vec<_> = named.map(|worst| (worst.target, worst.drawn)).collect();
        if !same(&drawn, &named) {
            wrong.push(
                "the worse cases that a search is to have begun from are not those of its records"
                    .to_owned(),
            );
        }
        Ok(wrong)
    }

    /// What does not come out when search and shrinking are run again over the records of all its scenarios. A controller that does not answer the same
    /// samples alike need not find the same again.
    ///
    /// # Errors
    /// [`Error::Scenario`].
    pub fn found_otherwise(
        &self,
        chunks: &Chunks,
        sources: &Sources<'_>,
    ) -> Result<Vec<String>, Error> {
        let repeats = |law: &LawSummary| law.law == Law::Repeats && law.broken_in > 0;
        if summary::laws(&self.plan, &records(chunks))
            .iter()
            .any(repeats)
        {
            return Ok(Vec::new());
        }
        let searched = search(&self.plan, sources.controller, &records(chunks))?;
        let found = Finding::all(
            &self.plan,
            sources.controller,
            &records(chunks),
            &searched.met,
        )?;
        let found: Vec<Named> = found.iter().map(Finding::named).collect::<Result<_, _>>()?;
        let worst = searched.worst.iter().map(Worst::named);
        let worst: Vec<_> = worst.collect::<Result<_, _>>()?;
        let examples = cluster::examples(&self.plan, sources.controller, &self.clusters)?;
        let examples = cluster::named(&examples)?;
        let said: Vec<_> = self.clusters.iter().map(|own| &own.example).collect();
        let both = [
            (
                "examples",
                same(&examples.iter().collect::<Vec<_>>(), &said),
            ),
            ("findings", same(&found, &self.findings)),
            ("worse cases", same(&worst, &self.worst)),
        ];
        let both = both.into_iter().filter(|(_, is_same)| !is_same);
        Ok(both
            .map(|(what, _)| format!("its {what} are not those that come out again"))
            .collect())
    }

    /// The figures that cannot be, whatever the other scenarios did, where these records are some of its own.
    pub fn impossible(&self, some: &[&Record]) -> Vec<String> {
        let mut wrong = Vec::new();
        let own = summary::laws(&self.plan, some);
        for (own, said) in own.iter().zip(&self.laws) {
            wrong.extend(impossible_law(own, said, some));
        }
        let samples: u64 = some.iter().map(|record| u64::from(record.ticks)).sum();
        if samples > self.samples {
            wrong.push(format!(
                "it counts {} samples, and the scenarios run again have {samples}",
                self.samples
            ));
        }
        let own = summary::ended(&self.plan, some).controller;
        let both = own.each().into_iter().zip(self.ended.controller.each());
        if both.into_iter().any(|(own, said)| own > said) {
            wrong.push(
                "fewer of its trials ended in one of the ways than of those that were run again"
                    .to_owned(),
            );
        }
        let clusters = cluster::clusters(&self.plan, some);
        let is_said = |own: &Cluster| {
            self.clusters.len() == MOST || self.clusters.iter().any(|said| said.holds(own))
        };
        if !clusters.iter().all(is_said) {
            wrong.push("it knows less of what broke a law than the scenarios run again".to_owned());
        }
        let again = summary::visited(some);
        let is_visited = |name: &String| !again.never.contains(name);
        if self.visited.never.iter().any(is_visited) {
            wrong.push(
                "it calls a cell never visited in which the scenarios run again were".to_owned(),
            );
        }
        for own in summary::ties(some) {
            let said = self.ties.iter().find(|said| said.tie == own.tie);
            if said.is_none_or(|said| said.trials < own.trials || said.samples < own.samples) {
                let name = own.tie.name();
                wrong.push(format!(
                    "it counts fewer ties of the kind {name} than the scenarios run again have"
                ));
            }
        }
        for (index, said) in self.metrics.iter().enumerate() {
            let values = some
                .iter()
                .filter_map(|record| *record.measured.get(index)?);
            wrong.extend(impossible_metric(said, values.collect()));
        }
        wrong
    }
}

/// Clusters without their examples, which no record tells.
fn bare(clusters: &[Cluster]) -> Vec<Cluster> {
    let without = |own: &Cluster| Cluster {
        example: None,
        ..own.clone()
    };
    clusters.iter().map(without).collect()
}

/// Whether two values are written alike: to the bit, where equal numbers may differ in the sign of a zero.
fn same<T: Serialize>(one: &T, other: &T) -> bool {
    let (one, other) = (digest::of_value(one), digest::of_value(other));
    one.is_ok_and(|one| other.is_ok_and(|other| one == other))
}

/// What of a law is less than its sample alone shows.
fn impossible_law(own: &LawSummary, said: &LawSummary, some: &[&Record]) -> Option<String> {
    let first_is_later = match (own.first_broken, said.first_broken) {
        (Some(own), Some(said)) => said > own,
        (own, said) => own.is_some() && said.is_none(),
    };
    let is_of_these = |index: Option<u64>| {
        index.is_some_and(|index| some.iter().any(|record| record.index == index))
    };
    let worst_is_better = match (own.worst_margin, said.worst_margin) {
        (Some(own), Some(said)) => said > own,
        _ => false,
    };
    let names_another = is_of_these(said.first_broken) && own.first_broken != said.first_broken
        || is_of_these(said.worst_scenario) && own.worst_margin != said.worst_margin;
    let is_met_less = own.met.samples > said.met.samples
        || own.met.trials > said.met.trials
        || own.met.cells > said.met.cells;
    let is_less = own.broken_in > said.broken_in || own.samples > said.samples || is_met_less;
    let cannot_be = is_less || first_is_later || worst_is_better || names_another;
    cannot_be.then(|| {
        format!(
            "what it says of the law {} cannot be: the scenarios run again break it in {} of their own, and it says {}, or another of its figures contradicts theirs",
            own.law.name(), own.broken_in, said.broken_in
        )
    })
}

/// What of a metric contradicts the values of a sample: more of them above or below a quantile than there can be in all.
fn impossible_metric(said: &MetricSummary, values: Vec<f64>) -> Option<String> {
    let words = || {
        let key = said.metric.key();
        Some(format!(
            "what it says of the metric {key} cannot be, by the scenarios run again"
        ))
    };
    let Some(quantiles) = said.controller else {
        return if values.is_empty() { None } else { words() };
    };
    if values.len() as u64 > quantiles.trials {
        return words();
    }
    let Some(last) = quantiles.trials.checked_sub(1) else {
        return words();
    };
    let is_wrong = [
        (0.05, quantiles.q05),
        (0.5, quantiles.q50),
        (0.95, quantiles.q95),
        (1.0, quantiles.greatest),
    ]
    .into_iter()
    .any(|(share, at)| {
        let place = libm::ceil(share * last as f64) as u64;
        let below = values.iter().filter(|value| **value < at).count() as u64;
        let above = values.iter().filter(|value| **value > at).count() as u64;
        below > place || above > last.saturating_sub(place)
    });
    if is_wrong { words() } else { None }
}
