//! This file says how strongly proportional control takes an unwanted velocity away: §6.3.

use rigproof_spec::settings::PROPORTIONAL_GAIN_RANGE_N_S_PER_M;

use super::{Field, Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::Real;
use crate::path::Path;
use crate::select::proportional::decide;
use crate::setting::setting;

/// Proportional velocity control (§6.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportional<R, P> {
    actuation: Actuation<R>,
    path: P,
    field: Field<R>,
    gain_n_s_per_m: R,
}

impl<R: Real, P: Path<R>> Proportional<R, P> {
    /// The law on a path, with the boundary of the velocity field, m ([`rigproof_spec::settings::BOUNDARY_RANGE_M`]), and the gain `K_y` of
    /// (6.13), N·s/m, inside [`PROPORTIONAL_GAIN_RANGE_N_S_PER_M`].
    pub fn new(
        actuation: Actuation<R>,
        path: P,
        boundary_m: f64,
        gain_n_s_per_m: f64,
    ) -> Option<Proportional<R, P>> {
        Some(Proportional {
            actuation,
            path,
            field: Field::new(boundary_m)?,
            gain_n_s_per_m: setting(gain_n_s_per_m, PROPORTIONAL_GAIN_RANGE_N_S_PER_M)?,
        })
    }
}

impl<R: Real, P: Path<R>> Law<R> for Proportional<R, P> {
    //= thesis (6.13)
    #[inline]
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let (rows, nearest) = match self.actuation.situation(&self.path, now) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let desired = self.field.desired(&nearest, now.tip_force_n);
        let velocity_m_s = now.decisive_velocity_m_s();
        let decision = decide(&rows, velocity_m_s, now.tip_force_n, &desired);
        let unwanted_m_s = desired.direction.cross(velocity_m_s).magnitude();
        let force_n = self.gain_n_s_per_m * unwanted_m_s;
        self.actuation.carry_out(decision, &rows, force_n)
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        Some(&self.actuation)
    }
}
