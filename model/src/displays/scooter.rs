//! This file is Scooter: a cobot on three castors that are steered together, so that it can move one way only (§2.2.1).

use nalgebra::{SMatrix, Vector2};
use rigproof_spec::displays::{
    SCOOTER_AHEAD_S, SCOOTER_FELT_N, SCOOTER_GREATEST_RAD_S, SCOOTER_GRIP_N, SCOOTER_MASS_KG,
    SCOOTER_STEERING_S,
};
use rigproof_spec::methods::BLEND_BOUNDARY_M;

use super::choice::contact;
use super::{Aim, Body, Device, Display, Now, Place, Plant, Rows};
use crate::control::desired_velocity::desired_velocity;
use crate::error::ModelError;
use crate::motion::friction::DryBrakes;

/// Three castors that point the same way.
///
/// Castors whose axles are parallel let a plate roll along their heading without turning (`one_degree`, `rolls`). With the handle amid
/// them and a hand that applies no moment each bears a third of the sideways force, so that the plate stays unturned: three parallel rows of
/// the friction problem in x and y, each with what a castor withstands sideways (decision 0244).
///
/// Free motion: they steer to the direction of the hand's force. A wall: along it as soon as the plate would be in it. A path: along
/// the velocity field of §6.1.1.
//= thesis section 2.2.1
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scooter {
    heading_rad: f64,
    wanted_rad: f64,
    ahead_s: f64,
}

impl Scooter {
    /// Castors that point in a direction, rad from x.
    pub const fn new(heading_rad: f64) -> Scooter {
        Scooter {
            heading_rad,
            wanted_rad: heading_rad,
            ahead_s: SCOOTER_AHEAD_S,
        }
    }

    /// The same castors with another time, s, by which they look ahead for a wall; at zero they turn once they are in it, as brakes do.
    #[must_use]
    pub const fn with_ahead_s(self, ahead_s: f64) -> Scooter {
        Scooter { ahead_s, ..self }
    }

    /// The display, at rest with its handle at a point, m.
    ///
    /// # Errors
    /// Those of [`Plant::new`].
    pub fn at(self, tip_m: [f64; 2]) -> Result<Display, ModelError> {
        let body = Body::Plate {
            mass_kg: SCOOTER_MASS_KG,
        };
        Ok(Display::new(Plant::new(body, tip_m, [0.0; 2])?, self))
    }

    /// Where the castors point, of length one.
    pub fn heading(&self) -> [f64; 2] {
        let (sine, cosine) = libm::sincos(self.heading_rad);
        [cosine, sine]
    }

    fn steer(&mut self, direction: Vector2<f64>) {
        if direction != Vector2::zeros() {
            self.wanted_rad = libm::atan2(direction.y, direction.x);
        }
    }
}

impl Device for Scooter {
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>) {
        let force_n = Vector2::from(now.tip_force_n);
        let felt = libm::hypot(force_n.x, force_n.y) >= SCOOTER_FELT_N;
        match aim {
            Aim::Path(path) => {
                let nearest = path.nearest(now.place.tip_m);
                self.steer(desired_velocity(&nearest, force_n, BLEND_BOUNDARY_M).direction);
            }
            Aim::Wall(boundary, solid) => {
                let contact = contact(boundary, *solid, now.place.tip_m);
                let inward_m_s = contact.inward.dot(&Vector2::from(now.tip_velocity_m_s));
                let ahead_m = contact.depth_m + inward_m_s.max(0.0) * self.ahead_s;
                let pressed = contact.inward.dot(&force_n) > 0.0 || inward_m_s > 0.0;
                if ahead_m > 0.0 && pressed {
                    self.steer(contact.along);
                } else if felt {
                    self.steer(force_n);
                }
            }
            Aim::Free | Aim::Point(_) if felt => self.steer(force_n),
            Aim::Free | Aim::Point(_) => {}
        }
    }

    fn rows(&mut self, _: &Place, _: [f64; 2], step_s: f64) -> Rows {
        // A castor rolls both ways: the nearer of the two headings.
        let off_rad = libm::remainder(self.wanted_rad - self.heading_rad, core::f64::consts::PI);
        let rate_rad_s =
            (off_rad / SCOOTER_STEERING_S).clamp(-SCOOTER_GREATEST_RAD_S, SCOOTER_GREATEST_RAD_S);
        self.heading_rad += rate_rad_s * step_s;
        let [along_x, along_y] = self.heading();
        let across = [-along_y, along_x];
        let castor = |row: usize, column: usize| match (row, column) {
            (3, _) => 0.0,
            (_, 0) => across[0],
            (_, _) => across[1],
        };
        Rows::Dry(DryBrakes {
            rows: SMatrix::from_fn(castor),
            bounds_nm: [SCOOTER_GRIP_N, SCOOTER_GRIP_N, SCOOTER_GRIP_N, 0.0],
        })
    }
}
