//! This file names where the rig's code and the reference may differ, counts how often they do, and says how often they may.

use serde::{Deserialize, Serialize};

/// Why the rig's code and the reference may answer one sample otherwise: a decision turns there within rounding, or rounding is amplified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tie {
    /// Two points of the path are as near, or one to rounding; the reference agrees when it is given the one that the rig's code sees.
    Foot,
    /// The path: on it, at the end of the gap, at a corner, exactly across the push.
    Path,
    /// The push: exactly across the path, or towards it by nothing.
    Push,
    /// The velocity: across the desired direction, along it, or across a joint's row.
    Velocity,
    /// The pose: two brakes are as good, or a local path ends its quarter turn; or it is singular by a last digit.
    Pose,
    /// Several of these at once.
    Together,
    /// The same decision where nudging the last digits moves the reference's currents half as much: near a singularity, or where a great gain
    /// multiplies the rounding of a great velocity.
    Amplified,
    /// Exception: a torque in the step of (3.3) at 0.2 A, which two currents give.
    CurrentStep,
    /// Exception: velocity ratio control finds both ratios equal, the reference all but equal.
    Even,
    /// Exception: optimal control takes another brake or level, whose cost is the same to the last digits of what costs are made of.
    Level,
    /// Exception: one brake makes the force of impedance control alone; the two name different idle ones beside it, or one of them no pair.
    IdleBrake,
    /// Exception: an input beyond what the rig's code takes, which lets go.
    Gate,
}

/// How many kinds of ties there are.
pub const TIES: usize = 12;

impl Tie {
    /// Every kind.
    pub const ALL: [Tie; TIES] = [
        Tie::Foot,
        Tie::Path,
        Tie::Push,
        Tie::Velocity,
        Tie::Pose,
        Tie::Together,
        Tie::Amplified,
        Tie::CurrentStep,
        Tie::Even,
        Tie::Level,
        Tie::IdleBrake,
        Tie::Gate,
    ];

    /// In how many trials it may be met (decision 0147 has what was measured).
    pub const fn budget(self) -> Budget {
        let share = match self {
            Tie::Foot => 0.2,
            Tie::Amplified => 0.05,
            _ => 0.02,
        };
        Budget { share, always: 10 }
    }

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Tie::Foot => "foot",
            Tie::Path => "path",
            Tie::Push => "push",
            Tie::Velocity => "velocity",
            Tie::Pose => "pose",
            Tie::Together => "together",
            Tie::Amplified => "amplified",
            Tie::CurrentStep => "current_step",
            Tie::Even => "even",
            Tie::Level => "level",
            Tie::IdleBrake => "idle_brake",
            Tie::Gate => "gate",
        }
    }

    /// What turns.
    pub const fn words(self) -> &'static str {
        match self {
            Tie::Foot => "two points of the path are as near, or one to rounding",
            Tie::Path => "on the path, at the end of its gap, at a corner, or across the push",
            Tie::Push => "the push is across the path, or all but nothing",
            Tie::Velocity => "the velocity is across or along a direction that decides",
            Tie::Pose => "two brakes are as good at this pose, or a local path ends there",
            Tie::Together => "several of these at once",
            Tie::Amplified => "the same decision; last digits move its currents as much",
            Tie::CurrentStep => "a torque that two currents give",
            Tie::Even => "two ratios of velocity are equal",
            Tie::Level => "two forces cost the same",
            Tie::IdleBrake => "one brake makes the force alone, beside any idle one",
            Tie::Gate => "an input beyond what the rig takes",
        }
    }
}

/// In how many trials a kind of tie may be met: more of them would hide a difference of the two programs behind decisions that turn. Trials count, not
/// samples, because a tip that stands on the path stands there for long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// A share of the trials.
    pub share: f64,
    /// So many whatever that comes to.
    pub always: u64,
}

impl Budget {
    /// The most trials of so many.
    pub fn most(self, trials: u64) -> u64 {
        self.always.max((self.share * trials as f64) as u64)
    }
}

/// How many samples were ties, by kind in the order of [`Tie::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ties([u64; TIES]);

impl Ties {
    /// Counts one.
    pub fn add(&mut self, tie: Tie) {
        self.join(&Ties::one(tie));
    }

    fn one(tie: Tie) -> Ties {
        Ties(Tie::ALL.map(|own| u64::from(own == tie)))
    }

    /// Adds those of others.
    pub fn join(&mut self, others: &Ties) {
        for (own, more) in self.0.iter_mut().zip(others.0) {
            *own += more;
        }
    }

    /// The kinds that were met, and how often.
    pub fn met(&self) -> impl Iterator<Item = (Tie, u64)> {
        Tie::ALL
            .into_iter()
            .zip(self.0)
            .filter(|(_, count)| *count > 0)
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }
}
