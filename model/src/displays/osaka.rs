//! This file is the display of Osaka University: a five-bar linkage with two ER fluid brakes on its base links (§2.2.1).
#![expect(clippy::indexing_slicing, reason = "indices run over the two brakes")]

use nalgebra::{SMatrix, Vector2};
use rigproof_spec::displays::{BODY, OSAKA_BRAKE, OSAKA_CHANGE_M, OSAKA_TRACK_M};

use super::choice::{contact, path_of};
use super::pter::tip_rows;
use super::{Aim, Body, Clutch, Device, Display, Now, Place, Plant, Rows};
use crate::control::path::Path;
use crate::error::ModelError;
use crate::motion::friction::DryBrakes;

/// Two ER brakes, belted to links A and B, and what the text says of their control.
///
/// A wall: "the device simply locks both actuators when the tip reaches the appropriate position"; they let go when the hand pushes
/// away (gap `osaka-release`). A path: "the robot alternately actuates each brake when the tip enters a predefined track".
//= thesis section 2.2.1
#[derive(Clone, Debug, PartialEq)]
pub struct Osaka {
    brakes: [Clutch; 2],
    /// The brake that leads the tip along its track.
    leading: Option<usize>,
}

impl Osaka {
    /// The brakes of decision 0240.
    pub fn new() -> Osaka {
        Osaka {
            brakes: core::array::from_fn(|_| Clutch::new(OSAKA_BRAKE)),
            leading: None,
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

    /// Which brake leads the tip back to the middle of its track: the one whose local path, in the sense of the hand's force,
    /// heads there. It stays until the tip is beyond the middle.
    fn lead(&mut self, path: &dyn Path, now: &Now<'_>) -> Option<usize> {
        let nearest = path.nearest(now.place.tip_m);
        if nearest.distance_m() > OSAKA_TRACK_M {
            return None;
        }
        let force_n = Vector2::from(now.tip_force_n);
        let sense = libm::copysign(1.0, nearest.tangent.dot(&force_n));
        let left = Vector2::new(-nearest.tangent.y, nearest.tangent.x);
        let [row_a, row_b, ..] = tip_rows(now.place);
        // How far each local path leads to the left while it leads ahead.
        let leads = [row_a, row_b].map(|row| {
            let ahead = path_of(row, nearest.tangent * sense)?;
            Some(ahead.dot(&left))
        });
        let to = |wanted: f64| (0..2).find(|&i| leads[i].is_some_and(|left| left * wanted > 0.0));
        if nearest.offset_m > OSAKA_CHANGE_M {
            self.leading = to(-1.0);
        } else if nearest.offset_m < -OSAKA_CHANGE_M {
            self.leading = to(1.0);
        }
        self.leading
    }
}

impl Default for Osaka {
    fn default() -> Osaka {
        Osaka::new()
    }
}

impl Device for Osaka {
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>) {
        let on = match aim {
            Aim::Free | Aim::Point(_) => [false; 2],
            Aim::Wall(boundary, solid) => {
                let contact = contact(boundary, *solid, now.place.tip_m);
                [contact.pressed(now).is_some(); 2]
            }
            Aim::Path(path) => {
                let leading = self.lead(*path, now);
                [leading == Some(0), leading == Some(1)]
            }
        };
        for (brake, on) in self.brakes.iter_mut().zip(on) {
            brake.command(if on { brake.strength_nm() } else { 0.0 });
        }
    }

    fn rows(&mut self, _: &Place, rates: [f64; 2], step_s: f64) -> Rows {
        let [bound_a, bound_b] = [0, 1].map(|i| {
            self.brakes[i].pass(step_s);
            self.brakes[i].bound_nm(rates[i])
        });
        Rows::Dry(DryBrakes {
            rows: SMatrix::<f64, 4, 2>::new(1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0),
            bounds_nm: [bound_a, bound_b, 0.0, 0.0],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_er_brake_is_there_in_milliseconds_and_slips_as_it_holds() {
        let mut brake = Clutch::new(OSAKA_BRAKE);
        brake.command(41.0);
        for _ in 0..200 {
            brake.pass(1e-4);
        }
        assert!(brake.is_locked() && brake.bound_nm(0.0) <= OSAKA_BRAKE.static_nm);
        assert_eq!(brake.bound_nm(0.0), brake.bound_nm(0.47));
    }
}
