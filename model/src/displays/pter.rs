//! This file is PTER: a five-bar linkage with four friction clutches on its central axis (chapter 1, §2.2.2).
#![expect(
    clippy::indexing_slicing,
    reason = "indices run over the four clutches"
)]

use nalgebra::{SMatrix, Vector2};
use rigproof_spec::displays::{BODY, ClutchFigures, PTER_CLUTCH, PTER_GAIN_NM_S_PER_RAD};
use rigproof_spec::methods::BLEND_BOUNDARY_M;

use super::choice::{Contact, contact, guiding};
use super::{Aim, Body, Clutch, Device, Display, Now, Place, Plant, Rows};
use crate::control::desired_velocity::desired_velocity;
use crate::control::excess_speeds;
use crate::control::path::Path;
use crate::error::ModelError;
use crate::motion::friction::DryBrakes;

/// What the clutches 1 to 4 brake, by the rates of links A and B: link A, link B, their difference (direct coupling: both
/// turn alike) and their sum (reverse coupling: they turn oppositely).
pub const CLUTCHES: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [1.0, -1.0], [1.0, 1.0]];

/// The clutches of PTER and their control.
///
/// Free motion: no clutch. A wall (Swanson and Book): the clutch whose local path leads along it, or clutches 1 and 2
/// where none leads no deeper; they let go when the hand pushes away. A path: Swanson's velocity ratio control, coupling clutches
/// first (§2.2.2; decision 0241).
//= thesis section 1.1
//= thesis section 2.2.2
#[derive(Clone, Debug, PartialEq)]
pub struct Pter {
    clutches: [Clutch; 4],
    locked: Option<usize>,
}

impl Pter {
    /// The clutches of decision 0240.
    pub fn new() -> Pter {
        Pter::with_clutches(PTER_CLUTCH)
    }

    /// Other clutches, for studies of what their figures change.
    pub fn with_clutches(figures: ClutchFigures) -> Pter {
        Pter {
            clutches: core::array::from_fn(|_| Clutch::new(figures)),
            locked: None,
        }
    }

    /// The same clutches with one of them, 0 to 3, locked whatever the aim.
    #[must_use]
    pub fn with_locked(self, clutch: usize) -> Pter {
        Pter {
            locked: Some(clutch),
            ..self
        }
    }

    /// The display, at rest with its tip at a point, m.
    ///
    /// # Errors
    /// Those of [`Plant::new`].
    pub fn at(self, tip_m: [f64; 2]) -> Result<Display, ModelError> {
        Ok(Display::new(
            Plant::new(Body::layout(BODY), tip_m, [0.0; 2])?,
            self,
        ))
    }

    fn ask(&mut self, torques_nm: [f64; 4]) {
        for (clutch, torque_nm) in self.clutches.iter_mut().zip(torques_nm) {
            clutch.command(torque_nm);
        }
    }

    fn strength_nm(&self) -> f64 {
        self.clutches[0].strength_nm()
    }

    fn at_wall(&self, contact: &Contact, now: &Now<'_>) -> [f64; 4] {
        let mut torques_nm = [0.0; 4];
        let Some(push) = contact.pressed(now) else {
            return torques_nm;
        };
        match guiding(&tip_rows(now.place), contact, push) {
            Some(clutch) => torques_nm[clutch] = self.strength_nm(),
            None => torques_nm = [self.strength_nm(), self.strength_nm(), 0.0, 0.0],
        }
        torques_nm
    }
}

impl Default for Pter {
    fn default() -> Pter {
        Pter::new()
    }
}

impl Device for Pter {
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>) {
        let mut torques_nm = match aim {
            Aim::Free | Aim::Point(_) => [0.0; 4],
            Aim::Wall(boundary, solid) => {
                self.at_wall(&contact(boundary, *solid, now.place.tip_m), now)
            }
            Aim::Path(path) => along_path(*path, now),
        };
        if let Some(clutch) = self.locked {
            torques_nm = [0.0; 4];
            torques_nm[clutch] = self.strength_nm();
        }
        self.ask(torques_nm);
    }

    fn rows(&mut self, _: &Place, [rate_a, rate_b]: [f64; 2], step_s: f64) -> Rows {
        let bounds_nm = [0, 1, 2, 3].map(|i| {
            let [a, b] = CLUTCHES[i];
            self.clutches[i].pass(step_s);
            self.clutches[i].bound_nm(a * rate_a + b * rate_b)
        });
        Rows::Dry(DryBrakes {
            rows: SMatrix::from_fn(|i, j| CLUTCHES[i][j]),
            bounds_nm,
        })
    }
}

/// The tip force of each clutch at 1 N·m, 1/m.
pub fn tip_rows(place: &Place) -> [Vector2<f64>; 4] {
    let links = place.tip.try_inverse().unwrap_or_default().transpose();
    CLUTCHES.map(|row| links * Vector2::from(row))
}

/// Velocity ratio control: the torques of the clutches, N·m.
fn along_path(path: &dyn Path, now: &Now<'_>) -> [f64; 4] {
    let nearest = path.nearest(now.place.tip_m);
    let desired = desired_velocity(&nearest, Vector2::from(now.tip_force_n), BLEND_BOUNDARY_M);
    let links = now.place.tip.try_inverse().unwrap_or_default();
    let wanted = links * desired.direction;
    let excess = excess_speeds(now.rates, wanted.into());
    let mut torques_nm = [0.0; 4];
    let torque_nm = |excess_rad_s: f64| PTER_GAIN_NM_S_PER_RAD * excess_rad_s;
    match coupling(now.rates, excess) {
        Some(clutch) => torques_nm[clutch] = torque_nm(excess[0].max(excess[1])),
        None => (torques_nm[0], torques_nm[1]) = (torque_nm(excess[0]), torque_nm(excess[1])),
    }
    torques_nm
}

/// The coupling clutch, 2 or 3, that slows the one link that is too fast and speeds up the other.
fn coupling([rate_a, rate_b]: [f64; 2], [excess_a, excess_b]: [f64; 2]) -> Option<usize> {
    let needed = match (excess_a > 0.0, excess_b > 0.0) {
        (true, false) => [-rate_a, rate_b],
        (false, true) => [rate_a, -rate_b],
        _ => return None,
    };
    [2, 3].into_iter().find(|&clutch: &usize| {
        let [a, b] = CLUTCHES[clutch];
        let slip = a * rate_a + b * rate_b;
        let taken = [-a * slip, -b * slip];
        taken[0] * needed[0] > 0.0 && taken[1] * needed[1] > 0.0
    })
}
