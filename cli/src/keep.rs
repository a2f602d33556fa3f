//! This file keeps what a verb reads from being replaced by what it writes.

use std::path::{Path, PathBuf};

use crate::outcome::Failure;

/// Refuses an output, a file or a folder, that is one of the inputs or holds one.
///
/// # Errors
/// Which input it would replace.
pub fn check<'a>(out: &Path, inputs: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    // What is not there yet replaces nothing, and an input that is not there is said where it is read.
    let Ok(whole) = out.canonicalize() else {
        return Ok(());
    };
    let is_inside = |input: &&PathBuf| input.canonicalize().is_ok_and(|i| i.starts_with(&whole));
    match inputs.into_iter().find(is_inside) {
        Some(input) => {
            let problem = format!(
                "writing it would replace {}, which is read; name another place for the output",
                input.display()
            );
            Err(Failure::unusable(out, problem))
        }
        None => Ok(()),
    }
}
