//! This file says how a point lies to a circle or a part of one.

use core::f64::consts::PI;

use nalgebra::Vector2;

use super::line::{finite, long_enough};
use super::{Nearest, Path, beside, left_of, length, nearer};
use crate::error::ModelError;

/// An arc of a circle; a full turn is closed, anything less goes on straight beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    centre_m: Vector2<f64>,
    radius_m: f64,
    start_rad: f64,
    sweep_rad: f64,
}

impl Arc {
    /// The arc around `centre_m` from the angle `start_rad` on, through `sweep_rad`: positive counter-clockwise, 2π for
    /// a full circle.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`]; [`ModelError::PathPiece`] when radius or arc length is less than
    /// [`SHORTEST_PIECE_M`](super::super::SHORTEST_PIECE_M); [`ModelError::SettingRange`] for more than a full turn.
    pub fn new(
        centre_m: [f64; 2],
        radius_m: f64,
        start_rad: f64,
        sweep_rad: f64,
    ) -> Result<Arc, ModelError> {
        let centre_m = finite(centre_m)?;
        for value in [start_rad, sweep_rad] {
            if !value.is_finite() {
                let (quantity, unit) = ("an angle of the arc", "rad");
                return Err(ModelError::NotFinite {
                    quantity,
                    value,
                    unit,
                });
            }
        }
        finite([radius_m, radius_m])?;
        if sweep_rad.abs() > 2.0 * PI {
            return Err(ModelError::SettingRange {
                setting: "the sweep of the arc",
                value: sweep_rad,
                least: -2.0 * PI,
                greatest: 2.0 * PI,
                unit: "rad",
            });
        }
        long_enough("arc", long_enough("radius", radius_m)? * sweep_rad.abs())?;
        Ok(Arc {
            centre_m,
            radius_m,
            start_rad,
            sweep_rad,
        })
    }

    /// The point at a share of the sweep and the direction of travel there.
    fn at(&self, share: f64) -> (Vector2<f64>, Vector2<f64>) {
        let (sine, cosine) = libm::sincos(self.start_rad + share * self.sweep_rad);
        let outward = Vector2::new(cosine, sine);
        let tangent = left_of(outward) * libm::copysign(1.0, self.sweep_rad);
        (self.centre_m + outward * self.radius_m, tangent)
    }

    /// How far along the sweep the angle of a direction lies, as a share; beyond one if outside the arc.
    fn share(&self, outward: Vector2<f64>) -> f64 {
        let turn_rad = libm::atan2(outward.y, outward.x) - self.start_rad;
        let ahead_rad = turn_rad * libm::copysign(1.0, self.sweep_rad);
        let turns = libm::floor(ahead_rad / (2.0 * PI));
        (ahead_rad - turns * 2.0 * PI) / self.sweep_rad.abs()
    }
}

impl Path for Arc {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let point = Vector2::from(point_m);
        let from_centre = point - self.centre_m;
        let distance_m = length(from_centre);
        let (first_m, first_tangent) = self.at(0.0);
        let (last_m, last_tangent) = self.at(1.0);
        let mut best = beside(point, first_m, first_tangent);
        if distance_m > 0.0 {
            let outward = from_centre / distance_m;
            if self.share(outward) <= 1.0 {
                let tangent = left_of(outward) * libm::copysign(1.0, self.sweep_rad);
                let foot_m = self.centre_m + outward * self.radius_m;
                best = nearer(best, beside(point, foot_m, tangent));
            }
        }
        if self.sweep_rad.abs() < 2.0 * PI {
            let before_m = (point - first_m).dot(&first_tangent).min(0.0);
            let after_m = (point - last_m).dot(&last_tangent).max(0.0);
            if before_m < 0.0 {
                let foot_m = first_m + first_tangent * before_m;
                best = nearer(best, beside(point, foot_m, first_tangent));
            }
            let foot_m = last_m + last_tangent * after_m;
            best = nearer(best, beside(point, foot_m, last_tangent));
        }
        best
    }
}
