//! This file holds the blocks of cross-validation, and columns over their rows.

use crate::problem::Problem;
use crate::regression::{Blocks, dot};
use crate::rules::FEWEST_ROWS;
use std::sync::Arc;

/// The blocks of cross-validation. Unusable rows are removed, so the rows of a block are stored
/// contiguously.
pub struct Folds {
    /// The index of each usable row among all rows.
    pub rows: Vec<usize>,
    /// The place of each of these rows among all usable rows, those of short blocks too.
    places: Vec<usize>,
    /// First and end position of each part of a block whose rows have one noise: its cells.
    pub cells: Vec<(usize, usize)>,
    /// The first and the end row of each cell among all rows, of which each `outputs`-th is its own.
    spans: Vec<(usize, usize)>,
    outputs: usize,
    /// First and end position of the cells of each block.
    pub blocks: Vec<(usize, usize)>,
    /// The number of rows of each cell.
    pub counts: Vec<f64>,
    /// The driving effort of every row.
    pub driving: Arc<Vec<f64>>,
    /// Its energies in each cell.
    pub driving_energies: Vec<[f64; 2]>,
    /// The number of rows that carry as much information as one independent sample.
    pub rows_a_sample: f64,
}

/// A white column on usable rows.
#[derive(Clone)]
pub struct Column {
    pub rows: Arc<[f64]>,
    /// Whether it acts in each cell. A mechanism of one joint of an arm acts on few outputs.
    acts: Arc<[bool]>,
}

impl Column {
    pub fn acts(&self, cell: usize) -> bool {
        self.acts.get(cell) == Some(&true)
    }
}

impl Folds {
    /// The blocks with more than `FEWEST_ROWS` usable rows. Where many places may lack something,
    /// what is left at one says nothing of another: each output of a block is judged by itself.
    pub fn of(problem: &Problem) -> Folds {
        let usable = &problem.windows.usable;
        let outputs = match problem.rules.many {
            true => problem.windows.outputs,
            false => 1,
        };
        let of_block = |&(first, end): &(usize, usize)| -> (usize, Vec<usize>) {
            let is_usable = |row: &usize| usable.get(*row) == Some(&true);
            let mut rows: Vec<usize> = (first..end).filter(is_usable).collect();
            rows.sort_by_key(|row| row % outputs);
            (end, rows)
        };
        let all = Blocks::new(problem).ranges;
        let all = all.iter().map(of_block);
        let mut rows: Vec<usize> = Vec::new();
        let (mut cells, mut spans, mut blocks) = (Vec::new(), Vec::new(), Vec::new());
        let fewest = match problem.windows.are_alone() {
            true => 0,
            false => FEWEST_ROWS,
        };
        for (end, block) in all.filter(|(_, block)| block.len() > fewest) {
            let first = cells.len();
            for cell in block.chunk_by(|a, b| a % outputs == b % outputs) {
                cells.push((rows.len(), rows.len() + cell.len()));
                spans.push((cell.first().copied().unwrap_or(end), end));
                rows.extend(cell);
            }
            blocks.push((first, cells.len()));
        }
        let counts = cells.iter().map(|(first, end)| (end - first) as f64);
        let before = usable.iter().scan(0, |count, own| {
            let place = *count;
            *count += usize::from(*own);
            Some(place)
        });
        let before: Vec<usize> = before.collect();
        let places = rows.iter().filter_map(|row| before.get(*row).copied());
        let driving = problem.windows.average(&problem.run.driving());
        let mut folds = Folds {
            counts: counts.collect(),
            driving_energies: Vec::new(),
            driving: Arc::new(driving),
            rows_a_sample: problem.rows_a_sample,
            places: places.collect(),
            rows,
            cells,
            spans,
            outputs,
            blocks,
        };
        folds.driving_energies = folds.energies(&folds.driving);
        folds
    }

    /// The energy of a raw effort in each cell, and that of its changes from row to row. Rows that are
    /// not usable count too: a drive acts at rest.
    pub fn energies(&self, effort: &[f64]) -> Vec<[f64; 2]> {
        let of_cell = |&(first, end): &(usize, usize)| {
            let rows = effort.get(first..end).unwrap_or_default();
            let next = rows.iter().skip(self.outputs).step_by(self.outputs);
            let changes = rows.iter().step_by(self.outputs).zip(next);
            let energy = rows.iter().step_by(self.outputs).map(|e| e * e).sum();
            [
                energy,
                changes.map(|(own, next)| (next - own).powi(2)).sum(),
            ]
        };
        self.spans.iter().map(of_cell).collect()
    }

    /// A column of all rows on the usable ones.
    pub fn usable(&self, column: &[f64]) -> Column {
        let rows = self.rows.iter();
        self.column(rows.map(|row| column.get(*row).copied().unwrap_or(0.0)))
    }

    /// The same of what is packed.
    pub fn unpacked(&self, column: &[f32]) -> Column {
        let places = self.places.iter();
        self.column(places.map(|place| column.get(*place).copied().map_or(0.0, f64::from)))
    }

    pub fn column(&self, rows: impl Iterator<Item = f64>) -> Column {
        let rows: Arc<[f64]> = rows.collect();
        let cells = self.cells.iter();
        let acts = cells.map(|cell| of_cell(&rows, *cell).iter().any(|x| *x != 0.0));
        Column {
            acts: acts.collect(),
            rows,
        }
    }

    /// The number of usable rows in all blocks.
    pub fn count(&self) -> f64 {
        self.counts.iter().sum()
    }

    /// The mean number of usable rows of a block.
    pub fn mean_rows(&self) -> f64 {
        self.count() / self.blocks.len().max(1) as f64
    }

    /// The median over blocks of a column's root mean square.
    pub fn typical(&self, column: &[f64]) -> f64 {
        let own = self.usable(column);
        let energies = self.dots(&own, &own).into_iter();
        let lengths = self.blocks.iter().map(|(first, end)| {
            let cells = self.counts.get(*first..*end).unwrap_or_default();
            cells.iter().sum::<f64>()
        });
        let mut squares: Vec<f64> = energies.zip(lengths).map(|(e, n)| e / n).collect();
        squares.sort_by(f64::total_cmp);
        squares
            .get(squares.len() / 2)
            .copied()
            .unwrap_or(0.0)
            .sqrt()
    }

    /// Whether a block has cells with noise of their own.
    pub fn is_split(&self) -> bool {
        self.cells.len() > self.blocks.len()
    }

    /// The inner product of two columns in each block.
    pub fn dots(&self, a: &Column, b: &Column) -> Vec<f64> {
        let of_block = |&(first, end): &(usize, usize)| {
            let both = (first..end).filter(|cell| a.acts(*cell) && b.acts(*cell));
            let cells = both.filter_map(|cell| self.cells.get(cell));
            cells
                .map(|cell| dot(of_cell(&a.rows, *cell), of_cell(&b.rows, *cell)))
                .sum()
        };
        self.blocks.iter().map(of_block).collect()
    }
}

/// The rows of a cell.
pub fn of_cell(rows: &[f64], (first, end): (usize, usize)) -> &[f64] {
    rows.get(first..end).unwrap_or_default()
}
