//! This file is a law of any kind, for a caller that learns the kind when it runs.

use super::{
    Impedance, Law, Obstacle, Optimal, Proportional, Sdof, Situation, Uncontrolled, VelocityRatio,
};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::Real;
use crate::path::Path;

/// One of the laws for a path; [`Obstacle`] takes one as its inner law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant is the law of its name")]
pub enum PathLaw<R, P> {
    Uncontrolled(Uncontrolled),
    Sdof(Sdof<R, P>),
    Proportional(Proportional<R, P>),
    VelocityRatio(VelocityRatio<R, P>),
    Optimal(Optimal<R, P>),
    Impedance(Impedance<R, P>),
}

impl<R: Real, P: Path<R>> Law<R> for PathLaw<R, P> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        match self {
            PathLaw::Uncontrolled(law) => law.command(now),
            PathLaw::Sdof(law) => law.command(now),
            PathLaw::Proportional(law) => law.command(now),
            PathLaw::VelocityRatio(law) => law.command(now),
            PathLaw::Optimal(law) => law.command(now),
            PathLaw::Impedance(law) => law.command(now),
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        match self {
            PathLaw::Uncontrolled(law) => law.actuation(),
            PathLaw::Sdof(law) => law.actuation(),
            PathLaw::Proportional(law) => law.actuation(),
            PathLaw::VelocityRatio(law) => law.actuation(),
            PathLaw::Optimal(law) => law.actuation(),
            PathLaw::Impedance(law) => law.actuation(),
        }
    }
}

/// Any law: one for a path, or one that keeps the tip out of an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant is the law of its name")]
pub enum AnyLaw<R, P> {
    Path(PathLaw<R, P>),
    Obstacle(Obstacle<P, PathLaw<R, P>>),
}

impl<R: Real, P: Path<R>> Law<R> for AnyLaw<R, P> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        match self {
            AnyLaw::Path(law) => law.command(now),
            AnyLaw::Obstacle(law) => law.command(now),
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        match self {
            AnyLaw::Path(law) => law.actuation(),
            AnyLaw::Obstacle(law) => law.actuation(),
        }
    }
}
