//! This file seals an answer so that nobody reads it by accident, and opens it again.
//!
//! The answer's JSON is enciphered with a SHA-256 key stream and written in hexadecimal beside its own SHA-256. The
//! key is in the file: the seal keeps the answer out of sight, the commitment keeps it unchanged.

use crate::answer::Answer;
use crate::error::Error;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sealed {
    commitment: String,
    nonce: String,
    sealed: String,
}

/// Seals an answer; returns the sealed text and the commitment.
///
/// # Errors
/// [`Error::Encode`] when the answer is not JSON.
pub fn seal(answer: &Answer) -> Result<(String, String), Error> {
    let plain = serde_json::to_string(answer).map_err(Error::Encode)?;
    let commitment = commitment(&plain);
    // The nonce needs no secret, only to differ between answers.
    let nonce: String = self::commitment(&commitment).chars().take(32).collect();
    let sealed = Sealed {
        sealed: hex(&apply_stream(&nonce, plain.as_bytes())),
        commitment: commitment.clone(),
        nonce,
    };
    let text = serde_json::to_string_pretty(&sealed).map_err(Error::Encode)?;
    Ok((text + "\n", commitment))
}

/// Opens a sealed answer and checks it against its commitment.
///
/// # Errors
/// [`Error::NotSealed`] when the text has another form, [`Error::Tampered`] when the hash differs.
pub fn open(sealed: &str) -> Result<Answer, Error> {
    let file: Sealed = serde_json::from_str(sealed).map_err(|error| refusal(&error))?;
    let bytes = unhex(&file.sealed).ok_or_else(|| Error::NotSealed {
        line: 1,
        column: 1,
        reason: "\"sealed\" is not pairs of the digits 0 to 9 and a to f".to_owned(),
    })?;
    let plain = apply_stream(&file.nonce, &bytes);
    let found = hex(&Sha256::digest(&plain));
    if found != file.commitment {
        return Err(Error::Tampered {
            sealed: file.commitment,
            found,
        });
    }
    serde_json::from_slice(&plain).map_err(|error| refusal(&error))
}

/// SHA-256 of an answer's text, lower-case hexadecimal.
pub fn commitment(plain: &str) -> String {
    hex(&Sha256::digest(plain.as_bytes()))
}

fn refusal(error: &serde_json::Error) -> Error {
    Error::NotSealed {
        line: error.line(),
        column: error.column(),
        reason: error.to_string(),
    }
}

fn apply_stream(nonce: &str, bytes: &[u8]) -> Vec<u8> {
    bytes
        .chunks(32)
        .zip(0_u64..)
        .flat_map(|(block, counter)| {
            let key = Sha256::new()
                .chain_update(nonce)
                .chain_update(counter.to_le_bytes())
                .finalize();
            block
                .iter()
                .zip(key)
                .map(|(byte, key)| byte ^ key)
                .collect::<Vec<u8>>()
        })
        .collect()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn unhex(text: &str) -> Option<Vec<u8>> {
    if !text.len().is_multiple_of(2) {
        return None;
    }
    text.as_bytes()
        .chunks(2)
        .map(|pair| {
            let pair = std::str::from_utf8(pair).ok()?;
            u8::from_str_radix(pair, 16).ok()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::{HiddenEffect, TrueParameter};
    use crate::forms::Forms;
    use crate::plant::Plant;
    use crate::stratum::Stratum;
    use proptest::prelude::*;

    fn answer() -> Answer {
        Answer {
            seed: 4711,
            plant: Plant::Bench,
            stratum: Stratum::Single,
            effects: vec![HiddenEffect {
                mechanism: "stribeck".to_owned(),
                joint: None,
                onset_s: Some(7.31),
                parameters: vec![TrueParameter {
                    name: "peak".to_owned(),
                    value: 0.123_456_789_012_345_67,
                    unit: "N·m".to_owned(),
                }],
                size: 5.5,
                distinctness: 2.2,
                strength: 77.0,
                onset_strength: None,
                equivalent: vec![vec!["constant_bias".to_owned()]],
                form: String::new(),
                right: Vec::new(),
                companions: Vec::new(),
                scope: None,
            }],
            fault: None,
            spoilt: None,
            block_noise: 0.001_7,
            residual_ratio: None,
            forms: Forms::Usual,
        }
    }

    #[test]
    fn a_sealed_answer_opens_to_the_same_bits() {
        let (sealed, commitment) = seal(&answer()).unwrap();
        assert_eq!(open(&sealed).unwrap(), answer());
        assert!(sealed.contains(&commitment));
    }

    #[test]
    fn the_plain_text_cannot_be_seen() {
        let (sealed, _) = seal(&answer()).unwrap();
        for word in ["stribeck", "peak", "single", "4711"] {
            assert!(!sealed.contains(word), "{word} shows");
        }
        assert!(!sealed.contains(&hex(b"stribeck")));
    }

    #[test]
    fn the_hash_is_the_standard_one() {
        assert_eq!(
            commitment("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    proptest! {
        #[test]
        fn any_changed_character_is_refused(place in 0_usize..4000, digit in 0_u8..16) {
            let (sealed, _) = seal(&answer()).unwrap();
            let mut bytes = sealed.clone().into_bytes();
            let place = place % bytes.len();
            let new = b"0123456789abcdef"[usize::from(digit)];
            prop_assume!(bytes[place] != new && !bytes[place].is_ascii_whitespace());
            bytes[place] = new;
            if let Ok(text) = String::from_utf8(bytes) {
                prop_assert!(open(&text).is_err());
            }
        }
    }
}
