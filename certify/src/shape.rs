//! This file says what no certificate of any campaign can say: figures that its own plan and its other figures rule out, without a trial.

use crate::campaign::CHUNK;
use crate::certificate::Certificate;
use crate::cluster::{Cluster, MOST, stem_of};
use crate::finding::{Finding, MOST_TICKS};
use crate::law::Law;
use crate::plan::{FORM, Subject, What};
use crate::search::{Target, Worst};
use crate::summary::{Bound, LawSummary, MetricSummary, laws, metrics, not_looked_at};

/// Most scenarios of a campaign.
const MOST_SCENARIOS: u64 = 100_000_000;

/// What cannot be, if anything.
pub fn problem(read: &Certificate) -> Option<String> {
    let plan = &read.plan;
    if plan.form != FORM || plan.name != read.name {
        return Some("its name or its form is not its plan's".to_owned());
    }
    if !(1..=MOST_SCENARIOS).contains(&plan.scenarios) || !(1..=MOST_TICKS).contains(&plan.ticks) {
        return Some("its plan has no scenarios or samples, or too many".to_owned());
    }
    let is_of_its_kind = |subject: &Subject| match &subject.what {
        What::BuiltIn(law) => *subject == Subject::built_in(*law),
        What::Given { .. } => false,
    };
    if !plan.baseline.iter().all(is_of_its_kind) {
        return Some("its baseline is no law of the rig as that law is".to_owned());
    }
    let chunks = plan.scenarios.div_ceil(CHUNK);
    if read.chunks.len() as u64 != chunks {
        let has = read.chunks.len();
        return Some(format!(
            "it has records of {has} chunks, and the {} scenarios of its plan make {chunks}",
            plan.scenarios
        ));
    }
    let most = plan.scenarios.saturating_mul(plan.ticks.into());
    if read.samples > most {
        return Some("it counts more samples than its plan has".to_owned());
    }
    if read.not_looked_at != not_looked_at(plan) {
        return Some("what it calls not looked at does not follow from its plan".to_owned());
    }
    let is_as_planned = same_laws(read) && same_metrics(read) && ends(read) && ties(read);
    if !is_as_planned {
        return Some(
            "its figures are not those that its plan asks for, or contradict each other".to_owned(),
        );
    }
    if !clusters(read) {
        return Some(
            "what its failures have in common does not follow from its figures".to_owned(),
        );
    }
    if !found(read) || !worst(read) {
        return Some("its findings or worse cases are not such as its figures allow".to_owned());
    }
    None
}

/// Whether it says something of every law that is looked at, and nothing that contradicts itself.
fn same_laws(read: &Certificate) -> bool {
    let scenarios = read.plan.scenarios;
    let planned = laws(&read.plan, &[]);
    let is_sound = |law: &LawSummary| {
        let inside = |index: Option<u64>| index.is_none_or(|index| index < scenarios);
        law.broken_in <= scenarios
            && (law.broken_in > 0) == law.first_broken.is_some()
            && inside(law.first_broken)
            && inside(law.worst_scenario)
            && (law.samples > 0 || law.broken_in == 0)
            && law.met.samples <= law.samples
            && law.met.trials <= scenarios
            && law.met.cells <= law.met.of_cells
    };
    planned.len() == read.laws.len()
        && planned.iter().zip(&read.laws).all(|(own, said)| {
            (own.law, &own.words, &own.unit) == (said.law, &said.words, &said.unit)
                && own.met.least_trials == said.met.least_trials
                && is_sound(said)
        })
}

/// Whether it says something of every metric, beside the limits of its plan.
fn same_metrics(read: &Certificate) -> bool {
    let scenarios = read.plan.scenarios;
    let planned = metrics(&read.plan, &[]);
    let is_sound = |said: &MetricSummary| {
        let of = [said.controller, said.baseline];
        of.into_iter().flatten().all(|own| {
            (1..=scenarios).contains(&own.trials)
                && own.q05 <= own.q50
                && own.q50 <= own.q95
                && own.q95 <= own.greatest
        }) && said.change.is_none_or(|change| change.pairs <= scenarios)
            && (read.plan.baseline.is_some() || said.baseline.is_none() && said.change.is_none())
    };
    planned.len() == read.metrics.len()
        && planned.iter().zip(&read.metrics).all(|(own, said)| {
            (own.metric, &own.words, &own.unit) == (said.metric, &said.words, &said.unit)
                && (own.limit, own.regression) == (said.limit, said.regression)
                && limits(own).eq(limits(said))
                && is_sound(said)
        })
}

/// The limits that a metric is held to.
fn limits(metric: &MetricSummary) -> impl Iterator<Item = (Bound, f64)> {
    let limits = metric.limits.iter();
    limits.map(|limit| (limit.bound, limit.most))
}

/// Whether every trial ended once.
fn ends(read: &Certificate) -> bool {
    let scenarios = read.plan.scenarios;
    let all = [Some(read.ended.controller), read.ended.baseline];
    all.into_iter().flatten().all(|own| {
        let ended = own.each().into_iter().try_fold(0_u64, u64::checked_add);
        ended == Some(scenarios)
    }) && read.ended.baseline.is_some() == read.plan.baseline.is_some()
}

fn ties(read: &Certificate) -> bool {
    let scenarios = read.plan.scenarios;
    read.ties.iter().all(|own| {
        own.words == own.tie.words()
            && own.most == own.tie.budget().most(scenarios)
            && (1..=scenarios).contains(&own.trials)
            && own.samples >= own.trials
    })
}

/// Whether its findings are of laws that it says to be broken, or that its search met, each law's once and in the file of that law.
fn found(read: &Certificate) -> bool {
    let of = |law: Law| read.laws.iter().find(|own| own.law == law);
    let numbers = read.findings.iter().map(|named| named.law as usize);
    numbers.is_sorted_by(|one, next| one < next)
        && read.findings.iter().all(|named| {
            let is_drawn = of(named.law).is_some_and(|law| match named.searched {
                None => law.first_broken == Some(named.scenario),
                Some(_) => read.plan.search > 0 && law.first_broken.is_none(),
            });
            is_drawn && named.file == Finding::stem_of(named.law) + ".json"
        })
}

/// Whether its clusters are of laws that are broken so often, the largest first, and name files of their own.
fn clusters(read: &Certificate) -> bool {
    let of = |law: Law| {
        let own = read.clusters.iter().filter(|own| own.law == law);
        own.fold(0_u64, |sum, own| sum.saturating_add(own.trials))
    };
    let is_whole = read.clusters.len() < MOST;
    let fits = |law: &LawSummary| match is_whole {
        true => of(law.law) == law.broken_in,
        false => of(law.law) <= law.broken_in,
    };
    let is_known = |own: &Cluster| read.laws.iter().any(|law| law.law == own.law);
    let mut numbered = (1..).zip(&read.clusters);
    read.clusters.len() <= MOST
        && read
            .clusters
            .iter()
            .map(|own| own.trials)
            .is_sorted_by(|one, next| one >= next)
        && read.clusters.iter().all(is_known)
        && read.laws.iter().all(fits)
        && numbered.all(|(number, own)| {
            let file = stem_of(number) + ".json";
            own.example.as_ref().is_none_or(|named| {
                (named.law, named.scenario, &named.file) == (own.law, own.scenario, &file)
            })
        })
}

/// Whether its worse cases are of its search, each target's once and in the file of that target.
fn worst(read: &Certificate) -> bool {
    let place = |target: Target| Target::all().position(|own| own == target);
    let places = read.worst.iter().map(|named| place(named.target));
    (read.plan.search > 0 || read.worst.is_empty())
        && places.is_sorted_by(|one, next| one < next)
        && read.worst.iter().all(|named| {
            named.unit == named.target.unit() && named.file == Worst::file_of(named.target)
        })
}
