//! This file says in which part of workspace, speed, force and fault a sample lies, and counts where the premise of every law was met.

mod met;

use rigproof_impl::vector::Vector;
use rigproof_spec::laws::Margin;

use crate::law::{LAWS, Law};
use crate::scenario::FaultKind;

pub use met::{Met, rounded};

/// The axes, with the names of their parts.
pub const AXES: [(&str, &[&str]); 4] = [
    (
        "place",
        &["left near", "left far", "right near", "right far"],
    ),
    ("speed", &["still", "slow", "fast"]),
    ("force", &["light", "middle", "strong"]),
    (
        "fault",
        &["no fault", "number", "counts", "force sensor", "just after"],
    ),
];
/// How many parts each axis has.
const COUNTS: [usize; 4] = [4, 3, 3, 5];
/// How many parts all axes have together.
pub const PARTS: usize = 15;
/// How many cells there are: one for every part of every axis.
pub const CELLS: usize = 180;

/// What lies farther from the base joints' line is far, m: the middle of the box in which paths are drawn.
pub const FAR_M: f64 = 0.37;
/// Below this the tip is still, m/s: one count in one sample at the end of an arm (decision 0124).
pub const STILL_M_S: f64 = 0.02;
/// From this on the tip is fast, m/s: between what a gentle and a hasty hand intends (decision 0125).
pub const FAST_M_S: f64 = 0.15;
/// Below the first a push is light, from the second on strong, N: a tenth and a half of the greatest (decision 0047).
pub const FORCES_N: [f64; 2] = [2.0, 10.0];
/// Samples after a fault that count as just after it.
const AFTER: u32 = 100;

/// A cell: a part of every axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cell(u8);

impl Cell {
    /// Every cell.
    pub fn all() -> impl Iterator<Item = Cell> {
        (0..CELLS as u8).map(Cell)
    }

    /// The cell of a sample: tip, m, its velocity, m/s, the push, N, and the part of the fault.
    pub fn of(tip_m: Vector<f64>, velocity_m_s: Vector<f64>, force_n: [f64; 2], fault: u8) -> Cell {
        let place = 2 * u8::from(tip_m.x >= 0.0) + u8::from(tip_m.y >= FAR_M);
        let [middle, strong] = FORCES_N;
        let speed = part(velocity_m_s.norm_squared(), [STILL_M_S, FAST_M_S]);
        let force = part(Vector::from(force_n).norm_squared(), [middle, strong]);
        Cell(((place * 3 + speed) * 3 + force) * 5 + fault.min(4))
    }

    /// The cell of a number.
    pub fn at(index: u8) -> Option<Cell> {
        (usize::from(index) < CELLS).then_some(Cell(index))
    }

    /// Its number.
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Its parts, one of every axis, counted within the axis.
    pub const fn parts(self) -> [usize; 4] {
        let index = self.index();
        [index / 45, index / 15 % 3, index / 5 % 3, index % 5]
    }

    /// Its parts in words.
    pub fn name(self) -> String {
        let named = AXES.iter().zip(self.parts());
        let named = named.filter_map(|((_, names), part)| names.get(part).copied());
        named.collect::<Vec<_>>().join(", ")
    }

    /// Whether a law can be met there: some are about faults, some about samples without.
    pub const fn admits(self, law: Law) -> bool {
        let is_fault = matches!(self.index() % 5, 1..=3);
        match law {
            Law::Safe => is_fault,
            Law::Lock
            | Law::Gap
            | Law::FreeSide
            | Law::TipForce
            | Law::Influence
            | Law::QuarterTurn
            | Law::Reference => !is_fault,
            _ => true,
        }
    }
}

/// In which of three parts a squared size lies, by the two ends between them.
fn part(squared: f64, [first, second]: [f64; 2]) -> u8 {
    u8::from(squared >= first * first) + u8::from(squared >= second * second)
}

/// The number of a part among all parts.
pub fn number(axis: usize, part: usize) -> usize {
    COUNTS.iter().take(axis).sum::<usize>() + part
}

/// What is wrong with a sample, or was a moment ago.
#[derive(Clone, Copy, Debug, Default)]
pub struct Since {
    left: u32,
}

impl Since {
    /// The part of the fault in the next sample.
    pub fn part(&mut self, fault: Option<FaultKind>) -> u8 {
        if let Some(kind) = fault {
            self.left = AFTER;
            return match kind {
                FaultKind::Missed(_) | FaultKind::Stale => 1,
                FaultKind::Jumped(_) => 2,
                FaultKind::NoNumber(_) | FaultKind::Infinite(_) | FaultKind::Beyond(_) => 3,
            };
        }
        let is_after = self.left > 0;
        self.left = self.left.saturating_sub(1);
        if is_after { 4 } else { 0 }
    }
}

/// How one law fared in one cell.
#[derive(Clone, Copy, Debug)]
struct Own {
    met: u32,
    least: f64,
}

/// Where the premises of all laws were met in a trial.
pub struct Covered {
    cells: Vec<[Own; LAWS]>,
    /// Where every law was broken first.
    broken: [Option<Cell>; LAWS],
    at: Cell,
    /// The cell of every sample, for what is told again.
    past: Vec<Cell>,
}

impl Default for Covered {
    /// Nothing yet.
    fn default() -> Covered {
        let none = Own {
            met: 0,
            least: f64::MAX,
        };
        Covered {
            cells: vec![[none; LAWS]; CELLS],
            broken: [None; LAWS],
            at: Cell::default(),
            past: Vec::new(),
        }
    }
}

impl Covered {
    /// The next sample lies in this cell.
    pub fn next(&mut self, cell: Cell) {
        self.at = cell;
        self.past.push(cell);
    }

    /// What follows is about a sample of the past.
    pub fn back_to(&mut self, tick: u32) {
        if let Some(cell) = self.past.get(tick as usize) {
            self.at = *cell;
        }
    }

    /// A law was judged, and its premise was met or not.
    #[inline]
    pub fn judged(&mut self, law: Law, margin: Margin, is_met: bool) {
        if !margin.holds()
            && let Some(first) = self.broken.get_mut(law as usize)
        {
            first.get_or_insert(self.at);
        }
        if !is_met {
            return;
        }
        let row = self.cells.get_mut(self.at.index());
        if let Some(own) = row.and_then(|row| row.get_mut(law as usize)) {
            own.met += 1;
            // What is no number is below every number.
            own.least = match margin.0.is_nan() {
                true => f64::MIN,
                false => own.least.min(margin.0),
            };
        }
    }

    /// What is kept of it.
    pub fn met(&self) -> [Met; LAWS] {
        Law::ALL.map(|law| {
            let own = |cell: Cell| Some(*self.cells.get(cell.index())?.get(law as usize)?);
            let all = Cell::all().filter_map(|cell| Some((cell, own(cell)?)));
            let mut met = Met::default();
            for (cell, own) in all.filter(|(_, own)| own.met > 0) {
                met.add(cell, own.met, own.least);
            }
            let broken = self.broken.get(law as usize).copied().flatten();
            met.short(broken)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_lies_in_the_cell_that_its_numbers_say() {
        let cell = Cell::of(
            Vector::new(-0.031, 0.41),
            Vector::new(0.11, -0.07),
            [0.3, -1.7],
            4,
        );
        assert_eq!(cell.name(), "left far, slow, light, just after");
        let cell = Cell::of(
            Vector::new(0.031, 0.31),
            Vector::new(0.11, -0.17),
            [7.3, 7.1],
            2,
        );
        assert_eq!(cell.name(), "right near, fast, strong, counts");
        assert!(cell.admits(Law::Safe) && !cell.admits(Law::Gap) && cell.admits(Law::Answers));
        let mut names: Vec<String> = Cell::all().map(Cell::name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), CELLS);
        let parts: usize = AXES.iter().map(|(_, names)| names.len()).sum();
        assert_eq!((parts, number(3, 4)), (PARTS, PARTS - 1));
    }

    #[test]
    fn a_hundred_samples_after_a_fault_are_just_after_it() {
        let mut since = Since::default();
        assert_eq!(since.part(None), 0);
        assert_eq!(since.part(Some(FaultKind::Stale)), 1);
        assert_eq!(since.part(Some(FaultKind::Jumped([3, 0]))), 2);
        assert!((0..AFTER).all(|_| since.part(None) == 4));
        assert_eq!(since.part(None), 0);
    }

    #[test]
    fn what_is_met_is_kept_by_cell_and_by_part() {
        let mut covered = Covered::default();
        let of = |x: f64, force: f64| {
            Cell::of(Vector::new(x, 0.3), Vector::new(0.0, 0.0), [force, 0.0], 0)
        };
        covered.next(of(-0.1, 1.0));
        covered.judged(Law::TipForce, Margin(0.123_456), true);
        covered.next(of(0.1, 1.0));
        covered.judged(Law::TipForce, Margin(0.7), true);
        covered.back_to(0);
        covered.judged(Law::Repeats, Margin(f64::NAN), true);
        covered.judged(Law::Safe, Margin(-0.3), false);
        let met = covered.met();
        let force = &met[Law::TipForce as usize];
        assert_eq!(force.samples(), 2);
        assert!(force.has(of(-0.1, 1.0)) && !force.has(of(0.1, 5.0)));
        assert_eq!(force.part(number(0, 0)), (1, Some(0.123)));
        assert_eq!(force.part(number(1, 0)), (2, Some(0.123)));
        assert_eq!(force.part(number(2, 2)), (0, None));
        let repeats = &met[Law::Repeats as usize];
        assert_eq!(repeats.part(number(0, 0)), (1, None));
        assert_eq!(met[Law::Gap as usize], Met::default());
        assert_eq!(repeats.broken_in(), Some(of(-0.1, 1.0)));
        assert_eq!(force.broken_in(), None);
        let safe = &met[Law::Safe as usize];
        assert_eq!((safe.samples(), safe.broken_in()), (0, Some(of(-0.1, 1.0))));
    }
}
