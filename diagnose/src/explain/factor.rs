//! This file solves normal equations that gain and lose columns one at a time.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// The Cholesky factor of a Gram matrix; `None` where rounding leaves none.
#[derive(Clone)]
pub struct Factor(Option<Cholesky<f64, Dyn>>);

impl Factor {
    pub fn of(gram: DMatrix<f64>) -> Factor {
        Factor(gram.cholesky())
    }

    /// The factor with one column more, the last one, whose products with all columns are these.
    pub fn with(&self, products: DVector<f64>) -> Factor {
        let last = products.len().saturating_sub(1);
        let grown = self.0.as_ref().map(|own| own.insert_column(last, products));
        let pivot = |own: &Cholesky<f64, Dyn>| own.l_dirty().get((last, last)).copied();
        Factor(grown.filter(|own| pivot(own).is_some_and(|pivot| pivot > 0.0)))
    }

    /// The factor without one column; `None` where there is none to begin with.
    pub fn without(&self, index: usize) -> Option<Factor> {
        let own = self.0.as_ref()?;
        Some(Factor(Some(own.remove_column(index))))
    }

    /// The solution; 0 where there is no factor.
    pub fn solve(&self, right: DVector<f64>) -> DVector<f64> {
        match &self.0 {
            Some(own) => own.solve(&right),
            None => DVector::zeros(right.len()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_that_comes_and_goes_leaves_the_factor_of_the_others() {
        let gram = DMatrix::from_row_slice(3, 3, &[4.0, 1.2, -0.7, 1.2, 3.0, 0.4, -0.7, 0.4, 2.5]);
        let right = DVector::from_row_slice(&[1.0, -2.0, 0.6]);
        let apart = gram.clone().cholesky().unwrap().solve(&right);
        let empty = Factor::of(DMatrix::zeros(0, 0));
        let grown = (0..3).fold(empty, |own, k| {
            own.with(gram.column(k).rows(0, k + 1).into_owned())
        });
        assert!((grown.solve(right.clone()) - apart).amax() < 1e-14);
        let fewer = grown.without(1).unwrap();
        let own = gram.remove_row(1).remove_column(1).cholesky().unwrap();
        let right = right.remove_row(1);
        assert!((fewer.solve(right.clone()) - own.solve(&right)).amax() < 1e-14);
    }

    #[test]
    fn a_column_that_is_no_other_than_the_first_has_no_factor() {
        let one = Factor::of(DMatrix::from_element(1, 1, 1.0));
        let twice = one.with(DVector::from_element(2, 1.0));
        assert_eq!(twice.solve(DVector::from_element(2, 1.0)).amax(), 0.0);
        assert!(twice.without(0).is_none());
    }
}
