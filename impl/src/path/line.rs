//! This file says how a point lies to a straight line.

use super::{Nearest, Path, beside_line, of, piece};
use crate::number::Real;
use crate::vector::Vector;

/// A straight line, endless on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<R> {
    from_m: Vector<R>,
    direction: Vector<R>,
}

impl<R: Real> Line<R> {
    /// The line from one point through another, m; `None` if they are not finite or less than
    /// [`SHORTEST_PIECE_M`](rigproof_spec::settings::SHORTEST_PIECE_M) apart.
    pub fn through(from_m: [f64; 2], to_m: [f64; 2]) -> Option<Line<R>> {
        let (direction, _) = piece(from_m, to_m)?;
        Some(Line {
            from_m: of(from_m.into()),
            direction: of(direction),
        })
    }
}

impl<R: Real> Path<R> for Line<R> {
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        beside_line(point_m - self.from_m, self.direction)
    }
}
