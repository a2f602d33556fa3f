//! This file says that the house is in order: it reads every text of the workspace and enforces its rules by name.

mod citations;
mod decisions;
mod ledger;
mod packages;
mod pages;
mod plants;
mod rooms;
mod rules;
mod rust;
mod unused;
mod words;
mod workspace;

/// Fails with one line per violation: file, line and what to do.
fn assert_tidy(rule: &str, violations: Vec<String>) {
    assert!(
        violations.is_empty(),
        "{rule}: {} found\n{}",
        violations.len(),
        violations.join("\n")
    );
}
