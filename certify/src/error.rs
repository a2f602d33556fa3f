//! This file says what can go wrong around a campaign; what goes wrong with a controller is a finding.

use std::path::{Path, PathBuf};

/// A refusal of the room.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written, or a description is wrong.
    #[error(transparent)]
    File(#[from] rigproof_trace::TraceError),
    /// A file of this room is not as it was written.
    #[error("{}: {problem}", file.display())]
    Unusable {
        /// The file.
        file: PathBuf,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A number is outside its range.
    #[error("{what} is {value}; give {range}")]
    Range {
        /// What.
        what: &'static str,
        /// The value.
        value: String,
        /// What is allowed.
        range: &'static str,
    },
    /// A scenario is none.
    #[error(
        "scenario {0} has no path, pose or plant; it was not written by this program: make it again"
    )]
    Scenario(u64),
    /// A recording that cannot be sent through a controller.
    #[error("{0}")]
    Replay(String),
    /// Folders that are not the shards of one campaign.
    #[error("{0}")]
    Shards(String),
    /// It cannot be written as JSON.
    #[error("the result cannot be written as JSON: {0}")]
    Encode(#[from] serde_json::Error),
}

impl Error {
    /// A file that can be read but not used.
    pub fn unusable(file: &Path, problem: impl Into<String>) -> Error {
        Error::Unusable {
            file: file.to_path_buf(),
            problem: problem.into(),
        }
    }

    /// A file that the system refuses.
    pub fn refused(file: &Path, error: &std::io::Error) -> Error {
        Error::unusable(file, format!("the system refuses: {error}"))
    }
}
