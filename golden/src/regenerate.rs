//! This file writes a case: nothing else does.

use std::path::Path;

use rigproof_trace::store::write_aside;

use crate::Error;
use crate::case::Case;
use crate::manifest::{EXPECTED, INPUT, MANIFEST, text};
use crate::table::Table;

/// A case as it is to stand in its folder.
pub struct Computed {
    /// What goes in.
    pub input: Table,
    /// What comes out.
    pub expected: Table,
    /// The three files with their names.
    pub files: [(&'static str, Vec<u8>); 3],
}

/// Computes a case and its files.
///
/// # Errors
/// The model refuses.
pub fn computed(case: &Case) -> Result<Computed, Error> {
    let (input, expected) = case.compute()?;
    let (in_bytes, out_bytes) = (input.to_csv()?, expected.to_csv()?);
    let manifest = text(
        case,
        &[
            (INPUT, &input, &in_bytes),
            (EXPECTED, &expected, &out_bytes),
        ],
    );
    Ok(Computed {
        input,
        expected,
        files: [
            (MANIFEST, manifest.into_bytes()),
            (INPUT, in_bytes),
            (EXPECTED, out_bytes),
        ],
    })
}

/// Computes a case and writes its folder below `cases`; gives the names of the files whose bytes have changed.
///
/// # Errors
/// The model or the system refuses; what stands there already is replaced file by file.
pub fn regenerate(case: &Case, cases: &Path) -> Result<Vec<&'static str>, Error> {
    check_folder(cases)?;
    let computed = computed(case)?;
    let folder = cases.join(&case.name);
    std::fs::create_dir_all(&folder).map_err(|source| rigproof_trace::TraceError::File {
        action: "write",
        path: folder.clone(),
        source,
    })?;
    let mut changed = Vec::new();
    for (name, bytes) in &computed.files {
        let file = folder.join(name);
        // What cannot be read is written anew.
        if std::fs::read(&file).ok().as_ref() != Some(bytes) {
            write_aside(&file, bytes)?;
            changed.push(*name);
        }
    }
    Ok(changed)
}

/// Checks that the folder of the cases is there.
///
/// # Errors
/// [`Error::NoFolder`].
pub fn check_folder(cases: &Path) -> Result<(), Error> {
    if cases.is_dir() {
        Ok(())
    } else {
        Err(Error::NoFolder {
            folder: cases.to_path_buf(),
        })
    }
}
