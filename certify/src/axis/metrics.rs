//! This file names what is measured in every trial of an axis, and says whether limits and baseline allow it.

use serde::{Deserialize, Serialize};

use super::campaign::{Beside, Record};
use super::plan::Plan;
use crate::summary::{Change, Quantiles, change, quantiles};

/// A metric; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// How far the axis is from its target.
    Error,
    /// How much effort is commanded.
    EffortRms,
}

impl Metric {
    /// Every metric, in the order of measured values.
    pub const ALL: [Metric; 2] = [Metric::Error, Metric::EffortRms];

    /// Its key in `certify.toml`.
    pub const fn key(self) -> &'static str {
        match self {
            Metric::Error => "error",
            Metric::EffortRms => "effort_rms",
        }
    }

    /// What it is.
    pub const fn words(self) -> &'static str {
        match self {
            Metric::Error => "root mean square of the distance from the target",
            Metric::EffortRms => "root mean square of the commanded effort",
        }
    }
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
    /// The change, paired over the trials.
    pub change: Option<Change>,
    /// What 95 of 100 trials must not exceed.
    pub limit: Option<f64>,
    /// By how much the mean may be worse than the baseline's.
    pub regression: Option<f64>,
    /// The trial of the controller's greatest value.
    pub worst_scenario: Option<u64>,
}

/// The metrics, beside the baseline's where there is one.
pub fn metrics(plan: &Plan, records: &[Record]) -> Vec<MetricSummary> {
    let each = Metric::ALL.into_iter().enumerate();
    each.map(|(index, metric)| summary(plan, records, index, metric))
        .collect()
}

fn summary(plan: &Plan, records: &[Record], index: usize, metric: Metric) -> MetricSummary {
    let of = |measured: &[Option<f64>; 2]| measured.get(index).copied().flatten();
    let baseline = |record: &Record| of(&record.baseline.as_ref()?.measured);
    let own = records.iter().filter_map(|record| of(&record.measured));
    let pairs = records
        .iter()
        .filter_map(|record| Some([baseline(record)?, of(&record.measured)?]));
    let greatest = records
        .iter()
        .filter_map(|record| Some((of(&record.measured)?, record.index)));
    let greatest = greatest.reduce(|one, other| if other.0 > one.0 { other } else { one });
    let of_asked = |all: [Option<f64>; 2]| all.get(index).copied().flatten();
    let [travel, effort] = plan.axis.units();
    MetricSummary {
        metric,
        words: metric.words().to_owned(),
        unit: match metric {
            Metric::Error => travel.to_owned(),
            Metric::EffortRms => effort.to_owned(),
        },
        controller: quantiles(own.collect()),
        baseline: quantiles(records.iter().filter_map(baseline).collect()),
        change: change(&pairs.collect::<Vec<_>>(), plan.seed ^ (index as u64 + 1)),
        limit: of_asked(plan.asked.limits.trials),
        regression: of_asked(plan.asked.regressions),
        worst_scenario: greatest.map(|(_, index)| index),
    }
}

impl MetricSummary {
    /// Why its limits do not hold, a sentence each.
    pub fn reasons(&self) -> Vec<String> {
        let (key, unit) = (self.metric.key(), &self.unit);
        let mut reasons = Vec::new();
        if let Some(most) = self.limit {
            match self.controller {
                Some(own) if own.q95 <= most => {}
                Some(own) => reasons.push(format!(
                    "{key}: 95 of 100 trials come to {:.3e} {unit}, where certify.toml allows {most} {unit}",
                    own.q95
                )),
                None => reasons.push(format!("{key}: no trial was measured")),
            }
        }
        if let Some(most) = self.regression {
            let high = self.change.map(|change| {
                let [_, high] = change.interval;
                high
            });
            match high {
                Some(high) if high <= most => {}
                Some(high) => reasons.push(format!(
                    "{key}: the mean may be worse than the baseline's by {high:.3e} {unit}, the upper end of its 95 % interval, where certify.toml allows {most} {unit}"
                )),
                None => reasons.push(format!(
                    "{key}: too few trials stand beside the baseline to say how much worse the mean is"
                )),
            }
        }
        reasons
    }
}

/// Trials of the baseline that ended otherwise than by their time.
pub fn baseline_broke(records: &[Record]) -> u64 {
    let broke = |beside: &Beside| beside.ending != super::trial::Ending::Time;
    let all = records.iter().filter_map(|record| record.baseline.as_ref());
    all.filter(|beside| broke(beside)).count() as u64
}
