//! This file says how a point lies to a smooth curve through given points.

use nalgebra::Vector2;

use super::line::{finite, long_enough};
use super::polyline::enough;
use super::{Nearest, Path, beside, length, nearer};
use crate::error::ModelError;

/// Halvings of a bracket: more than a double has digits.
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

    /// The coefficients of [`Cubic::receding`] as a polynomial of the share, constant first.
    fn receding_coefficients(&self, point: Vector2<f64>) -> [f64; 6] {
        let [c_0, c_1, c_2, c_3] = self.0;
        let away = c_0 - point;
        [
            away.dot(&c_1),
            2.0 * away.dot(&c_2) + c_1.dot(&c_1),
            3.0 * away.dot(&c_3) + 3.0 * c_1.dot(&c_2),
            4.0 * c_1.dot(&c_3) + 2.0 * c_2.dot(&c_2),
            5.0 * c_2.dot(&c_3),
            3.0 * c_3.dot(&c_3),
        ]
    }

    /// The nearest point of this piece, its ends included.
    fn nearest(&self, point: Vector2<f64>) -> Nearest {
        let mut best = nearer(self.beside(point, 0.0), self.beside(point, 1.0));
        let slopes = derivative(&self.receding_coefficients(point));
        let monotonic = between_ends(&roots(&slopes));
        for (low, high) in monotonic.iter().zip(monotonic.iter().skip(1)) {
            if self.receding(point, *low) < 0.0 && self.receding(point, *high) >= 0.0 {
                let share = bisect(|share| self.receding(point, share), *low, *high);
                best = nearer(best, self.beside(point, share));
            }
        }
        best
    }
}

/// The coefficients of the derivative of a polynomial, constant first.
fn derivative(coefficients: &[f64]) -> Vec<f64> {
    let powers = coefficients.iter().enumerate().skip(1);
    powers
        .map(|(power, coefficient)| power as f64 * coefficient)
        .collect()
}

/// Where a polynomial changes its sign between 0 and 1: it does so at most once between two roots of its derivative.
fn roots(coefficients: &[f64]) -> Vec<f64> {
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let value = |share: f64| {
        coefficients
            .iter()
            .rev()
            .fold(0.0, |sum, c| sum * share + c)
    };
    let monotonic = between_ends(&roots(&derivative(coefficients)));
    let pairs = monotonic.iter().zip(monotonic.iter().skip(1));
    pairs
        .filter(|(low, high)| (value(**low) < 0.0) != (value(**high) < 0.0))
        .map(|(low, high)| {
            let rising = value(*low) < 0.0;
            bisect(
                |share| if rising { value(share) } else { -value(share) },
                *low,
                *high,
            )
        })
        .collect()
}

/// Shares in order, with 0 before and 1 after them.
fn between_ends(inner: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0];
    all.extend(inner);
    all.push(1.0);
    all
}

/// Where a function that is negative at `low` and not at `high` ceases to be negative.
fn bisect(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
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
