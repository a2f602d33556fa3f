//! This file says what an experiment is and what it leaves behind.

use crate::{Error, Finding, Picture, Table};

/// Something that the thesis ran or computed, and that can be run again.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// The number of its figure, such as `3.5`, or a word where it has none.
    pub id: &'static str,
    /// The figure's title, as the list of figures has it.
    pub title: &'static str,
    /// What is run here, with every choice that the text leaves open: one or two sentences.
    pub what: &'static str,
    /// Runs it. The outcome is the same in every run and on every platform: a random draw has a fixed seed.
    pub run: fn() -> Result<Outcome, Error>,
}

/// What an experiment leaves behind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// What is written as CSV, one file a table.
    pub tables: Vec<Table>,
    /// What is drawn as SVG, one file a picture.
    pub pictures: Vec<Picture>,
    /// What the text states, beside ours.
    pub findings: Vec<Finding>,
}
