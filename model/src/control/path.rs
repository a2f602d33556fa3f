//! This file says what a controller has to know of a desired path: the nearest point and the tangent there.

mod arc;
mod line;
mod polyline;
mod spline;

pub use arc::Arc;
pub use line::Line;
pub use polyline::Polyline;
pub use spline::Spline;

use nalgebra::Vector2;

/// Anything with a tangent at every point (§6.2: "as long as the angle of the line of tangency is known at each point").
///
/// An open path goes on straight beyond its ends (gap `path-ends`).
pub trait Path: core::fmt::Debug {
    /// The point of the path that is nearest to `point_m`, x and y in m; of several, the first along the path.
    fn nearest(&self, point_m: [f64; 2]) -> Nearest;
}

impl<T: Path + ?Sized> Path for &T {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        (**self).nearest(point_m)
    }
}

impl<T: Path + ?Sized> Path for Box<T> {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        (**self).nearest(point_m)
    }
}

/// How a point lies to a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The nearest point of the path, m.
    pub foot_m: Vector2<f64>,
    /// The path's direction there, of length one; at a corner, at a right angle to the way from the path to the point.
    pub tangent: Vector2<f64>,
    /// Distance from the path, m: positive to the left of the tangent, negative to its right.
    pub offset_m: f64,
}

impl Nearest {
    /// The distance from the path ε, m.
    pub fn distance_m(&self) -> f64 {
        self.offset_m.abs()
    }

    /// Whether foot, tangent and distance are finite numbers.
    pub fn is_defined(&self) -> bool {
        let numbers = [self.foot_m.x, self.foot_m.y, self.tangent.x, self.tangent.y];
        self.offset_m.is_finite() && numbers.iter().all(|number| number.is_finite())
    }

    /// The direction towards the path, of length one; `None` on the path, where there is no side.
    pub fn towards(&self) -> Option<Vector2<f64>> {
        let left = left_of(self.tangent);
        if self.offset_m > 0.0 {
            Some(-left)
        } else if self.offset_m < 0.0 {
            Some(left)
        } else {
            None
        }
    }
}

/// A vector turned by 90° to the left.
fn left_of(vector: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}

/// How a point lies to a foot where the path runs along `tangent`, the foot being the nearest point.
fn beside(point: Vector2<f64>, foot_m: Vector2<f64>, tangent: Vector2<f64>) -> Nearest {
    let away = point - foot_m;
    Nearest {
        foot_m,
        tangent,
        offset_m: libm::copysign(length(away), tangent.perp(&away)),
    }
}

/// How a point lies to a corner: on its outer side, where every direction between the two legs is nearest to the corner.
fn around(
    point: Vector2<f64>,
    corner_m: Vector2<f64>,
    before: Vector2<f64>,
    after: Vector2<f64>,
) -> Nearest {
    let away = point - corner_m;
    let distance_m = length(away);
    if distance_m > 0.0 {
        let left = (before + after).perp(&away) >= 0.0;
        let outward = away / distance_m;
        Nearest {
            foot_m: corner_m,
            tangent: if left {
                -left_of(outward)
            } else {
                left_of(outward)
            },
            offset_m: if left { distance_m } else { -distance_m },
        }
    } else {
        Nearest {
            foot_m: corner_m,
            tangent: after,
            offset_m: 0.0,
        }
    }
}

/// Length of a vector, in the elementary functions of every platform.
fn length(vector: Vector2<f64>) -> f64 {
    libm::hypot(vector.x, vector.y)
}

/// The nearer of two; the first if they are as near, so that the first along the path wins.
fn nearer(first: Nearest, second: Nearest) -> Nearest {
    if second.distance_m() < first.distance_m() {
        second
    } else {
        first
    }
}
