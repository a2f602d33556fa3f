//! This file says how a point lies to a chain of straight pieces.

use nalgebra::Vector2;

use super::line::{finite, long_enough};
use super::{Nearest, Path, around, beside, length};
use crate::error::ModelError;

/// Straight pieces from corner to corner; a closed one returns to its first corner, an open one goes on straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    pieces: Vec<Piece>,
    closed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    from_m: Vector2<f64>,
    direction: Vector2<f64>,
    length_m: f64,
}

impl Polyline {
    /// An open chain through at least two corners, m.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`]; [`ModelError::PathPiece`] when neighbours are less than
    /// [`SHORTEST_PIECE_M`](super::super::SHORTEST_PIECE_M) apart; [`ModelError::TooFew`].
    pub fn open(corners_m: &[[f64; 2]]) -> Result<Polyline, ModelError> {
        enough(corners_m.len(), 2)?;
        Polyline::chain(corners_m.to_vec(), false)
    }

    /// A closed chain through at least three corners, m; the obstacle it bounds lies to its left if it runs
    /// counter-clockwise.
    ///
    /// # Errors
    /// As [`Polyline::open`].
    pub fn closed(corners_m: &[[f64; 2]]) -> Result<Polyline, ModelError> {
        enough(corners_m.len(), 3)?;
        let mut corners_m = corners_m.to_vec();
        corners_m.extend(corners_m.first().copied());
        Polyline::chain(corners_m, true)
    }

    fn chain(corners_m: Vec<[f64; 2]>, closed: bool) -> Result<Polyline, ModelError> {
        let mut pieces = Vec::new();
        for (from_m, to_m) in corners_m.iter().zip(corners_m.iter().skip(1)) {
            let (from_m, to_m) = (finite(*from_m)?, finite(*to_m)?);
            let way = to_m - from_m;
            let length_m = long_enough("piece of the polyline", length(way))?;
            pieces.push(Piece {
                from_m,
                direction: way / length_m,
                length_m,
            });
        }
        Ok(Polyline { pieces, closed })
    }

    /// The direction of the piece before the one at `index`, of the last one for the first of a closed chain.
    fn before(&self, index: usize) -> Option<Vector2<f64>> {
        let before = match index.checked_sub(1) {
            Some(before) => self.pieces.get(before),
            None if self.closed => self.pieces.last(),
            None => None,
        };
        before.map(|piece| piece.direction)
    }

    fn after(&self, index: usize) -> Option<Vector2<f64>> {
        let after = match self.pieces.get(index + 1) {
            Some(after) => Some(after),
            None if self.closed => self.pieces.first(),
            None => None,
        };
        after.map(|piece| piece.direction)
    }
}

impl Path for Polyline {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let point = Vector2::from(point_m);
        let mut best: Option<Nearest> = None;
        for (index, piece) in self.pieces.iter().enumerate() {
            let along_m = (point - piece.from_m).dot(&piece.direction);
            let end_m = piece.from_m + piece.direction * piece.length_m;
            let candidate = match (self.before(index), self.after(index)) {
                (Some(before), _) if along_m <= 0.0 => {
                    around(point, piece.from_m, before, piece.direction)
                }
                (_, Some(after)) if along_m >= piece.length_m => {
                    around(point, end_m, piece.direction, after)
                }
                _ => {
                    let foot_m = piece.from_m + piece.direction * along_m;
                    beside(point, foot_m, piece.direction)
                }
            };
            best = match best {
                Some(best) if best.distance_m() <= candidate.distance_m() => Some(best),
                _ => Some(candidate),
            };
        }
        // A chain has at least one piece; without one there would be no path to be near to.
        best.unwrap_or(Nearest {
            foot_m: point,
            tangent: Vector2::new(f64::NAN, f64::NAN),
            offset_m: f64::NAN,
        })
    }
}

/// Whether enough points are there.
pub(super) fn enough(count: usize, least: usize) -> Result<(), ModelError> {
    if count >= least {
        Ok(())
    } else {
        Err(ModelError::TooFew {
            what: "points of the path",
            count,
            least,
        })
    }
}
