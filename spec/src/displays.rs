//! This file holds the numbers of the other displays of chapter 2, which the text describes in words alone (decision 0240).

use crate::layout::Layout;

/// The layout whose arms and masses stand in for those of PTER, Osaka's display and PADyC, none of which is printed (gap `displays-bodies`).
///
/// Its base joints share one axis, as PTER's do, and §4.2.2 weighs a scaled PTER against it.
pub const BODY: Layout = Layout::ThreeBrake;

/// A friction clutch of PTER (gap `pter-clutches`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClutchFigures {
    /// Greatest torque while the clutch stands, N·m.
    pub static_nm: f64,
    /// Kinetic over static torque: above one, as chapter 1 says.
    pub kinetic_over_static: f64,
    /// Slip rate from which on the torque is all kinetic, rad/s.
    pub kinetic_from_rad_s: f64,
    /// From a command to the first change of torque, s.
    pub delay_s: f64,
    /// Time constant of the torque after that, s.
    pub response_s: f64,
}

/// PTER's clutches: "large response times and time delays", a "higher kinetic coefficient of friction than static" (chapter 1).
pub const PTER_CLUTCH: ClutchFigures = ClutchFigures {
    static_nm: 5.6,
    kinetic_over_static: 1.2,
    kinetic_from_rad_s: 0.05,
    delay_s: 0.02,
    response_s: 0.05,
};

/// Gain from a link's excess speed to a clutch's torque, N·m·s/rad (gap `pter-control`).
pub const PTER_GAIN_NM_S_PER_RAD: f64 = 20.0;
