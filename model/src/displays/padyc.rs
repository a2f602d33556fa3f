//! This file is PADyC: an arm whose joints turn between two speeds, set by overrunning clutches (§2.2.1).
#![expect(clippy::indexing_slicing, reason = "indices run over the two joints")]

use nalgebra::{Matrix2, Vector2};
use rigproof_spec::displays::{BODY, PADYC_GREATEST_RAD_S, PADYC_HORIZON_S, PADYC_SPEED_M_S};
use rigproof_spec::geometry::arms;

use super::choice::{Contact, contact};
use super::{Aim, Body, Device, Display, Now, Place, Plant, Rows};
use crate::control::path::Path;
use crate::error::ModelError;
use crate::linkage::inverse;
use crate::motion::limited::LimitedRates;

/// The clutches of joints A and E, the two of a serial arm, in one of four modes.
///
/// | mode | aim | limits |
/// |---|---|---|
/// | free | [`Aim::Free`] | the motors' greatest speeds |
/// | position | [`Aim::Point`] | each joint towards its own angle at the point, not past it |
/// | trajectory | [`Aim::Path`] | each joint towards a point of the path a little ahead, in the sense of the hand's force |
/// | region | [`Aim::Wall`] | together they cannot reach the boundary within the horizon |
///
/// The text names the modes and gives no rule: gap `padyc-modes`, decision 0243. Every rule leaves rest between the limits, so
/// that no motor drives its joint.
//= thesis section 2.2.1
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Padyc {
    limits_rad_s: [[f64; 2]; 2],
}

/// The two joints' rates by the two coordinates'.
pub fn joints(place: &Place) -> Matrix2<f64> {
    Matrix2::from_rows(&[place.joints.row(0), place.joints.row(1)])
}

impl Padyc {
    /// Clutches that run as fast as they can.
    pub const fn new() -> Padyc {
        Padyc {
            limits_rad_s: [[-PADYC_GREATEST_RAD_S, PADYC_GREATEST_RAD_S]; 2],
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

    /// The least and the greatest speed of each joint, rad/s, that a mode sets.
    pub fn limits_rad_s(aim: &Aim<'_>, now: &Now<'_>) -> [[f64; 2]; 2] {
        let limits = match aim {
            Aim::Free => Padyc::new().limits_rad_s,
            Aim::Point(point_m) => towards(now, *point_m),
            Aim::Path(path) => towards(now, ahead(*path, now)),
            Aim::Wall(boundary, solid) => inside(now, &contact(boundary, *solid, now.place.tip_m)),
        };
        limits.map(|[least, greatest]| {
            [
                least.max(-PADYC_GREATEST_RAD_S),
                greatest.min(PADYC_GREATEST_RAD_S),
            ]
        })
    }
}

impl Default for Padyc {
    fn default() -> Padyc {
        Padyc::new()
    }
}

impl Device for Padyc {
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>) {
        self.limits_rad_s = Padyc::limits_rad_s(aim, now);
    }

    fn rows(&mut self, place: &Place, _: [f64; 2], _: f64) -> Rows {
        Rows::Limited(LimitedRates {
            rows: joints(place),
            limits_rad_s: self.limits_rad_s,
        })
    }
}

/// How the joints turn while the tip moves, 2×2, 1/m.
fn joints_by_tip(place: &Place) -> Matrix2<f64> {
    joints(place) * place.tip.try_inverse().unwrap_or_default()
}

/// The point of a path that the hand may reach within the horizon.
fn ahead(path: &dyn Path, now: &Now<'_>) -> [f64; 2] {
    let nearest = path.nearest(now.place.tip_m);
    let sense = libm::copysign(1.0, nearest.tangent.dot(&Vector2::from(now.tip_force_n)));
    let ahead_m = PADYC_SPEED_M_S * PADYC_HORIZON_S;
    (nearest.foot_m + nearest.tangent * (sense * ahead_m)).into()
}

/// Limits that let each joint go towards its angle at a point within the horizon, and not past it.
fn towards(now: &Now<'_>, point_m: [f64; 2]) -> [[f64; 2]; 2] {
    turns_rad(now, point_m).map(|turn_rad| {
        let rate_rad_s = turn_rad / PADYC_HORIZON_S;
        [rate_rad_s.min(0.0), rate_rad_s.max(0.0)]
    })
}

/// How far joints A and E have to turn until the tip is at a point, rad; neither where it cannot be.
fn turns_rad(now: &Now<'_>, point_m: [f64; 2]) -> [f64; 2] {
    let arms = arms(BODY);
    let poses = (
        inverse::pose(&arms, now.place.tip_m),
        inverse::pose(&arms, point_m),
    );
    match poses {
        (Ok(from), Ok(to)) => [
            to.theta_a_rad - from.theta_a_rad,
            to.theta_e_rad - from.theta_e_rad,
        ],
        _ => [0.0; 2],
    }
}

/// Limits within which the two joints together do not reach a wall within the horizon.
///
/// Each joint gets half of the distance; where the other one leaves the wall, what that gives as well.
fn inside(now: &Now<'_>, contact: &Contact) -> [[f64; 2]; 2] {
    let left_m_s = (-contact.depth_m).max(0.0) / PADYC_HORIZON_S;
    let by_joints = joints_by_tip(now.place).try_inverse().unwrap_or_default();
    // What a joint's rate adds to the tip's speed into the wall, m/rad.
    let approach = by_joints.transpose() * contact.inward;
    let rates = joints(now.place) * Vector2::from(now.rates);
    [0, 1].map(|i| {
        let other = approach[1 - i] * rates[1 - i];
        let budget_m_s = 0.5 * left_m_s + (-other).max(0.0);
        let most = budget_m_s / approach[i].abs();
        if approach[i] > 0.0 {
            [-PADYC_GREATEST_RAD_S, most]
        } else if approach[i] < 0.0 {
            [-most, PADYC_GREATEST_RAD_S]
        } else {
            [-PADYC_GREATEST_RAD_S, PADYC_GREATEST_RAD_S]
        }
    })
}
