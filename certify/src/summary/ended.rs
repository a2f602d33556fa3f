//! This file says how trials ended, each in one way, beside the baseline's in the same scenarios.

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

/// Trials, by how they ended: each is counted once, so that they sum to the trials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Endings {
    /// The tip came to the end of the path, and nothing stopped it on the way back.
    pub finished: u64,
    /// The tip came to the end of the path, and the hand took the linkage to its stops on the way back.
    pub finished_then_stopped: u64,
    /// The hand took the linkage to its stops before that.
    pub stopped: u64,
    /// Their time was over before that.
    pub time_over: u64,
    /// The controller did not answer any more, before the path's end or after it.
    pub no_answer: u64,
}

impl Endings {
    /// All of them.
    pub const fn each(&self) -> [u64; 5] {
        [
            self.finished,
            self.finished_then_stopped,
            self.stopped,
            self.time_over,
            self.no_answer,
        ]
    }

    /// How many trials came to the end of the path, whatever came after, as long as the controller answered.
    pub const fn came_to_the_end(&self) -> u64 {
        self.finished.saturating_add(self.finished_then_stopped)
    }

    /// How many trials ended at the stops, before the path's end or after it.
    pub const fn at_the_stops(&self) -> u64 {
        self.stopped.saturating_add(self.finished_then_stopped)
    }
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
    for one in all {
        let place = match (one.ending, one.is_finished) {
            (Ending::NoAnswer, _) => &mut count.no_answer,
            (Ending::Time, true) => &mut count.finished,
            (Ending::LeftWorkspace, true) => &mut count.finished_then_stopped,
            (Ending::Time, false) => &mut count.time_over,
            (Ending::LeftWorkspace, false) => &mut count.stopped,
        };
        *place += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_trial_is_counted_once() {
        let all = [Ending::Time, Ending::LeftWorkspace, Ending::NoAnswer];
        let all = all.into_iter().flat_map(|ending| {
            [true, false].map(|is_finished| One {
                is_finished,
                ending,
            })
        });
        let count = endings(all);
        assert_eq!(count.each(), [1, 1, 1, 1, 2]);
        assert_eq!((count.came_to_the_end(), count.at_the_stops()), (2, 2));
    }
}
