//! This file fits one explanation, a set of terms together, and gives its squared residual on each
//! left-out block.

use crate::cause::Cause;
use crate::problem::{Kept, Problem, Rows, Term, add};
use crate::regression::{Blocks, dot};
use crate::rules::FEWEST_ROWS;
use nalgebra::{DMatrix, DVector};
use rigproof_model::effects::{Form, OfSensor, form};
use std::sync::Arc;

/// The blocks of cross-validation. Unusable rows are removed, so the rows of a block are stored
/// contiguously.
pub struct Folds {
    /// The index of each usable row among all rows.
    rows: Vec<usize>,
    /// The place of each of these rows among all usable rows, those of short blocks too.
    places: Vec<usize>,
    /// First and end position of each block among the usable rows.
    ranges: Vec<(usize, usize)>,
    /// The same of each part of a block whose rows have one noise.
    cells: Vec<(usize, usize)>,
    /// The number of rows of each of these parts.
    pub counts: Vec<f64>,
    /// The driving effort of every row.
    driving: Arc<Vec<f64>>,
    /// Its energy.
    driving_energy: f64,
    /// The number of rows that carry as much information as one independent sample.
    rows_a_sample: f64,
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
        let of_block = |&(first, end): &(usize, usize)| -> Vec<usize> {
            let is_usable = |row: &usize| usable.get(*row) == Some(&true);
            let mut rows: Vec<usize> = (first..end).filter(is_usable).collect();
            rows.sort_by_key(|row| row % outputs);
            rows
        };
        let blocks = Blocks::new(problem).ranges;
        let blocks = blocks.iter().map(of_block);
        let mut rows: Vec<usize> = Vec::new();
        let (mut ranges, mut cells) = (Vec::new(), Vec::new());
        let fewest = match problem.windows.are_alone() {
            true => 0,
            false => FEWEST_ROWS,
        };
        for block in blocks.filter(|block| block.len() > fewest) {
            ranges.push((rows.len(), rows.len() + block.len()));
            for cell in block.chunk_by(|a, b| a % outputs == b % outputs) {
                cells.push((rows.len(), rows.len() + cell.len()));
                rows.extend(cell);
            }
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
        Folds {
            counts: counts.collect(),
            driving_energy: dot(&driving, &driving),
            driving: Arc::new(driving),
            rows_a_sample: problem.rows_a_sample,
            places: places.collect(),
            rows,
            ranges,
            cells,
        }
    }

    fn usable(&self, column: &[f64]) -> Arc<[f64]> {
        let rows = self.rows.iter();
        rows.map(|row| column.get(*row).copied().unwrap_or(0.0))
            .collect()
    }

    /// The same of what is packed.
    fn unpacked(&self, column: &[f32]) -> Arc<[f64]> {
        let places = self.places.iter();
        places
            .map(|place| column.get(*place).copied().map_or(0.0, f64::from))
            .collect()
    }

    /// The number of usable rows in all blocks.
    pub fn rows(&self) -> f64 {
        self.counts.iter().sum()
    }

    /// The mean number of usable rows of a block.
    pub fn mean_rows(&self) -> f64 {
        self.rows() / self.ranges.len().max(1) as f64
    }

    /// The median over blocks of a column's root mean square.
    pub fn typical(&self, column: &[f64]) -> f64 {
        let own = self.usable(column);
        let energies = self.dots(&own, &own).into_iter();
        let lengths = self.ranges.iter().map(|(first, end)| (end - first) as f64);
        let mut squares: Vec<f64> = energies.zip(lengths).map(|(e, n)| e / n).collect();
        squares.sort_by(f64::total_cmp);
        squares
            .get(squares.len() / 2)
            .copied()
            .unwrap_or(0.0)
            .sqrt()
    }

    /// Whether a block has parts with noise of their own.
    fn is_split(&self) -> bool {
        self.cells.len() > self.ranges.len()
    }

    /// The squares of the rows of a block, summed over each of its parts.
    fn energies(&self, rows: &[f64], (first, end): (usize, usize)) -> Vec<f64> {
        let own = self.cells.iter();
        let own = own.filter(|cell| first <= cell.0 && cell.1 <= end);
        let own = own.map(|cell| rows.get(cell.0 - first..cell.1 - first).unwrap_or_default());
        own.map(|part| dot(part, part)).collect()
    }

    fn dots(&self, a: &[f64], b: &[f64]) -> Vec<f64> {
        let ranges = self.ranges.iter();
        ranges
            .map(|&(first, end)| {
                dot(
                    a.get(first..end).unwrap_or_default(),
                    b.get(first..end).unwrap_or_default(),
                )
            })
            .collect()
    }
}

/// The normal equations of one block.
#[derive(Clone)]
struct Part {
    gram: DMatrix<f64>,
    moment: DVector<f64>,
    square: f64,
}

/// An explanation with its least-squares fit.
#[derive(Clone)]
pub struct Fitted {
    /// The terms beyond the nominal model, in the order in which they entered.
    pub terms: Vec<Term>,
    /// The number of nuisance columns: parameters that the description leaves open.
    nuisance: usize,
    /// The whitened columns on usable rows.
    columns: Vec<Arc<[f64]>>,
    /// The precision of the coefficient of each column without the recording.
    ridge: Vec<f64>,
    /// The whitened target on usable rows. Explanations without a fixed effort share it.
    target: Arc<Vec<f64>>,
    /// The driving effort that reaches the plant, row by row, before any gain of the force sensor.
    acting: Arc<Vec<f64>>,
    /// Columns of a force sensor's gain, with their positions among all columns.
    gains: Vec<(usize, Arc<Rows>)>,
    parts: Vec<Part>,
    /// The squared residual of each block when the coefficients come from the other blocks.
    pub losses: Vec<f64>,
    /// The coefficient of each column, nuisance columns first.
    pub coefficients: Vec<f64>,
}

impl Fitted {
    /// The fit of the nuisance columns alone to a white target.
    pub fn bare(folds: &Folds, target: &[f64], free: &[&Rows]) -> Fitted {
        let target = Arc::new(folds.usable(target).to_vec());
        let parts = folds.dots(&target, &target).into_iter();
        let parts = parts.map(|square| Part {
            gram: DMatrix::zeros(0, 0),
            moment: DVector::zeros(0),
            square,
        });
        let mut fitted = Fitted {
            terms: Vec::new(),
            nuisance: free.len(),
            columns: Vec::new(),
            ridge: Vec::new(),
            target,
            acting: folds.driving.clone(),
            gains: Vec::new(),
            parts: parts.collect(),
            losses: Vec::new(),
            coefficients: Vec::new(),
        };
        for column in free {
            let white = folds.usable(&column.white);
            fitted.take_in(folds, column.ridge(folds.rows_a_sample), white);
        }
        fitted.solve(folds);
        fitted
    }

    /// The fit with one more term.
    pub fn with(&self, folds: &Folds, term: &Term) -> Fitted {
        let usable = |own: &Arc<Rows>| folds.usable(&own.white);
        let free = term.free.iter().map(usable).collect();
        self.joined_by(folds, term.clone(), free, term.fixed.as_ref().map(usable))
    }

    /// The same with a kept term, for its evidence: of a packed one the fit has no rows but the
    /// white ones.
    pub fn with_kept(&self, folds: &Folds, kept: &Kept) -> Fitted {
        let packed = match kept {
            Kept::Whole(term) => return self.with(folds, term),
            Kept::Packed(packed) => packed,
        };
        let free = packed.free.iter().map(|(own, _)| folds.unpacked(own));
        let fixed = packed.fixed.as_ref().map(|own| folds.unpacked(own));
        self.joined_by(folds, packed.without_rows(), free.collect(), fixed)
    }

    /// The fit with a term whose white columns on usable rows are these.
    fn joined_by(
        &self,
        folds: &Folds,
        term: Term,
        free: Vec<Arc<[f64]>>,
        fixed: Option<Arc<[f64]>>,
    ) -> Fitted {
        let mut fitted = self.clone();
        if let (Some(white), Some(fixed)) = (fixed, &term.fixed) {
            fitted.take_away(folds, &white);
            if term.cause.is_of_drive() {
                add(
                    Arc::make_mut(&mut fitted.acting).as_mut_slice(),
                    &fixed.raw,
                    -1.0,
                );
            }
        }
        for (column, white) in term.free.iter().zip(free) {
            if let Some(Form::Sensor(OfSensor::ForceGain)) = form(term.cause.mechanism) {
                fitted.gains.push((fitted.columns.len(), column.clone()));
            }
            fitted.take_in(folds, column.ridge(folds.rows_a_sample), white);
        }
        fitted.terms.push(term);
        fitted.solve(folds);
        fitted
    }

    /// The fit without one of its terms; `None` for a term that acts with a fixed effort, and beside
    /// gains of a force sensor.
    pub fn without(&self, folds: &Folds, index: usize) -> Option<Fitted> {
        let term = self.terms.get(index)?;
        if term.fixed.is_some() || !self.gains.is_empty() {
            return None;
        }
        let before = self.terms.iter().take(index);
        let first = self.nuisance + before.map(|own| own.free.len()).sum::<usize>();
        let count = term.free.len();
        let mut fewer = self.clone();
        fewer.terms.remove(index);
        fewer.columns.drain(first..first + count);
        fewer.ridge.drain(first..first + count);
        for part in &mut fewer.parts {
            let gram = core::mem::take(&mut part.gram).remove_rows(first, count);
            part.gram = gram.remove_columns(first, count);
            part.moment = core::mem::take(&mut part.moment).remove_rows(first, count);
        }
        fewer.solve(folds);
        Some(fewer)
    }

    /// The fit of these terms on top of this one.
    pub fn of(&self, folds: &Folds, terms: &[Term]) -> Fitted {
        terms
            .iter()
            .fold(self.clone(), |fitted, term| fitted.with(folds, term))
    }

    /// The causes of its terms.
    pub fn causes(&self) -> impl Iterator<Item = Cause> {
        self.terms.iter().map(|term| term.cause)
    }

    /// Whether another fit has the same causes, late or not as here.
    pub fn is_like(&self, other: &Fitted) -> bool {
        let same =
            |a: &Term, b: &Term| a.cause == b.cause && a.onset_s.is_some() == b.onset_s.is_some();
        let mut own = self.terms.iter();
        self.terms.len() == other.terms.len()
            && own.all(|term| other.terms.iter().any(|own| same(own, term)))
    }

    pub fn by_term(&self) -> Vec<&[f64]> {
        let mut rest = self.coefficients.get(self.nuisance..).unwrap_or_default();
        let mut own = |term: &Term| {
            let (first, others) = rest.split_at(term.free.len().min(rest.len()));
            rest = others;
            first
        };
        self.terms.iter().map(&mut own).collect()
    }

    /// The residual of every row when the coefficients come from all usable rows; 0 in the others.
    pub fn residual(&self, folds: &Folds) -> Vec<f64> {
        let mut left = self.target.to_vec();
        for (column, times) in self.columns.iter().zip(&self.coefficients) {
            add(&mut left, column, -times);
        }
        let mut all = vec![0.0; folds.driving.len()];
        for (row, value) in folds.rows.iter().zip(left) {
            if let Some(slot) = all.get_mut(*row) {
                *slot = value;
            }
        }
        all
    }

    /// The squared residual over all left-out blocks.
    pub fn left(&self) -> f64 {
        self.losses.iter().sum()
    }

    /// The energy of the effort that reaches the plant, over that of the recorded effort.
    ///
    /// A change of the drive that shrinks the effort shrinks every residual with it. Residuals are
    /// therefore divided by this share.
    pub fn acting_share(&self, folds: &Folds) -> f64 {
        if self.gains.is_empty() && Arc::ptr_eq(&self.acting, &folds.driving) {
            return 1.0;
        }
        let mut acting = self.acting.to_vec();
        for (place, column) in &self.gains {
            let gain = self.coefficients.get(*place).copied().unwrap_or(0.0);
            add(&mut acting, &column.raw, -gain);
        }
        dot(&acting, &acting) / folds.driving_energy.max(1e-300)
    }

    /// The residual of some rows with these coefficients.
    fn left_of(&self, (first, end): (usize, usize), coefficients: &DVector<f64>) -> Vec<f64> {
        let mut left = self.target.get(first..end).unwrap_or_default().to_vec();
        for (column, times) in self.columns.iter().zip(coefficients.iter()) {
            add(
                &mut left,
                column.get(first..end).unwrap_or_default(),
                -times,
            );
        }
        left
    }

    fn take_in(&mut self, folds: &Folds, ridge: f64, column: Arc<[f64]>) {
        self.ridge.push(ridge);
        let size = self.columns.len();
        let with_target = folds.dots(&column, &self.target);
        let with_itself = folds.dots(&column, &column);
        let with_others: Vec<Vec<f64>> = self
            .columns
            .iter()
            .map(|other| folds.dots(&column, other))
            .collect();
        for (block, part) in self.parts.iter_mut().enumerate() {
            let at = |values: &[f64]| values.get(block).copied().unwrap_or(0.0);
            let mut gram = part.gram.clone().resize(size + 1, size + 1, 0.0);
            for (k, products) in with_others.iter().enumerate() {
                set(&mut gram, (k, size), at(products));
                set(&mut gram, (size, k), at(products));
            }
            set(&mut gram, (size, size), at(&with_itself));
            part.gram = gram;
            part.moment = part.moment.clone().push(at(&with_target));
        }
        self.columns.push(column);
    }

    fn take_away(&mut self, folds: &Folds, fixed: &[f64]) {
        let with_target = folds.dots(fixed, &self.target);
        let with_itself = folds.dots(fixed, fixed);
        let with_columns: Vec<Vec<f64>> = self
            .columns
            .iter()
            .map(|column| folds.dots(fixed, column))
            .collect();
        for (block, part) in self.parts.iter_mut().enumerate() {
            let at = |values: &[f64]| values.get(block).copied().unwrap_or(0.0);
            part.square += at(&with_itself) - 2.0 * at(&with_target);
            for (moment, products) in part.moment.iter_mut().zip(&with_columns) {
                *moment -= at(products);
            }
        }
        for (y, x) in Arc::make_mut(&mut self.target).iter_mut().zip(fixed) {
            *y -= x;
        }
    }

    fn solve(&mut self, folds: &Folds) {
        let size = self.columns.len();
        let mut sum = Part {
            gram: DMatrix::from_diagonal(&DVector::from_column_slice(&self.ridge)),
            moment: DVector::zeros(size),
            square: 0.0,
        };
        for part in &self.parts {
            sum.gram += &part.gram;
            sum.moment += &part.moment;
        }
        let scale = sum.gram.diagonal().map(|d| 1.0 / d.sqrt().max(1e-150));
        let others = |part: &Part| {
            let (gram, moment) = (&sum.gram - &part.gram, &sum.moment - &part.moment);
            solution(&gram, &moment, &scale)
        };
        let left = |part: &Part| {
            let solution = others(part);
            let quadratic = (&part.gram * &solution).dot(&solution);
            (part.square - 2.0 * part.moment.dot(&solution) + quadratic).max(0.0)
        };
        self.losses = match folds.is_split() {
            false => self.parts.iter().map(left).collect(),
            true => {
                let blocks = self.parts.iter().zip(&folds.ranges);
                let each = blocks.flat_map(|(part, range)| {
                    let left = self.left_of(*range, &others(part));
                    folds.energies(&left, *range)
                });
                each.collect()
            }
        };
        let all = solution(&sum.gram, &sum.moment, &scale);
        self.coefficients = all.iter().copied().collect();
    }
}

fn set(matrix: &mut DMatrix<f64>, at: (usize, usize), value: f64) {
    if let Some(slot) = matrix.get_mut(at) {
        *slot = value;
    }
}

/// The least-squares solution. Each column is scaled to length 1, and a ridge keeps dependent
/// columns solvable.
fn solution(gram: &DMatrix<f64>, moment: &DVector<f64>, scale: &DVector<f64>) -> DVector<f64> {
    let size = moment.len();
    let mut scaled = gram.component_mul(&(scale * scale.transpose()));
    for k in 0..size {
        let diagonal = scaled.get((k, k)).copied().unwrap_or(0.0);
        set(&mut scaled, (k, k), diagonal + RIDGE);
    }
    match scaled.cholesky() {
        Some(factor) => factor
            .solve(&moment.component_mul(scale))
            .component_mul(scale),
        None => DVector::zeros(size),
    }
}

/// The ridge, relative to columns of length 1. No recording determines a coefficient this weakly.
const RIDGE: f64 = 1e-8;
