//! This file fits one explanation, a set of terms together, and gives its squared residual on each
//! left-out block.

use super::factor::Factor;
use super::folds::{Column, Folds, of_cell};
use crate::cause::Cause;
use crate::problem::{Kept, Problem, Rows, Term, add};
use crate::regression::dot;
use nalgebra::{DMatrix, DVector};
use rigproof_model::effects::{Form, OfSensor, form};
use std::sync::Arc;

/// The normal equations of one block.
#[derive(Clone)]
struct Part {
    gram: DMatrix<f64>,
    moment: DVector<f64>,
    square: f64,
    /// The factor of the scaled normal equations of all other blocks.
    others: Factor,
}

impl Part {
    /// The squared residual of the block with these coefficients.
    fn left(&self, coefficients: &DVector<f64>) -> f64 {
        let quadratic = (&self.gram * coefficients).dot(coefficients);
        (self.square - 2.0 * self.moment.dot(coefficients) + quadratic).max(0.0)
    }
}

/// An explanation with its least-squares fit.
#[derive(Clone)]
pub struct Fitted {
    /// The terms beyond the nominal model, in the order in which they entered.
    pub terms: Vec<Term>,
    /// The number of nuisance columns: parameters that the description leaves open.
    nuisance: usize,
    /// The whitened columns on usable rows.
    columns: Vec<Column>,
    /// One over the length of each column over all blocks.
    scale: Vec<f64>,
    /// The whitened target on usable rows. Explanations without a fixed effort share it.
    target: Column,
    /// The driving effort that reaches the plant, row by row, before any gain of the force sensor.
    acting: Arc<Vec<f64>>,
    /// Columns of a force sensor's gain, with their positions among all columns.
    gains: Vec<(usize, Arc<Rows>)>,
    parts: Vec<Arc<Part>>,
    /// The factor of the scaled normal equations of all blocks.
    whole: Factor,
    /// The squared residual of each block when the coefficients come from the other blocks.
    pub losses: Vec<f64>,
    /// The coefficient of each column, nuisance columns first.
    pub coefficients: Vec<f64>,
}

impl Fitted {
    /// The fit of the nuisance columns alone to a white target.
    pub fn bare(folds: &Folds, target: &[f64], free: &[&Rows]) -> Fitted {
        let target = folds.usable(target);
        let nothing = || Factor::of(DMatrix::zeros(0, 0));
        let parts = folds.dots(&target, &target).into_iter();
        let parts = parts.map(|square| Part {
            gram: DMatrix::zeros(0, 0),
            moment: DVector::zeros(0),
            square,
            others: nothing(),
        });
        let mut fitted = Fitted {
            terms: Vec::new(),
            nuisance: free.len(),
            columns: Vec::new(),
            scale: Vec::new(),
            target,
            acting: folds.driving.clone(),
            gains: Vec::new(),
            parts: parts.map(Arc::new).collect(),
            whole: nothing(),
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
        free: Vec<Column>,
        fixed: Option<Column>,
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

    /// The fit without one of its terms; `None` where it has to be fitted anew: for a term that acts
    /// with a fixed effort, beside gains of a force sensor, and without a factor.
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
        for _ in 0..count {
            fewer.take_out(first)?;
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

    /// Whether a coefficient says that the description has another unit or sign than the recording.
    pub fn is_another_unit(&self, problem: &Problem) -> bool {
        let mut own = self.terms.iter().zip(self.by_term());
        own.any(|(term, own)| problem.run.is_another_unit(term.cause, own))
    }

    /// The residual of every row when the coefficients come from all usable rows; 0 in the others.
    pub fn residual(&self, folds: &Folds) -> Vec<f64> {
        let mut left = self.target.rows.to_vec();
        for (column, times) in self.columns.iter().zip(&self.coefficients) {
            add(&mut left, &column.rows, -times);
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

    /// The energies of the effort that reaches the plant in each cell; `None` if that is the recorded
    /// effort.
    pub fn acting_energies(&self, folds: &Folds) -> Option<Vec<[f64; 2]>> {
        if self.gains.is_empty() && Arc::ptr_eq(&self.acting, &folds.driving) {
            return None;
        }
        let mut acting = self.acting.to_vec();
        for (place, column) in &self.gains {
            let gain = self.coefficients.get(*place).copied().unwrap_or(0.0);
            add(&mut acting, &column.raw, -gain);
        }
        Some(folds.energies(&acting))
    }

    /// The squared residual of a cell with these coefficients.
    fn left_in(&self, folds: &Folds, cell: usize, coefficients: &DVector<f64>) -> f64 {
        let range = folds.cells.get(cell).copied().unwrap_or_default();
        let mut left = of_cell(&self.target.rows, range).to_vec();
        for (column, times) in self.columns.iter().zip(coefficients.iter()) {
            if column.acts(cell) {
                add(&mut left, of_cell(&column.rows, range), -times);
            }
        }
        dot(&left, &left)
    }

    /// Adds a column; `ridge` is the precision of its coefficient without the recording.
    fn take_in(&mut self, folds: &Folds, ridge: f64, column: Column) {
        let size = self.columns.len();
        let with_target = folds.dots(&column, &self.target);
        let all = self.columns.iter().chain([&column]);
        let products: Vec<Vec<f64>> = all.map(|other| folds.dots(&column, other)).collect();
        let sums = products.iter().map(|own| own.iter().sum());
        let whole = raised(DVector::from_iterator(size + 1, sums), ridge);
        let energy = whole.as_slice().last().copied().unwrap_or(0.0);
        let length = energy.sqrt().max(1e-150);
        self.scale.push(1.0 / length);
        let scale = DVector::from_column_slice(&self.scale);
        let scaled =
            |products: DVector<f64>| raised(products.component_mul(&scale) / length, RIDGE);
        let blocks = self.parts.iter().enumerate();
        let parts = blocks.map(|(block, part)| {
            let of_block = |own: &Vec<f64>| own.get(block).copied().unwrap_or(0.0);
            let own = DVector::from_iterator(size + 1, products.iter().map(of_block));
            Arc::new(Part {
                gram: bordered(&part.gram, &own),
                moment: part.moment.push(of_block(&with_target)),
                square: part.square,
                others: part.others.with(scaled(&whole - own)),
            })
        });
        self.parts = parts.collect();
        self.whole = self.whole.with(scaled(whole));
        self.columns.push(column);
    }

    /// Removes a column; `None` where a block's factor is not known.
    fn take_out(&mut self, index: usize) -> Option<()> {
        let fewer = |part: &Arc<Part>| {
            Some(Arc::new(Part {
                others: part.others.without(index)?,
                gram: part.gram.clone().remove_row(index).remove_column(index),
                moment: part.moment.clone().remove_row(index),
                square: part.square,
            }))
        };
        self.parts = self.parts.iter().map(fewer).collect::<Option<_>>()?;
        self.whole = self.whole.without(index)?;
        self.columns.remove(index);
        self.scale.remove(index);
        Some(())
    }

    fn take_away(&mut self, folds: &Folds, fixed: &Column) {
        let with_target = folds.dots(fixed, &self.target);
        let with_itself = folds.dots(fixed, fixed);
        let columns = self.columns.iter();
        let with_columns: Vec<Vec<f64>> = columns.map(|own| folds.dots(fixed, own)).collect();
        for (block, part) in self.parts.iter_mut().enumerate() {
            let at = |values: &[f64]| values.get(block).copied().unwrap_or(0.0);
            let part = Arc::make_mut(part);
            part.square += at(&with_itself) - 2.0 * at(&with_target);
            for (moment, products) in part.moment.iter_mut().zip(&with_columns) {
                *moment -= at(products);
            }
        }
        let left = self.target.rows.iter().zip(&*fixed.rows);
        self.target = folds.column(left.map(|(y, x)| y - x));
    }

    fn solve(&mut self, folds: &Folds) {
        let scale = DVector::from_column_slice(&self.scale);
        let solved = |factor: &Factor, moment: DVector<f64>| {
            factor
                .solve(moment.component_mul(&scale))
                .component_mul(&scale)
        };
        let nothing = DVector::zeros(self.columns.len());
        let moment = self
            .parts
            .iter()
            .fold(nothing, |sum, part| sum + &part.moment);
        let blocks = self.parts.iter().zip(&folds.blocks);
        let losses = blocks.flat_map(|(part, &(first, end))| {
            let solution = solved(&part.others, &moment - &part.moment);
            match folds.is_split() {
                true => (first..end)
                    .map(|cell| self.left_in(folds, cell, &solution))
                    .collect(),
                false => vec![part.left(&solution)],
            }
        });
        self.losses = losses.collect();
        self.coefficients = solved(&self.whole, moment).as_slice().to_vec();
    }
}

/// A symmetric matrix with one row and one column more.
fn bordered(gram: &DMatrix<f64>, last: &DVector<f64>) -> DMatrix<f64> {
    let size = gram.nrows();
    let mut more = gram.clone().resize(size + 1, size + 1, 0.0);
    more.set_column(size, last);
    more.set_row(size, &last.transpose());
    more
}

/// A vector of which the last number is greater by so much.
fn raised(mut own: DVector<f64>, by: f64) -> DVector<f64> {
    if let Some(last) = own.as_mut_slice().last_mut() {
        *last += by;
    }
    own
}

/// The ridge, relative to columns of length 1. No recording determines a coefficient this weakly.
const RIDGE: f64 = 1e-8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::five_bar::recorded::{problem, short_run};
    use crate::plants::five_bar::run::at;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn a_fit_that_a_term_leaves_is_the_fit_of_the_others() {
        let run = short_run();
        let problem = problem(&run);
        let folds = Folds::of(&problem);
        let terms = [Joint::A, Joint::B, Joint::C].map(|joint| {
            problem
                .whole_term(at(Mechanism::Viscous, joint), &[])
                .unwrap()
        });
        let bare = Fitted::bare(&folds, &problem.target.white, &[]);
        let fewer = bare.of(&folds, &terms).without(&folds, 1).unwrap();
        let anew = bare.of(&folds, &[terms[0].clone(), terms[2].clone()]);
        assert!(fewer.causes().eq(anew.causes()));
        for (own, other) in [
            (&fewer.coefficients, &anew.coefficients),
            (&fewer.losses, &anew.losses),
        ] {
            assert_eq!(own.len(), other.len());
            let pairs = own.iter().zip(other);
            for (own, other) in pairs {
                assert!((own - other).abs() < 1e-9 * other.abs(), "{own} {other}");
            }
        }
    }
}
