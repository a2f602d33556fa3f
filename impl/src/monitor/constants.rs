//! This file is what a certificate says of its rigs, in the numbers that the monitor computes with.

use rigproof_spec::inertia::Inertia;
use rigproof_spec::tables::BrakeTable;

/// Numbers that are told from the motion: gains and levels of A, E, B, C, then the bias of A and B.
pub const WATCHED: usize = 10;
/// Numbers that are estimated: those, the slowness of the brakes A, E, B, C, the masses of the sides A-E-D and B-C-D, and the payload.
pub const NUMBERS: usize = 17;
/// Cells of place, speed and force.
pub const CELLS: u32 = 36;

/// What is certified, and how sure the monitor has to be. A rig's own numbers stand in the tick's settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Masses in the middle of what was certified.
    pub inertia: Inertia,
    /// The brakes A, E, B, C as they were found; what stands where there is none is not read.
    pub brakes: [BrakeTable; 4],
    /// Viscous friction of A, E, B, C, N·m·s/rad.
    pub viscous_nm_s: [f64; 4],
    /// Dry friction of A, E, B, C beside the brake's, N·m.
    pub dry_nm: [f64; 4],
    /// Constant torque against A, E, B, C, N·m.
    pub constant_nm: [f64; 4],
    /// Share of the width of a backlash by which it may be another: what a brake does there is not asked.
    pub backlash_share: f64,
    /// Between which ends each number was certified, as its difference from the middle: a gain as a share of the torque that
    /// current makes, a level of friction and a bias in N·m, slowness and masses as shares.
    pub low: [f64; NUMBERS],
    /// The upper ends.
    pub high: [f64; NUMBERS],
    /// How far each number lies about the middle where nothing was seen: the standard deviation, in its unit.
    pub spread: [f64; NUMBERS],
    /// Time over which what was learned of the rig is forgotten, s of motion that could be used.
    pub memory_s: f64,
    /// Share of an inertial impulse, and of an impulse of the brakes, that the model may miss.
    pub missed_share: [f64; 2],
    /// By how many standard deviations a number has to be beyond its end.
    pub levels: [f64; WATCHED],
    /// Greatest mean square of the normalised surprise.
    pub surprise: f64,
    /// The box in which the tip was, m: least and greatest x, least and greatest y.
    pub tip_m: [f64; 4],
    /// Greatest speed of the tip, m/s.
    pub speed_m_s: f64,
    /// Greatest force on the tip, N.
    pub force_n: f64,
    /// What lies farther from the base joints' line is far, m.
    pub far_m: f64,
    /// Speeds of the tip between still, slow and fast, m/s.
    pub speeds_m_s: [f64; 2],
    /// Forces between light, middle and strong, N.
    pub forces_n: [f64; 2],
    /// The cells in which samples lay, a bit each: place (left near, left far, right near, right far) times 9, speed times 3, force.
    pub cells: u64,
    /// Samples in a row outside of what was covered that raise an alarm.
    pub hold: u32,
    /// Samples in a row without a good one that raise an alarm.
    pub longest_fault: u32,
}
