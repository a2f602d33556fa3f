//! This file says how trials ended, beside the baseline's in the same scenarios.

use serde::{Deserialize, Serialize};

use super::paired::{Change, change};
use crate::metrics::{METRICS, Measured, Metric};
use crate::plan::Plan;
use crate::record::Record;
use crate::trial::Ending;

/// How trials ended, the controller's and the baseline's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ended {
    /// The controller's.
    pub controller: Endings,
    /// The baseline's.
    pub baseline: Option<Endings>,
    /// The change of the share of trials that do not come to the path's end, paired over the scenarios.
    pub unfinished: Option<Change>,
    /// The change of the share of trials that end at the stops.
    pub stopped: Option<Change>,
}

/// Trials, by how they ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Endings {
    /// The tip came to the end of the path, whatever came after; counted below too.
    pub finished: u64,
    /// Their time was over.
    pub time: u64,
    /// The hand took the linkage to its stops.
    pub left_workspace: u64,
    /// The controller did not answer any more.
    pub no_answer: u64,
}

/// One trial's end.
#[derive(Clone, Copy)]
struct One {
    is_finished: bool,
    ending: Ending,
}

fn one(ending: Ending, measured: &Measured) -> One {
    let finish_s = measured.get(Metric::Finish as usize).copied().flatten();
    One {
        is_finished: finish_s.is_some(),
        ending,
    }
}

/// How the trials ended.
pub fn ended(plan: &Plan, records: &[&Record]) -> Ended {
    let own = |record: &Record| one(record.ending, &record.measured);
    let theirs = |record: &Record| {
        let beside = record.baseline.as_ref()?;
        Some(one(beside.ending, &beside.measured))
    };
    let share = |is: fn(One) -> bool, number: u64| {
        let pairs = records.iter().filter_map(|record| {
            let both = [theirs(record)?, own(record)];
            Some(both.map(|one| f64::from(u8::from(is(one)))))
        });
        // Metrics have the seeds before.
        change(
            &pairs.collect::<Vec<_>>(),
            plan.seed ^ (METRICS as u64 + number),
        )
    };
    Ended {
        controller: endings(records.iter().map(|record| own(record))),
        baseline: plan
            .baseline
            .as_ref()
            .map(|_| endings(records.iter().filter_map(|record| theirs(record)))),
        unfinished: share(|one| !one.is_finished, 1),
        stopped: share(|one| one.ending == Ending::LeftWorkspace, 2),
    }
}

fn endings(all: impl Iterator<Item = One>) -> Endings {
    let mut count = Endings::default();
    for One {
        is_finished,
        ending,
    } in all
    {
        count.finished += u64::from(is_finished);
        match ending {
            Ending::Time => count.time += 1,
            Ending::LeftWorkspace => count.left_workspace += 1,
            Ending::NoAnswer => count.no_answer += 1,
        }
    }
    count
}
