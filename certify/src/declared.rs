//! This file is what a controller says of itself, without which some laws cannot be judged.

use serde::{Deserialize, Serialize};

use crate::built_in::BuiltIn;

/// What a controller promises; what it does not promise is not looked at, and said to be not looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declared {
    /// Most brakes that have current at once when it does not lock.
    pub most_brakes: Option<u8>,
    /// Whether it may give every brake its greatest current, on the lock condition of §6.2 and §6.3.
    pub locks: Option<bool>,
    /// Distance from the path inside which no brake acts, m.
    pub gap_m: Option<f64>,
    /// Boundary of the velocity field (§6.1.1), m.
    pub boundary_m: Option<f64>,
    /// By which rule one brake is chosen.
    pub choice: Option<Choice>,
    /// Whether it keeps to the greatest force of §6.1.2 at the tip.
    #[serde(default)]
    pub within_force: bool,
    /// On which side of the path an obstacle lies; on the other no brake acts.
    pub solid: Option<Solid>,
    /// The law of the rig that it claims to be.
    pub reference: Option<Claim>,
}

/// A law of the rig that a controller claims to be, so that the reference can be set beside it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The law.
    pub law: BuiltIn,
    /// Of so many samples one is set beside the reference; 1 takes them all.
    pub every: u32,
}

/// Of so many samples one is set beside the reference, unless a description says otherwise (decision 0147).
pub const EVERY: u32 = 16;

/// A rule by which one brake is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Choice {
    /// The one whose force takes most rightly from the unwanted velocity (§6.3).
    Influence,
    /// One whose local path lies between the path's direction and the way to it (§6.2).
    QuarterTurn,
}

/// A side of the path, seen along its tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solid {
    /// To the left.
    Left,
    /// To the right.
    Right,
}
