//! This file checks settings against their ranges.

use crate::number::Real;

/// A setting inside its range, both ends included.
pub(crate) fn setting<R: Real>(value: f64, [least, greatest]: [f64; 2]) -> Option<R> {
    (least..=greatest).contains(&value).then(|| R::of(value))
}
