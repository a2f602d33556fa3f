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

/// Osaka's ER brakes: "smooth transitions", a response of "several milliseconds" (chapter 1, table 2.1; gap `osaka-brakes`).
pub const OSAKA_BRAKE: ClutchFigures = ClutchFigures {
    static_nm: 4.0,
    kinetic_over_static: 1.0,
    kinetic_from_rad_s: 0.05,
    delay_s: 0.0,
    response_s: 0.005,
};
/// Half the width of the track in which Osaka's brakes alternate, m (gap `osaka-track`).
pub const OSAKA_TRACK_M: f64 = 0.01;
/// Distance from the middle of the track at which the other brake takes over, m (gap `osaka-track`).
pub const OSAKA_CHANGE_M: f64 = 0.001;

/// Greatest speed at which PADyC's motors drive their clutches, rad/s (gap `padyc-speeds`).
pub const PADYC_GREATEST_RAD_S: f64 = 10.0;
/// Time in which a joint may at most reach what it is let towards, s (gap `padyc-speeds`).
pub const PADYC_HORIZON_S: f64 = 0.01;
/// Speed along the path that trajectory mode lets through, m/s (gap `padyc-speeds`).
pub const PADYC_SPEED_M_S: f64 = 0.25;

/// Mass of Scooter with what its handle carries, kg (gap `scooter-figures`).
pub const SCOOTER_MASS_KG: f64 = 5.0;
/// Sideways force that a castor of Scooter withstands, N (gap `scooter-figures`).
pub const SCOOTER_GRIP_N: f64 = 30.0;
/// Time constant of the motors that steer the castors, s (gap `scooter-figures`).
pub const SCOOTER_STEERING_S: f64 = 0.03;
/// Greatest rate at which they steer, rad/s (gap `scooter-figures`).
pub const SCOOTER_GREATEST_RAD_S: f64 = 10.0;
/// Force below which the castors keep their direction, N (gap `scooter-figures`).
pub const SCOOTER_FELT_N: f64 = 0.3;
/// How far ahead Scooter looks for a wall, s (gap `scooter-figures`).
pub const SCOOTER_AHEAD_S: f64 = 0.1;

/// Gain from a link's excess speed to a clutch's torque, N·m·s/rad (gap `pter-control`).
pub const PTER_GAIN_NM_S_PER_RAD: f64 = 20.0;
