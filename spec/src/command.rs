//! This file names what a controller may ask of the brakes, and why.

use crate::joint::Joint;

/// What a controller asks of the amplifiers in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// Brake currents, A, in the order A, E, B, C: 0 to 1.
    pub currents_a: [f64; 4],
    /// Why these currents.
    pub reason: Reason,
}

impl Command {
    /// No current anywhere.
    pub const fn none(reason: Reason) -> Command {
        Command {
            currents_a: [0.0; 4],
            reason,
        }
    }
}

/// Why a controller asks for what it asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// This brake was chosen; its current is zero where its off-state torque is enough.
    Chosen(Joint),
    /// These two brakes were chosen together.
    ChosenPair(Joint, Joint),
    /// All brakes hold: none helps and the operator pushes away from the path (§6.2, §6.3).
    LockedPushedAway,
    /// All brakes hold: the tip moves against the desired direction (§6.3).
    LockedMovingBack,
    /// None: the tip is on the path, or inside its gap (§6.5.1).
    InsideGap,
    /// None: the tip is on the free side of the obstacle's boundary (§7.3).
    FreeSide,
    /// None: no brake helps, and the operator does not push away from the path.
    NoneHelps,
    /// None: the linkage is at a singularity, where no joint torque has a known force.
    SingularPose,
    /// None: nothing calls for a force.
    NothingToDo,
    /// None: an input is not a finite number, or beyond what its sensor can give.
    UndefinedInput,
    /// None: this method never brakes (table 6.1, row 1).
    Uncontrolled,
    /// None: too few good samples since the start or since the last fault (decision 0074).
    Starting,
    /// None: no new sample came for too long, or one was missed (decision 0074).
    StaleSample,
    /// None: an encoder moved faster than a hand can, or stands where its joint cannot (decision 0074).
    JumpedCounts,
    /// None: the control law asked for what no brake may be given (decision 0074).
    RefusedCommand,
}

impl Reason {
    /// Whether every brake holds.
    pub const fn is_lock(self) -> bool {
        matches!(self, Reason::LockedPushedAway | Reason::LockedMovingBack)
    }
}
