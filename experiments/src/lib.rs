//! What the thesis ran, run again: one file an experiment, its curves, and the numbers of the text beside ours.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod appendix_b;
pub mod chapter_2;
pub mod chapter_3;
pub mod chapter_4;
pub mod chapter_5;
pub mod chapter_6;
mod error;
mod experiment;
mod finding;
mod outline;
mod picture;
mod table;

pub use error::Error;
pub use experiment::{Experiment, Outcome};
pub use finding::{Finding, Verdict};
pub use picture::{Axis, Curve, Field, Mark, Panel, Picture};
pub use table::{Cells, Column, Table};

/// Every experiment, in the order of the thesis. A chapter is a module with its list `EXPERIMENTS`.
pub fn all() -> Vec<Experiment> {
    [
        chapter_2::EXPERIMENTS,
        chapter_3::EXPERIMENTS,
        chapter_4::EXPERIMENTS,
        chapter_5::EXPERIMENTS,
        chapter_6::EXPERIMENTS,
        appendix_b::EXPERIMENTS,
    ]
    .concat()
}

/// The experiment of that id, or `None`.
pub fn find(id: &str) -> Option<Experiment> {
    all().into_iter().find(|experiment| experiment.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_experiment_has_an_id_of_its_own_that_finds_it() {
        let experiments = all();
        assert!(!experiments.is_empty());
        for experiment in &experiments {
            assert_eq!(
                find(experiment.id).map(|e| e.title),
                Some(experiment.title),
                "{}",
                experiment.id
            );
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '.';
            assert!(experiment.id.chars().all(plain), "{}", experiment.id);
        }
        assert!(find("3.99").is_none());
    }
}
