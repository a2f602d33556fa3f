//! This file says how a point lies to a straight line.

use nalgebra::Vector2;

use super::{Nearest, Path, beside, length};
use crate::error::ModelError;

/// A straight line, endless on both sides.
///
/// ```
/// use rigproof_model::control::path::{Line, Path};
/// // The line y = 38 cm of the thesis's simulations (§6.4), seen from 4 cm below it.
/// let line = Line::through([-0.21, 0.38], [0.17, 0.38])?;
/// assert!((line.nearest([0.05, 0.34]).distance_m() - 0.04).abs() < 1e-15);
/// # Ok::<(), rigproof_model::ModelError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    from_m: Vector2<f64>,
    direction: Vector2<f64>,
}

impl Line {
    /// The line from one point through another, m; it runs from the first to the second.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`]; [`ModelError::PathPiece`] when the points are less than
    /// [`SHORTEST_PIECE_M`](super::super::SHORTEST_PIECE_M) apart.
    pub fn through(from_m: [f64; 2], to_m: [f64; 2]) -> Result<Line, ModelError> {
        let (from_m, to_m) = (finite(from_m)?, finite(to_m)?);
        let way = to_m - from_m;
        let length_m = long_enough("line", length(way))?;
        Ok(Line {
            from_m,
            direction: way / length_m,
        })
    }
}

impl Path for Line {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let point = Vector2::from(point_m);
        let along_m = (point - self.from_m).dot(&self.direction);
        beside(
            point,
            self.from_m + self.direction * along_m,
            self.direction,
        )
    }
}

/// A point of a path.
pub(super) fn finite(point_m: [f64; 2]) -> Result<Vector2<f64>, ModelError> {
    for value in point_m {
        if !value.is_finite() {
            return Err(ModelError::NotFinite {
                quantity: "a coordinate of the path",
                value,
                unit: "m",
            });
        }
    }
    Ok(Vector2::from(point_m))
}

/// A length that gives a direction.
pub(super) fn long_enough(piece: &'static str, length_m: f64) -> Result<f64, ModelError> {
    let least_m = super::super::SHORTEST_PIECE_M;
    if length_m >= least_m {
        Ok(length_m)
    } else {
        Err(ModelError::PathPiece {
            piece,
            length_m,
            least_m,
        })
    }
}
