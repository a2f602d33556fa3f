//! This file says how SDOF control asks for its brake: §6.2.

use super::{Field, Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::Real;
use crate::path::Path;
use crate::select::sdof::decide;
use crate::setting::setting;

/// SDOF velocity control (§6.2), with or without a gap (§6.5.1): the brake that leads the tip gets the greatest desired force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sdof<R, P> {
    actuation: Actuation<R>,
    path: P,
    field: Field<R>,
    gap_m: R,
}

impl<R: Real, P: Path<R>> Sdof<R, P> {
    /// The law on a path, with the boundary of the velocity field ([`rigproof_spec::settings::BOUNDARY_RANGE_M`]) and the gap around the path,
    /// m: 0, for none, up to the boundary.
    pub fn new(
        actuation: Actuation<R>,
        path: P,
        boundary_m: f64,
        gap_m: f64,
    ) -> Option<Sdof<R, P>> {
        Some(Sdof {
            actuation,
            path,
            field: Field::new(boundary_m)?,
            gap_m: setting(gap_m, [0.0, boundary_m])?,
        })
    }
}

impl<R: Real, P: Path<R>> Law<R> for Sdof<R, P> {
    #[inline]
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let (rows, nearest) = match self.actuation.situation(&self.path, now) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let desired = self.field.desired(&nearest, now.tip_force_n);
        let in_gap = nearest.distance_m() <= self.gap_m;
        let decision = decide(&rows, now.tip_force_n, &desired, in_gap);
        let force_n = self.actuation.greatest_force_n();
        self.actuation.carry_out(decision, &rows, force_n)
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        Some(&self.actuation)
    }
}
