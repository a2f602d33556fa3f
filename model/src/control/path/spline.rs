//! This file says how a point lies to a smooth curve through given points.

use nalgebra::Vector2;

use super::line::{finite, long_enough};
use super::polyline::enough;
use super::{Nearest, Path, beside, length, nearer};
use crate::error::ModelError;

/// Samples of a piece between which at most one nearest point is looked for.
const SAMPLES: u32 = 24;
/// Halvings of the bracket of a nearest point: more than a double has digits.
const HALVINGS: u32 = 64;

/// A smooth curve through points: a centripetal Catmull-Rom spline, whose tangent is continuous and which neither loops
/// nor overshoots between its points (Yuksel, Schaefer and Keyser, Computer-Aided Design 43, 2011).
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    pieces: Vec<Cubic>,
}

/// A cubic polynomial in a share from 0 to 1: constant, linear, quadratic and cubic coefficient, m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cubic([Vector2<f64>; 4]);

impl Spline {
    /// The curve through at least three points, m, in their order.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`]; [`ModelError::PathPiece`] when neighbours are less than
    /// [`SHORTEST_PIECE_M`](super::super::SHORTEST_PIECE_M) apart; [`ModelError::TooFew`].
    pub fn through(points_m: &[[f64; 2]]) -> Result<Spline, ModelError> {
        enough(points_m.len(), 3)?;
        let inner: Result<Vec<_>, _> = points_m.iter().map(|point_m| finite(*point_m)).collect();
        let inner = inner?;
        for (from_m, to_m) in inner.iter().zip(inner.iter().skip(1)) {
            long_enough("piece of the spline", length(to_m - from_m))?;
        }
        // Each end is mirrored once, so that every piece has a neighbour on both sides.
        let mut points = inner.clone();
        if let [first, second, ..] = inner.as_slice() {
            points.insert(0, first * 2.0 - second);
        }
        if let [.., before, last] = inner.as_slice() {
            points.push(last * 2.0 - before);
        }
        let pieces = points
            .windows(4)
            .filter_map(|window| <[_; 4]>::try_from(window).ok().map(Cubic::centripetal))
            .collect();
        Ok(Spline { pieces })
    }
}

impl Cubic {
    /// The piece from the second to the third of four points.
    fn centripetal([p_0, p_1, p_2, p_3]: [Vector2<f64>; 4]) -> Cubic {
        let span = |from: Vector2<f64>, to: Vector2<f64>| libm::sqrt(length(to - from));
        let (t_1, t_2, t_3) = (span(p_0, p_1), span(p_1, p_2), span(p_2, p_3));
        let speed = |from: Vector2<f64>, to: Vector2<f64>, time: f64| (to - from) / time;
        let start =
            (speed(p_0, p_1, t_1) - speed(p_0, p_2, t_1 + t_2) + speed(p_1, p_2, t_2)) * t_2;
        let end = (speed(p_1, p_2, t_2) - speed(p_1, p_3, t_2 + t_3) + speed(p_2, p_3, t_3)) * t_2;
        let way = p_2 - p_1;
        Cubic([
            p_1,
            start,
            way * 3.0 - start * 2.0 - end,
            start + end - way * 2.0,
        ])
    }

    fn at(&self, share: f64) -> Vector2<f64> {
        let [c_0, c_1, c_2, c_3] = self.0;
        c_0 + (c_1 + (c_2 + c_3 * share) * share) * share
    }

    fn velocity(&self, share: f64) -> Vector2<f64> {
        let [_, c_1, c_2, c_3] = self.0;
        c_1 + (c_2 * 2.0 + c_3 * (3.0 * share)) * share
    }

    fn tangent(&self, share: f64) -> Vector2<f64> {
        let velocity = self.velocity(share);
        velocity / length(velocity)
    }

    /// How fast the squared distance from a point grows along the piece.
    fn receding(&self, point: Vector2<f64>, share: f64) -> f64 {
        (self.at(share) - point).dot(&self.velocity(share))
    }

    fn beside(&self, point: Vector2<f64>, share: f64) -> Nearest {
        beside(point, self.at(share), self.tangent(share))
    }

    /// The nearest point of this piece, its ends included.
    fn nearest(&self, point: Vector2<f64>) -> Nearest {
        let mut best = nearer(self.beside(point, 0.0), self.beside(point, 1.0));
        for sample in 0..SAMPLES {
            let mut low = f64::from(sample) / f64::from(SAMPLES);
            let mut high = f64::from(sample + 1) / f64::from(SAMPLES);
            if self.receding(point, low) < 0.0 && self.receding(point, high) >= 0.0 {
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    if self.receding(point, middle) < 0.0 {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                best = nearer(best, self.beside(point, high));
            }
        }
        best
    }
}

impl Path for Spline {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let point = Vector2::from(point_m);
        let inner = self.pieces.iter().map(|piece| piece.nearest(point));
        let before = self.pieces.first().and_then(|piece| {
            let (foot_m, tangent) = (piece.at(0.0), piece.tangent(0.0));
            let along_m = (point - foot_m).dot(&tangent);
            (along_m < 0.0).then(|| beside(point, foot_m + tangent * along_m, tangent))
        });
        let after = self.pieces.last().and_then(|piece| {
            let (foot_m, tangent) = (piece.at(1.0), piece.tangent(1.0));
            let along_m = (point - foot_m).dot(&tangent);
            (along_m > 0.0).then(|| beside(point, foot_m + tangent * along_m, tangent))
        });
        let candidates = before.into_iter().chain(inner).chain(after);
        // A spline has at least two pieces; without one there would be no path to be near to.
        candidates.reduce(nearer).unwrap_or(Nearest {
            foot_m: point,
            tangent: Vector2::new(f64::NAN, f64::NAN),
            offset_m: f64::NAN,
        })
    }
}
