//! This file is a path of any kind, for a caller that learns the kind when it runs.

use super::{Arc, Line, Nearest, Path, Polyline, Spline};
use crate::number::Real;
use crate::vector::Vector;

/// One of the four kinds of path; at most `N` pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyPath<R, const N: usize> {
    /// A straight line.
    Line(Line<R>),
    /// An arc or a circle.
    Arc(Arc<R>),
    /// A chain of straight pieces.
    Polyline(Polyline<R, N>),
    /// A smooth curve.
    Spline(Spline<R, N>),
}

impl<R: Real, const N: usize> Path<R> for AnyPath<R, N> {
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        match self {
            AnyPath::Line(path) => path.nearest(point_m),
            AnyPath::Arc(path) => path.nearest(point_m),
            AnyPath::Polyline(path) => path.nearest(point_m),
            AnyPath::Spline(path) => path.nearest(point_m),
        }
    }
}
