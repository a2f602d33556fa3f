//! This file says which brake takes an unwanted velocity away, and how strongly: §6.3.

use nalgebra::Vector2;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::laws::influence_rank;
use rigproof_spec::methods::NO_INFLUENCE;

use super::desired_velocity::{Desired, desired_velocity};
use super::force_angle::opposing_force;
use super::path::Path;
use super::{Actuation, Controller, JointRow, Sensed, setting};
use crate::error::ModelError;
use rigproof_spec::settings::{BOUNDARY_RANGE_M, PROPORTIONAL_GAIN_RANGE_N_S_PER_M};

/// Proportional velocity control (§6.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportional<P> {
    actuation: Actuation,
    path: P,
    boundary_m: f64,
    gain_n_s_per_m: f64,
}

impl<P: Path> Proportional<P> {
    /// The controller on a path, with the boundary of the velocity field, m, and the gain K_y of (6.13), N·s/m.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: the boundary is not between 10⁻⁷ m and 0.61 m, or the gain not between 0 and
    /// 10⁶ N·s/m.
    pub fn new(
        actuation: Actuation,
        path: P,
        boundary_m: f64,
        gain_n_s_per_m: f64,
    ) -> Result<Proportional<P>, ModelError> {
        let gains = PROPORTIONAL_GAIN_RANGE_N_S_PER_M;
        Ok(Proportional {
            actuation,
            path,
            boundary_m: setting(
                "the boundary of the velocity field",
                boundary_m,
                BOUNDARY_RANGE_M,
                "m",
            )?,
            gain_n_s_per_m: setting("the proportional gain", gain_n_s_per_m, gains, "N·s/m")?,
        })
    }
}

impl<P: Path> Controller for Proportional<P> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let (rows, nearest) = match self.actuation.situation(&self.path, sensed) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let force_n = Vector2::from(sensed.tip_force_n);
        let velocity_m_s = sensed.decisive_velocity_m_s();
        let desired = desired_velocity(&nearest, force_n, self.boundary_m);
        let [v_beta_x, v_beta_y] = desired.components(velocity_m_s);
        if v_beta_x < 0.0 {
            return self.actuation.lock(Reason::LockedMovingBack);
        }
        match most_useful(&rows, &desired, velocity_m_s) {
            Some((joint, row)) => {
                let force_n = desired_force(self.gain_n_s_per_m, v_beta_y);
                let current_a = self.actuation.current_for_force(joint, row, force_n);
                Actuation::one(joint, current_a)
            }
            None if desired.towards_path(force_n) < 0.0 => {
                self.actuation.lock(Reason::LockedPushedAway)
            }
            None => Command::none(Reason::NoneHelps),
        }
    }
}

/// Magnitude of the force that takes the unwanted velocity away, N (6.13).
///
/// ```text
/// F_i = K_y·|v_βy|
/// ```
//= thesis (6.13)
fn desired_force(gain_n_s_per_m: f64, v_beta_y: f64) -> f64 {
    gain_n_s_per_m * v_beta_y.abs()
}

/// A column of the influence matrix H (6.12): what a force does to the magnitudes of `v_βx` and `v_βy`.
///
/// 1 if it increases the magnitude, −1 if it decreases it or would turn it round, 0 if it has no effect: if less than
/// [`NO_INFLUENCE`] of it points there. A component that is zero has no direction yet: a force along the desired
/// direction increases `v_βx`, one against it decreases it, and any force across it increases `v_βy` (gap
/// `influence-at-rest`).
///
/// ```
/// use nalgebra::Vector2;
/// use rigproof_model::control::{desired_velocity::Desired, influence};
/// // The first column of (6.12): along the desired motion, against the unwanted one.
/// let (x, y) = (Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
/// let desired = Desired { direction: x, along: x, towards: Some(y) };
/// assert_eq!(influence(Vector2::new(0.3, -0.7), &desired, Vector2::new(0.11, 0.07)), [1, -1]);
/// ```
//= thesis (6.12)
pub fn influence(force_n: Vector2<f64>, desired: &Desired, velocity_m_s: Vector2<f64>) -> [i8; 2] {
    let [v_beta_x, v_beta_y] = desired.components(velocity_m_s);
    let magnitude_n = libm::hypot(force_n.x, force_n.y);
    let [along, across] = desired
        .components(force_n)
        .map(|component| component / magnitude_n);
    let sign = |share: f64, speed: f64| {
        if share.abs() < NO_INFLUENCE {
            0
        } else if (share > 0.0) == (speed >= 0.0) {
            1
        } else {
            -1
        }
    };
    let across = if v_beta_y == 0.0 {
        across.abs()
    } else {
        across
    };
    [sign(along, v_beta_x), sign(across, v_beta_y)]
}

/// The brake with the best influence coefficients; among equals the one whose force points closest to the desired
/// velocity, among those the first in the order A, E, B, C.
fn most_useful(
    rows: &[JointRow],
    desired: &Desired,
    velocity_m_s: Vector2<f64>,
) -> Option<JointRow> {
    let mut best: Option<((u8, f64), JointRow)> = None;
    for (joint, row) in rows {
        let Some(force_n) = opposing_force(*row, velocity_m_s) else {
            continue;
        };
        let closeness = force_n.dot(&desired.direction) / libm::hypot(row.x, row.y);
        let Some(rank) = influence_rank(influence(force_n, desired, velocity_m_s)) else {
            continue;
        };
        let better = best.is_none_or(|((best_rank, closest), _)| {
            rank < best_rank || (rank == best_rank && closeness > closest)
        });
        if better {
            best = Some(((rank, closeness), (*joint, *row)));
        }
    }
    best.map(|(_, chosen)| chosen)
}
