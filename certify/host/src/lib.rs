//! This file is what a compiled controller exports and what it is told and answers; `certify/c/include/rigproof_controller.h` is made from it.
#![expect(
    unsafe_code,
    reason = "a controller in C exports functions, which only trust can call, and is handed pointers"
)]

pub mod axis;
#[cfg(target_os = "linux")]
mod call;
#[cfg(target_os = "linux")]
mod descendants;
#[cfg(target_os = "linux")]
mod library;
#[cfg(target_os = "linux")]
mod limits;
#[cfg(target_os = "linux")]
mod owner;
#[cfg(target_os = "linux")]
mod watch;
#[cfg(target_os = "linux")]
mod work;

mod run;
mod tried;

pub use run::{Role, run};
pub use tried::{Tried, try_out};

/// Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
/// struct over.
pub const RIGPROOF_CONTROLLER_VERSION: u32 = 1;
/// Most points of a chain or a spline.
pub const RIGPROOF_CONTROLLER_MOST_POINTS: usize = 64;

/// What kind of path the operator is to follow or to stay out of.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofControllerTask {
    /// A chain of straight lines through the points; two points are a line.
    Chain = 0,
    /// An arc about a centre.
    Arc = 1,
    /// A natural cubic spline through the points.
    Spline = 2,
}

/// What is fixed about a rig, and the path. Lengths are in m, in the plane of the rig: A lies at (-AB/2, 0), B at (AB/2, 0), the tip works where y is
/// positive, and angles grow counter-clockwise from x. Arm AE carries arm ED, arm BC carries arm CD, and ED and CD meet in the tip. Joints and brakes
/// come in the order A, E, B, C.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofControllerSettings {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_CONTROLLER_VERSION`.
    pub version: u32,
    /// How many brakes: 3 (A, E, B) or 4 (A, E, B, C). With 3 the current of C has to be 0.
    pub brakes: u32,
    /// The kind of the path: a number of `RigproofControllerTask`.
    pub task: u32,
    /// Lengths of AE, ED, BC, CD and AB, m.
    pub arms_m: [f64; 5],
    /// Counts a turn of the encoders on A and B.
    pub counts_per_turn: [u32; 2],
    /// Their counts where the angle is zero. Counts grow as the arm turns counter-clockwise.
    pub zero_counts: [i32; 2],
    /// Time from one tick to the next, s.
    pub sample_s: f64,
    /// Greatest rate at which a base joint is believed to turn, rad/s.
    pub greatest_rate_rad_s: f64,
    /// Greatest component of a tip force that is believed, N.
    pub greatest_force_n: f64,
    /// Greatest current of a brake, A; the least is 0.
    pub greatest_current_a: f64,
    /// Chain and spline: how many points, 2 to `RIGPROOF_CONTROLLER_MOST_POINTS`. Arc: 0.
    pub points: u32,
    /// Nothing; 0.
    pub reserved: u32,
    /// Arc: its centre, x and y, m.
    pub centre_m: [f64; 2],
    /// Arc: its radius, m.
    pub radius_m: f64,
    /// Arc: the angle where it begins, rad, from x towards y.
    pub from_rad: f64,
    /// Arc: the angle where it ends, rad; below `from_rad` if it runs clockwise.
    pub to_rad: f64,
    /// Chain and spline: the points, x and y, m; those beyond `points` are 0.
    pub points_m: [[f64; 2]; RIGPROOF_CONTROLLER_MOST_POINTS],
}

/// What a tick is told. It may be wrong, as sensors are: repeated, missed, jumping, not a number.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofControllerSensed {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_CONTROLLER_VERSION`.
    pub version: u32,
    /// Number of the sample: one more than that of the sample before, then 0 after the greatest.
    pub number: u32,
    /// Counts of the encoders on A and B.
    pub counts: [i32; 2],
    /// Nothing; 0.
    pub reserved: u32,
    /// Force of the operator on the tip, x and y, N.
    pub tip_force_n: [f64; 2],
}

/// What a tick asks of the amplifiers.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofControllerCommanded {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_CONTROLLER_VERSION`.
    pub version: u32,
    /// Brake currents, A, in the order A, E, B, C: 0 to `greatest_current_a`. They are not numbers before each call: write all four.
    pub currents_a: [f64; 4],
}

// What a controller exports. It is never linked here: the library is opened when the program runs.
unsafe extern "C" {
    /// `RIGPROOF_CONTROLLER_VERSION` of the header that the controller was compiled with. It is asked before anything else.
    pub fn rigproof_controller_version() -> u32;

    /// Begins afresh: whatever an earlier `init` and its ticks left is forgotten. It is called before the first tick of every trial, on one thread, and
    /// one trial is over before the next begins, so that a controller may keep what it knows in global variables.
    ///
    /// 0: it is ready. Any other: it cannot work with these settings; neither `tick` nor `shutdown` is called.
    pub fn rigproof_controller_init(settings: *const RigproofControllerSettings) -> i32;

    /// The currents of one tick. `sensed` may only be read, `commanded` be written within its size; neither may be kept.
    ///
    /// 0: the currents are written. Any other: the controller says that it failed, which ends the trial and is reported; `shutdown` is not called.
    pub fn rigproof_controller_tick(
        sensed: *const RigproofControllerSensed,
        commanded: *mut RigproofControllerCommanded,
    ) -> i32;

    /// The trial is over. `init` may follow.
    pub fn rigproof_controller_shutdown();
}
