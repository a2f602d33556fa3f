//! This file is the choice of a law and a path at run time.

use rigproof_impl::command::Command;
use rigproof_impl::law::{Law, Proportional, Sdof, Situation, Uncontrolled};
use rigproof_impl::path::{Line, Nearest, Path, Polyline};
use rigproof_impl::vector::Vector;

use crate::settings::RIGPROOF_MOST_CORNERS;

/// A path that C can describe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyPath {
    Line(Line<f64>),
    Polyline(Polyline<f64, RIGPROOF_MOST_CORNERS>),
}

impl AnyPath {
    /// A line through two corners, or a chain through more, m; a closed chain returns to its first corner.
    pub fn through(corners_m: &[[f64; 2]], closed: bool) -> Option<AnyPath> {
        match corners_m {
            [from_m, to_m] if !closed => Some(AnyPath::Line(Line::through(*from_m, *to_m)?)),
            _ if closed => Some(AnyPath::Polyline(Polyline::closed(corners_m)?)),
            _ => Some(AnyPath::Polyline(Polyline::open(corners_m)?)),
        }
    }
}

impl Path<f64> for AnyPath {
    fn nearest(&self, point_m: Vector<f64>) -> Nearest<f64> {
        match self {
            AnyPath::Line(line) => line.nearest(point_m),
            AnyPath::Polyline(chain) => chain.nearest(point_m),
        }
    }
}

/// A law that C can choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyLaw {
    Uncontrolled(Uncontrolled),
    Proportional(Proportional<f64, AnyPath>),
    Sdof(Sdof<f64, AnyPath>),
}

impl Law<f64> for AnyLaw {
    fn command(&mut self, now: &Situation<f64>) -> Command<f64> {
        match self {
            AnyLaw::Uncontrolled(law) => law.command(now),
            AnyLaw::Proportional(law) => law.command(now),
            AnyLaw::Sdof(law) => law.command(now),
        }
    }
}
