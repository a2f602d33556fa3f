//! This file says what a law has to know of a desired path: how far away it is and how it runs there.

mod any;
mod arc;
mod line;
mod polyline;
mod roots;
mod spline;

pub use any::AnyPath;
pub use arc::Arc;
pub use line::Line;
pub use polyline::Polyline;
pub use spline::Spline;

use rigproof_spec::settings::SHORTEST_PIECE_M;

use crate::number::Real;
use crate::vector::Vector;

/// Anything with a tangent at every point (§6.2). An open path goes on straight beyond its ends (gap `path-ends`).
pub trait Path<R> {
    /// How the nearest point of the path lies to a point, m; of several, the first along the path.
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R>;
}

/// How a point lies to a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<R> {
    /// The path's direction at the nearest point, of length one; at a corner, at a right angle to the way from the path to the point.
    pub tangent: Vector<R>,
    /// Distance from the path, m: positive to the left of the tangent, negative to its right.
    pub offset_m: R,
}

impl<R: Real> Nearest<R> {
    /// The distance from the path ε, m.
    pub fn distance_m(&self) -> R {
        self.offset_m.magnitude()
    }

    /// Whether tangent and distance are finite numbers.
    pub fn is_defined(&self) -> bool {
        self.tangent.is_finite() && self.offset_m.is_finite()
    }

    /// The direction towards the path, of length one; `None` on the path, where there is no side.
    pub fn towards(&self) -> Option<Vector<R>> {
        let left = self.tangent.left();
        if self.offset_m > R::zero() {
            Some(-left)
        } else if self.offset_m < R::zero() {
            Some(left)
        } else {
            None
        }
    }

    /// The nearer of two; the first if they are as near, so that the first along the path wins.
    fn or_nearer(self, second: Nearest<R>) -> Nearest<R> {
        if second.distance_m() < self.distance_m() {
            second
        } else {
            self
        }
    }
}

/// How a point lies to a foot where the path runs along `tangent`, the foot being the nearest point; `away` is the way from foot to point.
fn beside<R: Real>(away_m: Vector<R>, tangent: Vector<R>) -> Nearest<R> {
    let distance_m = away_m.norm();
    let right = tangent.cross(away_m) < R::zero();
    Nearest {
        tangent,
        offset_m: if right { -distance_m } else { distance_m },
    }
}

/// How a point lies to the line along `tangent` from which it is `away`.
fn beside_line<R: Real>(away_m: Vector<R>, tangent: Vector<R>) -> Nearest<R> {
    Nearest {
        tangent,
        offset_m: tangent.cross(away_m),
    }
}

/// How a point lies to an end of an open path from which it is `away`, and to the straight way on from it: forth (1) or back (−1) along the
/// tangent.
fn straight_on<R: Real>(away_m: Vector<R>, tangent: Vector<R>, forth: R) -> Nearest<R> {
    let along_m = away_m.dot(tangent);
    if along_m * forth > R::zero() {
        beside_line(away_m, tangent)
    } else {
        beside(away_m, tangent)
    }
}

/// What lies nowhere: a law that is told this leaves every brake alone.
fn undefined<R: Real>() -> Nearest<R> {
    let nothing = R::of(f64::NAN);
    Nearest {
        tangent: Vector::new(nothing, nothing),
        offset_m: nothing,
    }
}

/// The direction from one point to another and their distance, m; `None` if they are less than [`SHORTEST_PIECE_M`] apart or
/// not finite.
fn piece(from_m: [f64; 2], to_m: [f64; 2]) -> Option<(Vector<f64>, f64)> {
    let way = Vector::from(to_m) - Vector::from(from_m);
    let length_m = libm::hypot(way.x, way.y);
    let long = length_m >= SHORTEST_PIECE_M && length_m.is_finite();
    long.then(|| (way * (1.0 / length_m), length_m))
}

/// A vector of constants as numbers of the rig.
fn of<R: Real>(vector: Vector<f64>) -> Vector<R> {
    Vector::new(R::of(vector.x), R::of(vector.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_places_as_near_the_first_is_kept() {
        let nearest = |x, offset_m| Nearest {
            tangent: Vector::new(x, 0.0),
            offset_m,
        };
        let first = nearest(1.0, 0.37);
        assert_eq!(first.or_nearer(nearest(-1.0, -0.37)), first);
        let nearer = nearest(-1.0, -0.369);
        assert_eq!(first.or_nearer(nearer), nearer);
    }
}
