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
struct Written {
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
    let ledger: Written = serde_json::from_str(LEDGER)?;
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

impl Proved {
    /// How what a certificate calls proved lies to what this program's ledger proves.
    pub fn beside(&self, own: &Proved) -> Ledger {
        if self == own {
            return Ledger::Same;
        }
        if self.code == own.code {
            // The same code, and other words about it.
            return Ledger::Changed;
        }
        let known = |claim: &&Claim| {
            let same = |own: &Claim| own.claim == claim.claim && own.statement == claim.statement;
            own.claims.iter().any(same)
        };
        let known = self.claims.iter().filter(known).count();
        Ledger::Other {
            known,
            claims: self.claims.len(),
        }
    }
}

/// What is to be said of the proofs that a certificate names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ledger {
    /// They are those of this program's ledger.
    Same,
    /// They are about the code of this program's ledger and say something else.
    Changed,
    /// They are of a ledger about other code: an older or a newer one.
    Other {
        /// Claims of which this program's ledger proves the same statement.
        known: usize,
        /// All claims.
        claims: usize,
    },
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
    #[test]
    fn another_ledger_is_told_from_a_changed_one() {
        let own = proved(&Subject::built_in(BuiltIn::of(Method::Sdof))).unwrap();
        assert_eq!(own.beside(&own), Ledger::Same);
        let mut fewer = own.clone();
        fewer.claims.pop();
        assert_eq!(fewer.beside(&own), Ledger::Changed);
        let mut older = own.clone();
        older.code = Some("0f".repeat(32));
        let claims = own.claims.len();
        assert_eq!(
            older.beside(&own),
            Ledger::Other {
                known: claims,
                claims
            }
        );
        older.claims[3].statement.push_str(" always");
        let known = claims - 1;
        assert_eq!(older.beside(&own), Ledger::Other { known, claims });
        let nothing = Proved {
            words: own.words.clone(),
            code: None,
            claims: Vec::new(),
        };
        assert_eq!(nothing.beside(&nothing), Ledger::Same);
    }
}
