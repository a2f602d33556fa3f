//! This file is what is kept of where the premise of one law was met in one trial.

use serde::{Deserialize, Serialize};

use super::{Cell, PARTS, number};

/// Where the premise of a law was met.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Written", into = "Written")]
pub struct Met {
    /// The cells, a bit each.
    cells: [u64; 3],
    /// Of every part of every axis, in which so many samples met it: their number and the least margin in three digits; none at all of a law that
    /// was not met. No margin stands where it was no number.
    parts: Vec<(u32, Option<f64>)>,
    /// The cell in which the law was broken first.
    broken: Option<u8>,
}

/// As it stands in a journal.
type Written = ([u64; 3], Vec<(u32, Option<f64>)>, Option<u8>);

impl From<Written> for Met {
    fn from((cells, parts, broken): Written) -> Met {
        Met {
            cells,
            parts,
            broken,
        }
    }
}

impl From<Met> for Written {
    fn from(met: Met) -> Written {
        (met.cells, met.parts, met.broken)
    }
}

impl Met {
    /// Adds so many samples of a cell with their least margin.
    pub fn add(&mut self, cell: Cell, samples: u32, least: f64) {
        let (word, bit) = (cell.index() / 64, cell.index() % 64);
        if let Some(word) = self.cells.get_mut(word) {
            *word |= 1 << bit;
        }
        self.parts.resize(PARTS, (0, Some(f64::MAX)));
        for (axis, part) in cell.parts().into_iter().enumerate() {
            if let Some((met, own)) = self.parts.get_mut(number(axis, part)) {
                *met += samples;
                *own = own.map(|own| own.min(least));
            }
        }
    }

    /// With its margins in three digits, none where nothing was met or what was met is no number, and where the law was broken first.
    pub(super) fn short(mut self, broken: Option<Cell>) -> Met {
        self.broken = broken.map(|cell| cell.index() as u8);
        for (met, least) in &mut self.parts {
            *least = least.filter(|_| *met > 0).and_then(rounded);
        }
        self
    }

    /// The samples in which it was met.
    pub fn samples(&self) -> u64 {
        // Every sample lies in one of the first axis's parts.
        let first = self.parts.iter().take(number(1, 0));
        first.map(|(met, _)| u64::from(*met)).sum()
    }

    /// Whether it was met in a cell.
    pub fn has(&self, cell: Cell) -> bool {
        let (word, bit) = (cell.index() / 64, cell.index() % 64);
        self.cells
            .get(word)
            .is_some_and(|word| word >> bit & 1 == 1)
    }

    /// The cell in which the law was broken first.
    pub fn broken_in(&self) -> Option<Cell> {
        self.broken.and_then(Cell::at)
    }

    /// Samples of a part in which it was met, and their least margin.
    pub fn part(&self, number: usize) -> (u32, Option<f64>) {
        self.parts.get(number).copied().unwrap_or((0, None))
    }
}

/// A margin in three digits; none of what is no number.
pub fn rounded(margin: f64) -> Option<f64> {
    // The least number stands for what is none.
    let is_number = margin.is_finite() && margin.abs() < 1e300;
    is_number.then(|| format!("{margin:.2e}").parse().unwrap_or(margin) + 0.0)
}
