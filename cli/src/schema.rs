//! This file is what may stand in a description, for editors that complete and check: laid beside one that somebody is to complete.

use std::path::Path;

use rigproof_trace::rig::schema::schema_text;
use rigproof_trace::store;

use crate::outcome::Failure;

/// The file for rigs, as the first line of a description names it.
pub const FILE: &str = "rig.schema.json";
/// The file for `certify.toml`.
pub const CERTIFY_FILE: &str = "certify.schema.json";

/// Lays the one for rigs beside a description, unless a file of that name stands there.
///
/// # Errors
/// The system refuses.
pub fn beside(rig: &Path) -> Result<(), Failure> {
    let file = rig.with_file_name(FILE);
    match file.exists() {
        true => Ok(()),
        false => Ok(store::write_aside(&file, schema_text().as_bytes())?),
    }
}
