//! This file turns the records of a campaign into figures: how every law fared, and the metrics beside the baseline's.

mod beyond;
mod covered;
mod ended;
mod exact;
mod paired;
mod ties;

use rigproof_spec::methods::SAMPLE_STEP_S;
use serde::{Deserialize, Serialize};

use crate::law::Law;
use crate::metrics::{METRICS, Metric};
use crate::plan::{Plan, What};
use crate::record::Record;

pub use beyond::{Bound, Limited};
pub use covered::{MetSummary, PartSummary, Visited, visited};
pub use ended::{Ended, Endings, ended};
pub use exact::Exact;
pub(crate) use paired::change;
pub use paired::{Change, Word};
pub use ties::{TieSummary, ties};

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
    /// How often its premise was met, and where.
    pub met: MetSummary,
    /// Scenarios in which it was broken.
    pub broken_in: u64,
    /// The first of them.
    pub first_broken: Option<u64>,
    /// The least margin; none without samples, or where it was no number.
    pub worst_margin: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// The scenario of the least margin.
    pub worst_scenario: Option<u64>,
}

impl LawSummary {
    /// Whether its premise was met in as many trials as are asked for.
    pub const fn is_met(&self) -> bool {
        self.met.trials >= self.met.least_trials
    }

    /// Whether it holds: never broken, and met often enough.
    pub const fn holds(&self) -> bool {
        self.broken_in == 0 && self.samples > 0 && self.is_met()
    }
}

/// A law that was not looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NotLookedAt {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

/// One metric over a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetricSummary {
    /// The metric.
    pub metric: Metric,
    /// What it is.
    pub words: String,
    /// Its unit.
    pub unit: String,
    /// The controller's.
    pub controller: Option<Quantiles>,
    /// The baseline's.
    pub baseline: Option<Quantiles>,
    /// The change, paired over the scenarios.
    pub change: Option<Change>,
    /// What 95 of 100 trials must not exceed.
    pub limit: Option<f64>,
    /// By how much the mean may be worse than the baseline's.
    pub regression: Option<f64>,
    /// Each of them that was given, with what stands beside it.
    pub limits: Vec<Limited>,
    /// The scenario of the controller's greatest value.
    pub worst_scenario: Option<u64>,
}

/// What of a hundred trials lies below.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantiles {
    /// Trials in which there is something to measure.
    pub trials: u64,
    /// Mean.
    pub mean: f64,
    /// 5 of 100.
    pub q05: f64,
    /// Median.
    pub q50: f64,
    /// 95 of 100.
    pub q95: f64,
    /// The greatest.
    pub greatest: f64,
}

/// How the laws fared that can be judged.
pub fn laws(plan: &Plan, records: &[&Record]) -> Vec<LawSummary> {
    let looked_at = Law::ALL
        .into_iter()
        .filter(|law| plan.not_looked_at(*law).is_none());
    looked_at.map(|law| of_law(plan, law, records)).collect()
}

fn of_law(plan: &Plan, law: Law, records: &[&Record]) -> LawSummary {
    let mut summary = LawSummary {
        law,
        words: law.words().to_owned(),
        samples: 0,
        met: covered::met(law, plan.least_met, records),
        broken_in: 0,
        first_broken: None,
        worst_margin: None,
        unit: law.unit().to_owned(),
        worst_scenario: None,
    };
    let mut worst = f64::MAX;
    for record in records {
        let Some(fared) = record.fared.get(law as usize) else {
            continue;
        };
        summary.samples += fared.samples;
        if fared.broken > 0 {
            summary.broken_in += 1;
            summary.first_broken.get_or_insert(record.index);
        }
        if fared.samples > 0 && fared.worst < worst {
            worst = fared.worst;
            summary.worst_scenario = Some(record.index);
        }
    }
    summary.worst_margin = (worst < f64::MAX && worst > f64::MIN).then_some(worst);
    summary
}

/// What no protection of a compiled controller's process gives.
pub(crate) const ISOLATION: &str = "it was a process of the same user: it could read and change that user's files, end his processes, and load code that its hash does not name";

/// The laws that cannot be judged, and what no campaign of this kind sees.
pub fn not_looked_at(plan: &Plan) -> Vec<NotLookedAt> {
    let laws = Law::ALL
        .into_iter()
        .filter_map(|law| plan.not_looked_at(law).map(|why| (law.name(), why)));
    let always = [
        (
            "rest of the plant",
            "joint stops, flexible arms, friction in joints without a brake, and whatever else the simulated plant leaves out",
        ),
        (
            "other hands",
            "hands stronger than 20 N, and people: the operators are simulated",
        ),
        (
            "timing",
            "jitter of the sample time, and how long a sample takes on the rig's computer",
        ),
        (
            "amplifiers",
            "what an amplifier does when no command comes: it needs a watchdog of its own (decision 0074)",
        ),
    ];
    let of_process = |why: &str| ("isolation", format!("{why} (docs/threats.md)"));
    let (given, lacks) = match &plan.controller.what {
        What::Given {
            process: Some(_),
            lacks,
            ..
        } => (Some(of_process(ISOLATION)), lacks.as_slice()),
        _ => (None, [].as_slice()),
    };
    let of_process = given
        .into_iter()
        .chain(lacks.iter().map(|why| of_process(why)));
    let of_process: Vec<_> = of_process.collect();
    let of_process = of_process.iter().map(|(what, why)| (*what, why.as_str()));
    let named = |(what, why): (&str, &str)| NotLookedAt {
        what: what.to_owned(),
        why: why.to_owned(),
    };
    laws.chain(always).chain(of_process).map(named).collect()
}

/// The metrics, beside the baseline's where there is one.
pub fn metrics(plan: &Plan, records: &[&Record]) -> Vec<MetricSummary> {
    (0..METRICS)
        .zip(Metric::ALL)
        .map(|(index, metric)| of_metric(plan, records, index, metric))
        .collect()
}

fn of_metric(plan: &Plan, records: &[&Record], index: usize, metric: Metric) -> MetricSummary {
    let of = |measured: &[Option<f64>; METRICS]| measured.get(index).copied().flatten();
    let own: Vec<f64> = records.iter().filter_map(|r| of(&r.measured)).collect();
    let theirs = records
        .iter()
        .filter_map(|r| of(&r.baseline.as_ref()?.measured));
    // A trial that does not finish takes its whole time at least.
    let whole_s = (metric == Metric::Finish).then_some(f64::from(plan.ticks) * SAMPLE_STEP_S);
    let pairs: Vec<[f64; 2]> = records
        .iter()
        .filter_map(|r| {
            let (theirs, own) = (of(&r.baseline.as_ref()?.measured), of(&r.measured));
            match (theirs, own) {
                (None, None) => None,
                _ => Some([theirs.or(whole_s)?, own.or(whole_s)?]),
            }
        })
        .collect();
    let controller = quantiles(own.clone());
    let change = paired::change(&pairs, plan.seed ^ (index as u64 + 1));
    let limit = plan.limits.get(index).copied().flatten();
    let regression = plan.regressions.get(index).copied().flatten();
    // What was not measured cannot be within a limit, nor can a trial that did not finish.
    let trials = match metric {
        Metric::Finish => records.len(),
        _ => own.len(),
    };
    let of_trials = limit.map(|most| beyond::of_trials(metric, &own, trials, most));
    let of_mean = regression.map(|most| beyond::of_mean(metric, change.as_ref(), most));
    let greatest = records
        .iter()
        .filter_map(|r| Some((of(&r.measured)?, r.index)));
    let greatest = greatest.reduce(|one, other| if other.0 > one.0 { other } else { one });
    MetricSummary {
        metric,
        words: metric.words().to_owned(),
        unit: metric.unit().to_owned(),
        controller,
        baseline: quantiles(theirs.collect()),
        change,
        limit,
        regression,
        limits: of_trials.into_iter().chain(of_mean).collect(),
        worst_scenario: greatest.map(|(_, index)| index),
    }
}

/// Mean and quantiles of values; `None` of none.
pub(crate) fn quantiles(mut values: Vec<f64>) -> Option<Quantiles> {
    // The mean in the order of the scenarios, which no thread changes.
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let last = values.len().checked_sub(1)?;
        values
            .get(libm::ceil(share * last as f64) as usize)
            .copied()
    };
    Some(Quantiles {
        trials: values.len() as u64,
        mean,
        q05: at(0.05)?,
        q50: at(0.5)?,
        q95: at(0.95)?,
        greatest: at(1.0)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_values() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let quantiles = quantiles(values).unwrap();
        assert_eq!((quantiles.q05, quantiles.q50), (5.0, 50.0));
        assert_eq!((quantiles.q95, quantiles.greatest), (95.0, 100.0));
        assert_eq!((quantiles.mean, quantiles.trials), (50.0, 101));
        assert_eq!(super::quantiles(Vec::new()), None);
    }
}
