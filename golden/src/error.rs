//! This file says why a case cannot be computed, read or written.

use std::path::PathBuf;

use rigproof_trace::TraceError;

/// Why there is no answer about the cases.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A manifest cannot be understood.
    #[error("{}: {problem}; `rigproof golden regenerate {case}` writes it anew", file.display())]
    Damaged {
        /// The manifest.
        file: PathBuf,
        /// The case it belongs to.
        case: String,
        /// What is wrong with it, and where.
        problem: String,
    },
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] TraceError),
    /// The folder of the cases is not there.
    #[error("there is no folder `{}` with golden cases; run this where the project lies, or name the folder with --cases", folder.display())]
    NoFolder {
        /// Where it was looked for.
        folder: PathBuf,
    },
    /// The model refuses what a case asks of it.
    #[error("the case `{case}` cannot be computed: {problem}")]
    Model {
        /// The case.
        case: String,
        /// The model's answer.
        problem: String,
    },
    /// A table lacks something or cannot be taken for one.
    #[error("{0}")]
    Table(String),
}

impl Error {
    /// The model's refusal of a case.
    pub(crate) fn model(case: &str, problem: impl core::fmt::Display) -> Error {
        Error::Model {
            case: case.to_owned(),
            problem: problem.to_string(),
        }
    }
}
