//! This file says which program ran a campaign: records of two builds are not told to be the same.

use serde::{Deserialize, Serialize};

/// The program that ran a campaign.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Its version.
    pub version: String,
    /// The SHA-256 of its file.
    pub sha256: String,
}
