//! What the model computed: checked-in cases, and the only code that may write them.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

mod brake;
mod case;
mod check;
mod claim;
mod controlled;
mod error;
mod manifest;
mod regenerate;
mod release;
mod table;

pub use case::{Case, Parameter, Run, Value};
pub use check::{Cell, Difference, check, orphans};
pub use claim::{Claim, Shows};
pub use error::Error;
pub use manifest::Manifest;
pub use regenerate::{Computed, computed, regenerate};
pub use table::Table;

/// Where the cases lie, seen from the root of the project.
pub const FOLDER: &str = "golden/cases";

/// Every case, in the order of the thesis.
pub fn cases() -> Vec<Case> {
    [brake::cases(), release::cases(), controlled::cases()]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_has_a_plain_name_of_its_own() {
        let names: Vec<String> = cases().into_iter().map(|case| case.name).collect();
        assert!(names.len() >= 16, "{}", names.len());
        for (index, name) in names.iter().enumerate() {
            let plain = |c: char| c.is_ascii_lowercase() || c == '_';
            assert!(name.chars().all(plain), "{name}");
            assert!(names.iter().skip(index + 1).all(|other| other != name));
        }
    }
}
