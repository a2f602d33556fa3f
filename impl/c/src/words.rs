//! This file holds the words that go between C and the tick.

use rigproof_impl::command::Command;
use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;

use crate::RIGPROOF_TICK_VERSION;

/// How a call ended.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofTickStatus {
    /// As it should.
    Ok = 0,
    /// A pointer is null or not aligned.
    BadPointer = 1,
    /// Size or version are not those of this library.
    BadVersion = 2,
    /// A setting is outside its range.
    BadSettings = 3,
    /// There is no controller.
    NotCreated = 4,
}

/// The control laws that C can choose; in the settings their number is given.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofTickLaw {
    /// No brake ever acts.
    Uncontrolled = 0,
    /// Proportional velocity control (§6.3).
    Proportional = 1,
    /// SDOF velocity control (§6.2).
    Sdof = 2,
}

/// What a tick is told.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofTickSensed {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    /// Number of the sample: one more than that of the sample before, then 0 after the greatest.
    pub number: u32,
    /// Counts of the encoders on A and B.
    pub counts: [i32; 2],
    /// Force of the operator on the tip, x and y, N.
    pub tip_force_n: [f64; 2],
}

/// What a tick asks of the amplifiers.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofTickCommand {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    /// Brake currents, A, in the order A, E, B, C: 0 to 1.
    pub currents_a: [f64; 4],
    /// Why: a number of `RigproofTickReason`.
    pub reason: u32,
    /// The brakes that were chosen, 0 to 3 in the order A, E, B, C; -1 for none.
    pub chosen: [i32; 2],
}

/// Why these currents.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofTickReason {
    /// One brake was chosen.
    Chosen = 0,
    /// Two brakes were chosen together.
    ChosenPair = 1,
    /// All brakes hold: none helps and the operator pushes away from the path.
    LockedPushedAway = 2,
    /// All brakes hold: the tip moves against the desired direction.
    LockedMovingBack = 3,
    /// None: the tip is on the path, or inside its gap.
    InsideGap = 4,
    /// None: the tip is on the free side of the obstacle's boundary.
    FreeSide = 5,
    /// None: no brake helps, and the operator does not push away from the path.
    NoneHelps = 6,
    /// None: the linkage is at a singularity.
    SingularPose = 7,
    /// None: nothing calls for a force.
    NothingToDo = 8,
    /// None: an input is not a finite number, or beyond what its sensor can give.
    UndefinedInput = 9,
    /// None: this method never brakes.
    Uncontrolled = 10,
    /// None: too few good samples since the start or since the last fault.
    Starting = 11,
    /// None: no new sample came for too long, or one was missed.
    StaleSample = 12,
    /// None: an encoder moved faster than a hand can, or stands where its joint cannot.
    JumpedCounts = 13,
    /// None: the control law asked for what no brake may be given.
    RefusedCommand = 14,
}

impl RigproofTickCommand {
    /// No current anywhere.
    pub(crate) fn none() -> RigproofTickCommand {
        Command::none(Reason::UndefinedInput).into()
    }
}

impl From<Command<f64>> for RigproofTickCommand {
    fn from(command: Command<f64>) -> RigproofTickCommand {
        let (reason, chosen) = word(command.reason);
        RigproofTickCommand {
            size: size_of::<RigproofTickCommand>() as u32,
            version: RIGPROOF_TICK_VERSION,
            currents_a: command.currents_a,
            reason: reason as u32,
            chosen,
        }
    }
}

fn word(reason: Reason) -> (RigproofTickReason, [i32; 2]) {
    use RigproofTickReason as Word;
    let of = |joint: Joint| joint as i32;
    let word = match reason {
        Reason::Chosen(joint) => return (Word::Chosen, [of(joint), -1]),
        Reason::ChosenPair(one, other) => return (Word::ChosenPair, [of(one), of(other)]),
        Reason::LockedPushedAway => Word::LockedPushedAway,
        Reason::LockedMovingBack => Word::LockedMovingBack,
        Reason::InsideGap => Word::InsideGap,
        Reason::FreeSide => Word::FreeSide,
        Reason::NoneHelps => Word::NoneHelps,
        Reason::SingularPose => Word::SingularPose,
        Reason::NothingToDo => Word::NothingToDo,
        Reason::UndefinedInput => Word::UndefinedInput,
        Reason::Uncontrolled => Word::Uncontrolled,
        Reason::Starting => Word::Starting,
        Reason::StaleSample => Word::StaleSample,
        Reason::JumpedCounts => Word::JumpedCounts,
        Reason::RefusedCommand => Word::RefusedCommand,
    };
    (word, [-1, -1])
}
