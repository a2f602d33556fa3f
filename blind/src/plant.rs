//! This file names the plants a case can be recorded on.

use crate::error::Error;
use serde::{Deserialize, Serialize};

/// The plant of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Plant {
    /// One driven joint: position and command are recorded.
    Axis,
    /// A brake or damper moved by a motor: position and resisting effort are recorded.
    Bench,
    /// The five-bar with three or four brakes: angles, force on the tip and currents are recorded.
    Rig,
    /// A serial arm: positions and efforts of its joints are recorded.
    Chain,
}

impl Plant {
    /// Every plant.
    pub const ALL: [Plant; 4] = [Plant::Axis, Plant::Bench, Plant::Rig, Plant::Chain];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Plant::Axis => "axis",
            Plant::Bench => "bench",
            Plant::Rig => "rig",
            Plant::Chain => "chain",
        }
    }

    /// The plant of a name.
    ///
    /// # Errors
    /// [`Error::UnknownPlant`] for any other text.
    pub fn from_name(name: &str) -> Result<Plant, Error> {
        Plant::ALL
            .into_iter()
            .find(|plant| plant.name() == name)
            .ok_or_else(|| Error::UnknownPlant(name.to_owned()))
    }
}
