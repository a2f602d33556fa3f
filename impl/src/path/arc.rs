//! This file says how a point lies to a circle or a part of one, without angles.

use core::f64::consts::PI;

use rigproof_spec::settings::SHORTEST_PIECE_M;

use super::{Nearest, Path, of, straight_on};
use crate::number::Real;
use crate::vector::Vector;

/// An arc of a circle; a full turn is closed, anything less goes on straight beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc<R> {
    centre_m: Vector<R>,
    radius_m: R,
    /// Directions from the centre to the ends.
    ends: [Vector<R>; 2],
    /// 1 for a counter-clockwise arc, −1 for a clockwise one.
    turn: R,
    extent: Extent,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Extent {
    UpToHalf,
    MoreThanHalf,
    Full,
}

impl<R: Real> Arc<R> {
    /// The arc around `centre_m` from the angle `start_rad` on, through `sweep_rad`: positive counter-clockwise, 2π for a full circle.
    ///
    /// `None` if a number is not finite, radius or arc are shorter than [`SHORTEST_PIECE_M`], or the sweep is more than a full turn.
    pub fn new(
        centre_m: [f64; 2],
        radius_m: f64,
        start_rad: f64,
        sweep_rad: f64,
    ) -> Option<Arc<R>> {
        let finite = Vector::from(centre_m).is_finite()
            && radius_m.is_finite()
            && start_rad.is_finite()
            && sweep_rad.abs() <= 2.0 * PI;
        let long = radius_m >= SHORTEST_PIECE_M && radius_m * sweep_rad.abs() >= SHORTEST_PIECE_M;
        let end = |angle_rad: f64| {
            let (sine, cosine) = libm::sincos(angle_rad);
            of(Vector::new(cosine, sine))
        };
        (finite && long).then(|| Arc {
            centre_m: of(centre_m.into()),
            radius_m: R::of(radius_m),
            ends: [end(start_rad), end(start_rad + sweep_rad)],
            turn: R::of(libm::copysign(1.0, sweep_rad)),
            extent: if sweep_rad.abs() < PI {
                Extent::UpToHalf
            } else if sweep_rad.abs() < 2.0 * PI {
                Extent::MoreThanHalf
            } else {
                Extent::Full
            },
        })
    }

    /// Whether a direction from the centre lies between the ends.
    fn spans(&self, outward: Vector<R>) -> bool {
        let [start, end] = self.ends;
        let after_start = start.cross(outward) * self.turn >= R::zero();
        let before_end = outward.cross(end) * self.turn >= R::zero();
        match self.extent {
            Extent::UpToHalf => after_start && before_end,
            Extent::MoreThanHalf => after_start || before_end,
            Extent::Full => true,
        }
    }
}

impl<R: Real> Path<R> for Arc<R> {
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        let [start, end] = self.ends;
        let from_centre = point_m - self.centre_m;
        let distance_m = from_centre.norm();
        let outward = if distance_m > R::zero() {
            from_centre * (R::of(1.0) / distance_m)
        } else {
            start
        };
        let on_arc = Nearest {
            tangent: outward.left() * self.turn,
            offset_m: (self.radius_m - distance_m) * self.turn,
        };
        if self.extent == Extent::Full {
            return on_arc;
        }
        let at_end = |outward: Vector<R>, forth: f64| {
            let tangent = outward.left() * self.turn;
            straight_on(from_centre - outward * self.radius_m, tangent, R::of(forth))
        };
        let mut best = at_end(start, -1.0);
        if self.spans(outward) {
            best = best.or_nearer(on_arc);
        }
        best.or_nearer(at_end(end, 1.0))
    }
}
