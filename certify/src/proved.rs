//! This file says what was proved of the rig's own code, from the ledger of proofs.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::plan::{Subject, What};

/// The ledger as it was when this program was built.
const LEDGER: &str = include_str!("../../proofs/ledger.json");

/// What was proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Proved {
    /// What the claims are about, and what they are not.
    pub words: String,
    /// The SHA-256 of the code that the ledger is about.
    pub code: Option<String>,
    /// The claims, and what proved them.
    pub claims: Vec<Claim>,
}

/// A claim that was proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Its name in the ledger.
    pub claim: String,
    /// What it says, and what it assumes.
    pub statement: String,
    /// The engines that proved it, each with its bound.
    pub by: Vec<String>,
}

#[derive(Deserialize)]
struct Ledger {
    code: String,
    claims: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    claim: String,
    statement: String,
    verdicts: Vec<Verdict>,
}

#[derive(Deserialize)]
struct Verdict {
    engine: String,
    word: String,
    how: String,
}

/// What the ledger proves of a controller.
///
/// # Errors
/// The ledger is not as it was written.
pub fn proved(subject: &Subject) -> Result<Proved, Error> {
    if let What::Given { .. } = subject.what {
        return Ok(Proved {
            words: "Nothing was proved: the ledger is about the rig's own laws, not about this controller.".to_owned(),
            code: None,
            claims: Vec::new(),
        });
    }
    let ledger: Ledger = serde_json::from_str(LEDGER)?;
    let claims = ledger.claims.into_iter().filter_map(|entry| {
        let by: Vec<String> = entry
            .verdicts
            .into_iter()
            .filter(|verdict| verdict.word == "PROVED")
            .map(|verdict| format!("{}: {}", verdict.engine, verdict.how))
            .collect();
        (!by.is_empty()).then_some(Claim {
            claim: entry.claim,
            statement: entry.statement,
            by,
        })
    });
    Ok(Proved {
        words: "Proved in the ledger, each within what its statement assumes: claims about the guard, the selection of brakes, the \
                numbering of samples and the backlash in the rig's own code, in the build that the ledger names. Nothing is \
                proved about the parameters, the path, the plant or the hand."
            .to_owned(),
        code: Some(ledger.code),
        claims: claims.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::built_in::BuiltIn;
    use rigproof_spec::methods::Method;

    #[test]
    fn only_what_an_engine_proved_is_called_proved() {
        let proved = proved(&Subject::built_in(BuiltIn::of(Method::Sdof))).unwrap();
        assert!(proved.claims.len() > 30);
        assert!(proved.claims.iter().all(|claim| !claim.by.is_empty()));
        let sampled_only = "\"word\": \"TESTED\"";
        assert!(LEDGER.contains(sampled_only));
        assert!(
            proved
                .claims
                .iter()
                .flat_map(|claim| &claim.by)
                .all(|by| !by.starts_with("random"))
        );
    }
}
