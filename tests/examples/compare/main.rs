//! This program writes the runs that `docs/compare` sets side by side with other engines, and what a step of ours costs.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a program that compares stops at the first surprise"
)]

mod case;
mod output;
mod reference;
mod timing;

use std::path::PathBuf;

use case::Case;
use output::{Entry, Folder, apart_m};

/// How often a run is timed.
const REPEATS: usize = 31;

fn main() {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("name the folder to write to");
        std::process::exit(2);
    };
    let folder = Folder::new(PathBuf::from(path));
    let entries = Case::all().iter().map(|case| entry(case, &folder)).collect();
    folder.write_index(entries);
}

fn entry(case: &Case, folder: &Folder) -> Entry {
    let converged = reference::run(case, reference::CONVERGED_STEP_S);
    let finer = reference::run(case, 0.5 * reference::CONVERGED_STEP_S);
    folder.write_run(&format!("{}-converged", case.name()), case, &converged);
    let engines = [reference::engine(case, folder, REPEATS)];
    Entry::new(case, apart_m(&converged, &finer), &engines)
}
