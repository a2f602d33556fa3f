//! This file says how a path controller keeps the tip out of an obstacle: §7.3.

use rigproof_spec::command::{Command, Reason};

use super::path::{Nearest, Path};
use super::{Controller, Sensed};

/// On which side of its boundary an obstacle lies, seen along the boundary's tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A path controller that acts on one side of the path only (§7.3).
///
/// "Either of the two velocity controllers … could be modified for this application by treating the obstacle boundary as
/// the desired path, yet control action would only be taken on the obstacle side of the path."
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle<P, C> {
    boundary: P,
    solid: Side,
    inner: C,
}

impl<P: Path, C: Controller> Obstacle<P, C> {
    /// `inner` is a controller whose path is the same boundary.
    pub const fn new(boundary: P, solid: Side, inner: C) -> Obstacle<P, C> {
        Obstacle {
            boundary,
            solid,
            inner,
        }
    }

    /// How deep a point is inside the obstacle, m; negative on the free side.
    pub fn depth_m(&self, point_m: [f64; 2]) -> f64 {
        self.depth_of(&self.boundary.nearest(point_m))
    }

    fn depth_of(&self, nearest: &Nearest) -> f64 {
        match self.solid {
            Side::Left => nearest.offset_m,
            Side::Right => -nearest.offset_m,
        }
    }
}

impl<P: Path, C: Controller> Controller for Obstacle<P, C> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let nearest = self.boundary.nearest(sensed.pose.tip_m);
        if !sensed.is_defined() || !nearest.is_defined() {
            return Command::none(Reason::UndefinedInput);
        }
        if self.depth_of(&nearest) > 0.0 {
            self.inner.command(sensed)
        } else {
            Command::none(Reason::FreeSide)
        }
    }
}
