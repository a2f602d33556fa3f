//! This file says which brake leads the tip along its own local path towards the desired velocity: §6.2.

use nalgebra::Vector2;
use rigproof_spec::command::{Command, Reason};

use super::desired_velocity::{Desired, desired_velocity};
use super::path::Path;
use super::{Actuation, Controller, JointRow, Sensed, setting};
use crate::error::ModelError;
use rigproof_spec::settings::BOUNDARY_RANGE_M;

/// SDOF velocity control (§6.2), with or without a gap (§6.5.1).
///
/// The brake whose local path of a single degree of freedom points closest to the desired velocity gets the greatest
/// desired force, provided that direction lies between the direction of the path and the direction towards it. If none
/// does and the operator pushes away from the path, every brake holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sdof<P> {
    actuation: Actuation,
    path: P,
    boundary_m: f64,
    gap_m: f64,
}

impl<P: Path> Sdof<P> {
    /// The controller on a path, with the boundary of the velocity field and the gap around the path, m; 0 for no gap.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: the boundary is not between 10⁻⁷ m and 0.61 m, or the gap not between 0 and the
    /// boundary.
    pub fn new(
        actuation: Actuation,
        path: P,
        boundary_m: f64,
        gap_m: f64,
    ) -> Result<Sdof<P>, ModelError> {
        let boundary_m = setting(
            "the boundary of the velocity field",
            boundary_m,
            BOUNDARY_RANGE_M,
            "m",
        )?;
        let gap_m = setting("the gap around the path", gap_m, [0.0, boundary_m], "m")?;
        Ok(Sdof {
            actuation,
            path,
            boundary_m,
            gap_m,
        })
    }
}

impl<P: Path> Controller for Sdof<P> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let (rows, nearest) = match self.actuation.situation(&self.path, sensed) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let force_n = Vector2::from(sensed.tip_force_n);
        let desired = desired_velocity(&nearest, force_n, self.boundary_m);
        let Some(towards) = desired
            .towards
            .filter(|_| nearest.distance_m() > self.gap_m)
        else {
            return Command::none(Reason::InsideGap);
        };
        match closest(&rows, &desired, towards) {
            Some((joint, row)) => {
                let force_n = self.actuation.greatest_force_n();
                let current_a = self.actuation.current_for_force(joint, row, force_n);
                Actuation::one(joint, current_a)
            }
            None if towards.dot(&force_n) < 0.0 => self.actuation.lock(Reason::LockedPushedAway),
            None => Command::none(Reason::NoneHelps),
        }
    }
}

/// The brake with the valid local path closest to the desired direction; of several, the first in the order A, E, B, C.
fn closest(rows: &[JointRow], desired: &Desired, towards: Vector2<f64>) -> Option<JointRow> {
    let mut best: Option<(f64, JointRow)> = None;
    for (joint, row) in rows {
        let across = Vector2::new(-row.y, row.x) / libm::hypot(row.x, row.y);
        for local_path in [across, -across] {
            let closeness = local_path.dot(&desired.direction);
            let valid = local_path.dot(&desired.along) >= 0.0 && local_path.dot(&towards) >= 0.0;
            if valid && best.is_none_or(|(highest, _)| closeness > highest) {
                best = Some((closeness, (*joint, *row)));
            }
        }
    }
    best.map(|(_, chosen)| chosen)
}
