//! This file keeps what balances say of the numbers: what was learned over minutes, and apart from it what the last second says.
//!
//! What is certified counts as seen with every number anywhere in its interval, so that without excitation nothing is learned. The
//! last rows come to what was learned only when a change must have been found in them: a change is not learned first.

use super::constants::{NUMBERS, WATCHED};
use super::information::{Information, Row};
use super::sought::{Number, Sought};

/// Parts of the window of the last rows.
pub const PARTS: usize = 5;
/// Blocks with a balance in a part: the window is 32 to 40 blocks of 32 ms.
pub const PART_BLOCKS: u32 = 8;
/// Blocks from a look at the numbers to the next.
const LOOK_BLOCKS: u32 = 4;

/// What was seen of the rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// What is certified: 1 over the square of each number's spread.
    pub at_rest: [f64; NUMBERS],
    /// What was learned before the window.
    pub learned: Information,
    /// The window, in parts.
    pub last: [Information; PARTS],
}

/// What is known of the numbers, and the look at them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    seen: Seen,
    sought: Sought,
    kept: f64,
    newest: usize,
    blocks: u32,
    /// Blocks until the next look may begin.
    wait: u32,
}

impl Estimate {
    /// Nothing seen yet: spreads about the middle, and what is kept of what was learned from part to part.
    pub fn new(spread: &[f64; NUMBERS], kept: f64) -> Estimate {
        Estimate {
            seen: Seen {
                at_rest: spread.map(|spread| 1.0 / (spread * spread)),
                learned: Information::NONE,
                last: [Information::NONE; PARTS],
            },
            sought: Sought::NONE,
            kept,
            newest: 0,
            blocks: 0,
            wait: 0,
        }
    }

    /// Takes a row in.
    pub fn take(&mut self, row: &Row) {
        if let Some(newest) = self.seen.last.get_mut(self.newest) {
            newest.take(row, self.sought.expected(row));
        }
    }

    /// All rows of a block were taken, if it had any: where the newest part of the window is full, the oldest is learned. A look begins
    /// where the last is long enough ago.
    pub fn end_block(&mut self, has_rows: bool) {
        self.wait = self.wait.saturating_sub(1);
        if !has_rows {
            return;
        }
        self.blocks += 1;
        if self.blocks >= PART_BLOCKS {
            self.blocks = 0;
            self.newest = (self.newest + 1) % PARTS;
            if let Some(oldest) = self.seen.last.get_mut(self.newest) {
                self.seen.learned.fade(self.kept, oldest);
                *oldest = Information::NONE;
            }
        }
        if self.wait == 0 {
            self.wait = LOOK_BLOCKS;
            self.sought.begin();
        }
    }

    /// Goes on with a look by a bounded part; true where that ended it.
    pub fn go_on(&mut self) -> bool {
        self.sought.go_on(&self.seen)
    }

    /// The watched numbers, each as if it alone had changed.
    pub fn numbers(&self) -> &[Number; WATCHED] {
        self.sought.numbers()
    }

    /// Mean square of what no number explains of the last rows: 1 where the model is right.
    pub fn surprise(&self) -> f64 {
        self.sought.surprise()
    }
}
