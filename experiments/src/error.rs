//! This file says why an experiment cannot be run.

/// Why an experiment has no outcome.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The model refused what the experiment asked of it.
    #[error("{what} cannot be computed: {problem}")]
    Model {
        /// What was asked of the model.
        what: &'static str,
        /// The model's answer.
        problem: String,
    },
    /// A table cannot be written as CSV.
    #[error("the table `{table}` cannot be written: {problem}")]
    Table {
        /// Its name.
        table: String,
        /// What is wrong with it.
        problem: String,
    },
}

impl Error {
    /// The model's refusal of `what`.
    pub fn model(what: &'static str, problem: impl core::fmt::Display) -> Error {
        Error::Model {
            what,
            problem: problem.to_string(),
        }
    }
}
