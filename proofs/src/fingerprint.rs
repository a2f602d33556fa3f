//! This file says which code a ledger is about.

use std::fs;
use std::io;
use std::path::Path;

use sha2::{Digest, Sha256};

/// What the claims run, the claims themselves, the mutants, and what examines them.
const ABOUT: [&str; 22] = [
    "impl/src/claim.rs",
    "impl/src/command.rs",
    "impl/src/guard",
    "impl/src/guard.rs",
    "impl/src/number.rs",
    "impl/src/plant/backlash",
    "impl/src/plant/backlash.rs",
    "impl/src/select",
    "impl/src/select.rs",
    "impl/src/tick.rs",
    "impl/src/vector.rs",
    "impl/src/velocity.rs",
    "proofs/build.rs",
    "proofs/mutants.toml",
    "proofs/src",
    "spec/src/command.rs",
    "spec/src/joint.rs",
    "spec/src/laws",
    "spec/src/laws.rs",
    "spec/src/methods.rs",
    "spec/src/tables.rs",
    "spec/src/units.rs",
];

/// The SHA-256 of these files, each after its path, in hexadecimal.
///
/// # Errors
/// That of the file that cannot be read.
pub fn fingerprint(root: &Path) -> io::Result<String> {
    let mut digest = Sha256::new();
    for path in ABOUT {
        add(root, path, &mut digest)?;
    }
    let bytes = digest.finalize();
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn add(root: &Path, path: &str, digest: &mut Sha256) -> io::Result<()> {
    let place = root.join(path);
    if !place.is_dir() {
        digest.update(path.as_bytes());
        digest.update(fs::read_to_string(place)?.replace("\r\n", "\n").as_bytes());
        return Ok(());
    }
    let mut names = Vec::new();
    for entry in fs::read_dir(place)? {
        names.push(entry?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    for name in names {
        add(root, &format!("{path}/{name}"), digest)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ledger_is_about_this_code() {
        let root = crate::prove::root();
        let ledger = fs::read_to_string(root.join("proofs/ledger.json")).unwrap();
        let code = fingerprint(&root).unwrap();
        assert!(
            ledger.contains(&code),
            "run `cargo run --release -p rigproof-proofs -- prove`"
        );
    }
}
