//! This file says what can go wrong when a case is made or an answer is opened.

/// A refusal of the room.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The plant's name is not known.
    #[error("plant \"{0}\" is not known; name one of: axis, bench, rig, chain")]
    UnknownPlant(String),
    /// The family's name is not known.
    #[error("forms \"{0}\" are not known; name one of: usual, other")]
    UnknownForms(String),
    /// The stratum's name is not known.
    #[error("stratum \"{name}\" is not known; name one of: {known}")]
    UnknownStratum {
        /// What was asked for.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// The plant has no such stratum.
    #[error(
        "the {plant} plant has no cases of the stratum \"{stratum}\"; take another stratum or plant"
    )]
    OtherPlant {
        /// The stratum's name.
        stratum: &'static str,
        /// The plant's name.
        plant: &'static str,
    },
    /// No draw met the stratum's rule of size.
    #[error(
        "seed {seed} gives no {stratum} case on the {plant} plant in {attempts} draws; choose another seed"
    )]
    NoCase {
        /// The seed.
        seed: u64,
        /// The plant's name.
        plant: &'static str,
        /// The stratum's name.
        stratum: &'static str,
        /// How many draws were tried.
        attempts: usize,
    },
    /// The experiment cannot be read or done.
    #[error("experiment: {0}; give the next-experiment.csv that the diagnosis wrote")]
    Experiment(String),
    /// The sealed answer is not in the form this room writes.
    #[error(
        "sealed answer, line {line}, column {column}: {reason}; hand over the file exactly as it was written"
    )]
    NotSealed {
        /// Line of the first offence, from 1.
        line: usize,
        /// Column of the first offence, from 1.
        column: usize,
        /// What is wrong.
        reason: String,
    },
    /// The opened answer is not the one that was committed to.
    #[error(
        "the answer's SHA-256 is {found} but the seal says {sealed}: the file was changed after it was sealed; make the case again from its seed"
    )]
    Tampered {
        /// The hash beside the seal.
        sealed: String,
        /// The hash of what was opened.
        found: String,
    },
    /// The answer cannot be written.
    #[error("the answer cannot be written as JSON: {0}")]
    Encode(serde_json::Error),
    /// The report lacks a field that scoring reads.
    #[error("the report has no {0}; score the report.json that the diagnosis wrote")]
    Report(&'static str),
}
