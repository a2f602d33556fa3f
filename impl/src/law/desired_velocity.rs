//! This file says in which direction the tip should move: the velocity field of §6.1.1.

use core::f64::consts::FRAC_PI_2;

use rigproof_spec::settings::BOUNDARY_RANGE_M;

use crate::number::Real;
use crate::path::Nearest;
use crate::select::Desired;
use crate::setting::setting;
use crate::vector::Vector;

/// The velocity field around a path: towards it outside a boundary, and from there turning evenly into its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field<R> {
    boundary_m: R,
    turn_rad_per_m: R,
}

impl<R: Real> Field<R> {
    /// The field with a boundary, m, inside [`BOUNDARY_RANGE_M`].
    pub fn new(boundary_m: f64) -> Option<Field<R>> {
        Some(Field {
            boundary_m: setting(boundary_m, BOUNDARY_RANGE_M)?,
            turn_rad_per_m: R::of(FRAC_PI_2 / boundary_m),
        })
    }

    /// The desired velocity where a point lies so to a path (§6.1.1).
    ///
    /// The angle between path and desired velocity is 90° times the distance over the boundary. A force without a component along the
    /// path counts as one along its tangent (gap `force-across-path`).
    pub fn desired(&self, nearest: &Nearest<R>, force_n: Vector<R>) -> Desired<R> {
        let along = if nearest.tangent.dot(force_n) < R::zero() {
            -nearest.tangent
        } else {
            nearest.tangent
        };
        let towards = nearest.towards();
        let direction = match towards {
            None => along,
            Some(towards) if nearest.distance_m() >= self.boundary_m => towards,
            Some(towards) => {
                let turn_rad = self.turn_rad_per_m * nearest.distance_m();
                let (sine, cosine) = turn_rad.sine_cosine();
                along * cosine + towards * sine
            }
        };
        Desired {
            direction,
            along,
            towards,
        }
    }
}
