//! This file is what a compiled controller of an axis exports and what it is told and answers; `certify/c/include/rigproof_axis_controller.h` is made from it.

#[cfg(target_os = "linux")]
pub mod call;

/// Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
/// struct over.
pub const RIGPROOF_AXIS_CONTROLLER_VERSION: u32 = 1;

/// How an axis moves.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofAxisControllerMotion {
    /// It slides: travel in m, effort in N, inertia in kg.
    Linear = 0,
    /// It turns: travel in rad, effort in N·m, inertia in kg·m².
    Rotary = 1,
}

/// What is fixed about an axis and a trial.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofAxisControllerSettings {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_AXIS_CONTROLLER_VERSION`.
    pub version: u32,
    /// How the axis moves: a number of `RigproofAxisControllerMotion`.
    pub motion: u32,
    /// Nothing; 0.
    pub reserved: u32,
    /// Time from one tick to the next, s.
    pub sample_s: f64,
    /// Mass, kg, or moment of inertia, kg·m².
    pub inertia: f64,
    /// Greatest magnitude of an effort, N or N·m.
    pub greatest_effort: f64,
    /// Resolution of the sensed position, m or rad; 0 where it is not known.
    pub position_quantum: f64,
}

/// What a tick is told.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofAxisControllerSensed {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_AXIS_CONTROLLER_VERSION`.
    pub version: u32,
    /// Number of the sample, from 0.
    pub number: u32,
    /// Nothing; 0.
    pub reserved: u32,
    /// Where the axis is, as its encoder shows it, m or rad.
    pub position: f64,
    /// How fast it moves, m/s or rad/s: the change of that position over a few samples.
    pub velocity: f64,
    /// The effort that the drive gave at the end of the sample before, N or N·m.
    pub effort: f64,
    /// Where it is to be, m or rad.
    pub target_position: f64,
    /// How fast it is to move, m/s or rad/s.
    pub target_velocity: f64,
}

/// What a tick asks of the drive.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofAxisControllerCommanded {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_AXIS_CONTROLLER_VERSION`.
    pub version: u32,
    /// Effort in the sense of the position, N or N·m: at most `greatest_effort` to either side. It is not a number before each call: write it.
    pub effort: f64,
}

// What a controller exports. It is never linked here: the library is opened when the program runs.
unsafe extern "C" {
    /// `RIGPROOF_AXIS_CONTROLLER_VERSION` of the header that the controller was compiled with. It is asked before anything else.
    pub fn rigproof_axis_controller_version() -> u32;

    /// Begins afresh: whatever an earlier `init` and its ticks left is forgotten. It is called before the first tick of every trial, on one thread, and
    /// one trial is over before the next begins, so that a controller may keep what it knows in global variables.
    ///
    /// 0: it is ready. Any other: it cannot work with these settings; neither `tick` nor `shutdown` is called.
    pub fn rigproof_axis_controller_init(settings: *const RigproofAxisControllerSettings) -> i32;

    /// The effort of one tick. `sensed` may only be read, `commanded` be written within its size; neither may be kept.
    ///
    /// 0: the effort is written. Any other: the controller says that it failed, which ends the trial and is reported; `shutdown` is not called.
    pub fn rigproof_axis_controller_tick(
        sensed: *const RigproofAxisControllerSensed,
        commanded: *mut RigproofAxisControllerCommanded,
    ) -> i32;

    /// The trial is over. `init` may follow.
    pub fn rigproof_axis_controller_shutdown();
}
