//! This file says how often the premise of every law was met, in which parts of workspace, speed, force and fault, and where never.

use serde::{Deserialize, Serialize};

use crate::coverage::{AXES, CELLS, Cell, Met, number};
use crate::law::Law;
use crate::record::Record;

/// How often the premise of a law was met, and where.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetSummary {
    /// Samples.
    pub samples: u64,
    /// Trials with such a sample.
    pub trials: u64,
    /// In how many trials it is to be met at least.
    pub least_trials: u64,
    /// Cells in which it was met.
    pub cells: u64,
    /// Cells in which a sample lay and the law can be met.
    pub of_cells: u64,
    /// Those of them in which it never was.
    pub never: Vec<String>,
    /// By the parts of every axis.
    pub parts: Vec<PartSummary>,
}

/// One part of an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartSummary {
    /// The axis.
    pub axis: String,
    /// The part.
    pub part: String,
    /// Samples in which the premise was met.
    pub samples: u64,
    /// The least margin, in three digits.
    pub least_margin: Option<f64>,
}

/// Which cells of workspace, speed, force and fault any sample lay in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Visited {
    /// How many cells there are.
    pub cells: u64,
    /// In how many a sample lay.
    pub visited: u64,
    /// The others.
    pub never: Vec<String>,
}

/// The cells in which a sample lay.
pub fn visited(records: &[&Record]) -> Visited {
    let is_visited = visits(records);
    let never: Vec<String> = Cell::all()
        .filter(|cell| !is_visited(*cell))
        .map(Cell::name)
        .collect();
    Visited {
        cells: CELLS as u64,
        visited: CELLS as u64 - never.len() as u64,
        never,
    }
}

/// Whether a sample lay in a cell: every sample has to be answered.
fn visits<'a>(records: &'a [&Record]) -> impl Fn(Cell) -> bool + 'a {
    move |cell| {
        let mut all = records.iter().filter_map(|record| of(record, Law::Answers));
        all.any(|met| met.has(cell))
    }
}

fn of(record: &Record, law: Law) -> Option<&Met> {
    record.met.get(law as usize)
}

/// How often the premise of a law was met, which is to be in so many trials at least.
pub fn met(law: Law, least_trials: u64, records: &[&Record]) -> MetSummary {
    let own: Vec<&Met> = records.iter().filter_map(|r| of(r, law)).collect();
    let is_visited = visits(records);
    let can_be = |cell: &Cell| cell.admits(law) && is_visited(*cell);
    let (in_it, never): (Vec<Cell>, Vec<Cell>) = Cell::all()
        .filter(can_be)
        .partition(|cell| own.iter().any(|met| met.has(*cell)));
    MetSummary {
        samples: own.iter().map(|met| met.samples()).sum(),
        trials: own.iter().filter(|met| met.samples() > 0).count() as u64,
        least_trials,
        cells: in_it.len() as u64,
        of_cells: (in_it.len() + never.len()) as u64,
        never: never.into_iter().map(Cell::name).collect(),
        parts: parts(&own),
    }
}

fn parts(own: &[&Met]) -> Vec<PartSummary> {
    let all = (0..).zip(AXES).flat_map(|(axis, (name, parts))| {
        let of_axis = (0..).zip(parts.iter());
        of_axis.map(move |(part, words)| (name, *words, number(axis, part)))
    });
    let one = |(axis, words, number): (&str, &str, usize)| {
        let met = own.iter().map(|met| met.part(number));
        let met: Vec<(u32, Option<f64>)> = met.filter(|(samples, _)| *samples > 0).collect();
        // Where one margin is no number, none is the least.
        let least = met.iter().map(|(_, least)| *least);
        let least = least.reduce(|one, other| Some(one?.min(other?)));
        PartSummary {
            axis: axis.to_owned(),
            part: words.to_owned(),
            samples: met.iter().map(|(samples, _)| u64::from(*samples)).sum(),
            least_margin: least.flatten(),
        }
    };
    all.map(one).collect()
}
