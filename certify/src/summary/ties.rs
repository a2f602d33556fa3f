//! This file says in how many trials and samples the reference may decide otherwise, and in how many trials it may at most.

use serde::{Deserialize, Serialize};

use crate::differential::tie::{Tie, Ties};
use crate::record::Record;

/// One kind of tie in a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TieSummary {
    /// The kind.
    pub tie: Tie,
    /// What turns.
    pub words: String,
    /// Samples.
    pub samples: u64,
    /// Trials with such a sample.
    pub trials: u64,
    /// In how many trials there may be one.
    pub most: u64,
}

/// The kinds of ties that were met.
pub fn ties(records: &[&Record]) -> Vec<TieSummary> {
    let mut all = Ties::default();
    for record in records {
        all.join(&record.ties);
    }
    let met = all.met().map(|(tie, samples)| {
        let has_it = |record: &&&Record| record.ties.met().any(|(own, _)| own == tie);
        TieSummary {
            tie,
            words: tie.words().to_owned(),
            samples,
            trials: records.iter().filter(has_it).count() as u64,
            most: tie.budget().most(records.len() as u64),
        }
    });
    met.collect()
}
