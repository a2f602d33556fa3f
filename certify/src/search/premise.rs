//! This file says which cells a search is to reach because no drawn trial met a law's premise there, and where it begins.

use super::{Begun, STARTS, Target};
use crate::coverage::{Cell, Met};
use crate::law::{LAWS, Law};
use crate::record::Record;

/// The laws whose premises are searched for. Those that are met in every sample stand behind the first.
pub const LAWS_WITH_PREMISES: [Law; 9] = [
    Law::Answers,
    Law::Safe,
    Law::BrakeCount,
    Law::Lock,
    Law::Gap,
    Law::FreeSide,
    Law::TipForce,
    Law::Influence,
    Law::QuarterTurn,
];

/// The name of a law's premise in files.
pub const fn name(law: Law) -> &'static str {
    match law {
        Law::Safe => "premise_safe",
        Law::BrakeCount => "premise_brake_count",
        Law::Lock => "premise_lock",
        Law::Gap => "premise_gap",
        Law::FreeSide => "premise_free_side",
        Law::TipForce => "premise_tip_force",
        Law::Influence => "premise_influence",
        Law::QuarterTurn => "premise_quarter_turn",
        _ => "premise_answers",
    }
}

/// The cells in which a law can be met, and no drawn trial met it.
fn goal(law: Law, records: &[&Record]) -> Vec<Cell> {
    let is_met = |cell: &Cell| {
        let mut all = records.iter().filter_map(|r| r.met.get(law as usize));
        all.any(|met| met.has(*cell))
    };
    let all = Cell::all().filter(|cell| cell.admits(law));
    all.filter(|cell| !is_met(cell)).collect()
}

/// Where a search for a law's premise begins: in the trials that met it in the most cells. Nothing where it was met everywhere.
pub(super) fn begun(law: Law, records: &[&Record]) -> Option<Begun> {
    let goal = goal(law, records);
    if goal.is_empty() {
        return None;
    }
    let cells = |record: &Record| {
        let own = record.met.get(law as usize);
        own.map_or(0, |met| Cell::all().filter(|cell| met.has(*cell)).count())
    };
    let mut all: Vec<(usize, u64)> = records.iter().map(|r| (cells(r), r.index)).collect();
    all.sort_by(|one, other| other.0.cmp(&one.0).then(one.1.cmp(&other.1)));
    let indices = all.into_iter().take(STARTS).map(|(_, index)| index);
    Some(Begun {
        target: Target::Premise(law),
        indices: indices.collect(),
        least: 0.0,
        most: 0.0,
        goal,
    })
}

/// Which cells of a goal a trial met a law's premise in.
pub(super) fn reached(law: Law, goal: &[Cell], met: &[Met; LAWS]) -> Vec<Cell> {
    let is_met = |cell: &Cell| met.get(law as usize).is_some_and(|met| met.has(*cell));
    goal.iter().copied().filter(is_met).collect()
}
