//! This file computes the hashes by which everything is known again.

use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::error::Error;

/// The SHA-256 of bytes, in hexadecimal.
pub fn of_bytes(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The SHA-256 of a value's JSON as this program writes it: one form, its keys in one order.
///
/// # Errors
/// It cannot be written as JSON.
pub fn of_value(value: &impl Serialize) -> Result<String, Error> {
    Ok(of_bytes(serde_json::to_string(value)?.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_of_the_printed_example_is_met() {
        // FIPS 180-2, appendix B.1.
        let digest = of_bytes(b"abc");
        assert!(digest.starts_with("ba7816bf8f01cfea") && digest.ends_with("b410ff61f20015ad"));
    }
}
