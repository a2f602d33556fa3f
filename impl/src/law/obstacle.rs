//! This file says how a path law keeps the tip out of an obstacle: §7.3.

use rigproof_spec::command::Reason;

use super::{Law, Situation};
use crate::actuation::{Actuation, is_defined};
use crate::command::Command;
use crate::number::Real;
use crate::path::Path;

/// On which side of its boundary an obstacle lies, seen along the boundary's tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A path law that acts on one side of the path only (§7.3): "control action would only be taken on the obstacle side of the path".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle<P, L> {
    boundary: P,
    solid: Side,
    inner: L,
}

impl<P, L> Obstacle<P, L> {
    /// `inner` is a law whose path is the same boundary.
    pub const fn new(boundary: P, solid: Side, inner: L) -> Obstacle<P, L> {
        Obstacle {
            boundary,
            solid,
            inner,
        }
    }
}

impl<R: Real, P: Path<R>, L: Law<R>> Law<R> for Obstacle<P, L> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let nearest = self.boundary.nearest(now.linkage.tip_m);
        if !is_defined(now) || !nearest.is_defined() {
            return Command::none(Reason::UndefinedInput);
        }
        let depth_m = match self.solid {
            Side::Left => nearest.offset_m,
            Side::Right => -nearest.offset_m,
        };
        if depth_m > R::zero() {
            self.inner.command(now)
        } else {
            Command::none(Reason::FreeSide)
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        self.inner.actuation()
    }
}
