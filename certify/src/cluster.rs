//! This file gathers the trials that broke a law by what they have in common: the law, the place, the fault, and a number of the plant.

mod common;

use serde::{Deserialize, Serialize};

use crate::controller::Source;
use crate::coverage::{AXES, Cell};
use crate::error::Error;
use crate::finding::{Finding, Named};
use crate::law::Law;
use crate::plan::Plan;
use crate::record::Record;

pub use common::Common;

/// Clusters that are named at most, those of the most trials.
pub const MOST: usize = 8;

/// Trials that broke a law and have something in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cluster {
    /// The law.
    pub law: Law,
    /// Where the tip was when it was broken first.
    pub place: String,
    /// What was wrong with the sensors then.
    pub fault: String,
    /// The trials.
    pub trials: u64,
    /// Their share of all trials that broke a law, each counted for every law that it broke.
    pub share: f64,
    /// What else they all have, and few others.
    pub common: Vec<Common>,
    /// The first of them.
    pub scenario: u64,
    /// That as short and plain as it was made, in a file beside the certificate.
    pub example: Option<Named>,
}

impl Cluster {
    /// Whether it is of the same kind as another, and has as many trials at least.
    pub fn holds(&self, other: &Cluster) -> bool {
        (self.law, &self.place, &self.fault) == (other.law, &other.place, &other.fault)
            && self.trials >= other.trials
    }
}

/// The clusters of a campaign, the largest first, none with its example.
pub fn clusters(plan: &Plan, records: &[&Record]) -> Vec<Cluster> {
    let mut all: Vec<(Law, Cell, Vec<u64>)> = Vec::new();
    let mut total = 0;
    for law in Law::ALL {
        if plan.not_looked_at(law).is_some() {
            continue;
        }
        for record in records {
            let Some(cell) = record.met.get(law as usize).and_then(|met| met.broken_in()) else {
                continue;
            };
            total += 1;
            let is_same = |own: &&mut (Law, Cell, Vec<u64>)| own.0 == law && alike(own.1, cell);
            match all.iter_mut().find(is_same) {
                Some((_, _, indices)) => indices.push(record.index),
                None => all.push((law, cell, vec![record.index])),
            }
        }
    }
    // The sort is stable: laws and places keep their order.
    all.sort_by_key(|(_, _, indices)| core::cmp::Reverse(indices.len()));
    all.truncate(MOST);
    let of = |(law, cell, indices): (Law, Cell, Vec<u64>)| {
        let [place, _, _, fault] = cell.parts();
        let named = |axis: usize, part: usize| {
            let names = AXES.get(axis).and_then(|(_, names)| names.get(part));
            names.copied().unwrap_or_default().to_owned()
        };
        Cluster {
            law,
            place: named(0, place),
            fault: named(3, fault),
            trials: indices.len() as u64,
            share: indices.len() as f64 / f64::from(total.max(1)),
            common: common::common(plan, records, law, &indices),
            scenario: indices.first().copied().unwrap_or_default(),
            example: None,
        }
    };
    all.into_iter().map(of).collect()
}

/// Whether two cells are of one place and one fault.
fn alike(one: Cell, other: Cell) -> bool {
    let ([place, _, _, fault], [other_place, _, _, other_fault]) = (one.parts(), other.parts());
    (place, fault) == (other_place, other_fault)
}

/// The name of the file of a cluster's example, without its ending; clusters are counted from 1.
pub fn stem_of(number: usize) -> String {
    format!("cluster-{number}")
}

/// The shrunk example of every cluster; none where its law is broken once and not again.
///
/// # Errors
/// It cannot be written as JSON.
pub fn examples(
    plan: &Plan,
    source: &dyn Source,
    clusters: &[Cluster],
) -> Result<Vec<Option<Finding>>, Error> {
    let of = |own: &Cluster| Finding::of(plan, source, own.law, own.scenario);
    clusters.iter().map(of).collect()
}

/// How a certificate names the examples.
///
/// # Errors
/// It cannot be written as JSON.
pub fn named(examples: &[Option<Finding>]) -> Result<Vec<Option<Named>>, Error> {
    let one = |(number, own): (usize, &Option<Finding>)| {
        let named = own.as_ref().map(Finding::named).transpose()?;
        let file = stem_of(number) + ".json";
        Ok(named.map(|named| Named { file, ..named }))
    };
    (1..).zip(examples).map(one).collect()
}
