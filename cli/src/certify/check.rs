//! This file checks a certificate: every byte, every hash, and a sample of its scenarios run again.

use std::path::{Path, PathBuf};

use rigproof_certify::campaign::CHUNK;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::digest;
use rigproof_certify::finding::Finding;
use rigproof_certify::law::Law;
use rigproof_certify::plan::Sources;
use rigproof_certify::proved::Ledger;
use rigproof_certify::search::Worst;
use rigproof_trace::store::read_text;
use serde_json::json;

use super::compiled::sources;
use super::sign::{self, Looked};
use super::{Args, campaign};
use crate::outcome::{Failure, Outcome, print};

/// Checks, and says what was checked.
pub fn run(args: &Args, file: &Path) -> Result<Outcome, Failure> {
    let text = read_text(file)?;
    let signature = sign::looked_at(file, text.as_bytes(), args.public_key.as_deref())?;
    let certificate = Certificate::parse(&text, file)?;
    let mut wrong = changed_files(&certificate, file);
    if signature == Looked::DoesNotHold {
        wrong.extend(signature.words().map(str::to_owned));
    }
    let compiled = args.compiled.opened_again(&certificate.plan.controller)?;
    let sources = sources(&certificate.plan, compiled.as_ref())?;
    // Whoever wrote the certificate must not know what is run again.
    let seed = args.seed.unwrap_or_else(clock);
    let count = args.sample.div_ceil(CHUNK) as usize;
    let (drawn, differ) = certificate.again(&sources, count, seed)?;
    wrong.extend(otherwise(&certificate, file, &sources)?);
    wrong.extend(not_again(&certificate, file, &sources)?);
    wrong.extend(differ.iter().map(|chunk| {
        let first = chunk * CHUNK;
        format!("scenarios {first} to {} come out otherwise", first + CHUNK)
    }));
    if let Some(compiled) = &compiled {
        let between = compiled.ended()?;
        wrong.extend(
            between
                .iter()
                .map(|what| format!("it failed between trials: {what}")),
        );
    }
    let same_tool = campaign::tool()?.sha256 == certificate.tool.sha256;
    let again = (drawn.len() as u64 * CHUNK).min(certificate.plan.scenarios);
    if args.json {
        let result = json!({
            "signature": signature.key(), "ledger": ledger(&certificate)?, "holds": wrong.is_empty(), "wrong": wrong, "run_again": again, "seed": seed, "same_build": same_tool,
            "may_go_on_the_rig": certificate.may_go_on_the_rig,
        });
        print(&result.to_string())?;
    } else {
        let mut lines = vec![match wrong.is_empty() {
            true => {
                "The certificate holds: every byte and every hash is as it was written.".to_owned()
            }
            false => "The certificate does NOT hold:".to_owned(),
        }];
        lines.extend(wrong.iter().map(|line| format!("  {line}")));
        lines.push(format!(
            "{again} of {} scenarios were run again, drawn by seed {seed}.",
            certificate.plan.scenarios
        ));
        if !same_tool {
            lines.push("It was made by another build of this program; the scenarios were run again with this one.".to_owned());
        }
        lines.extend(ledger(&certificate)?);
        if signature != Looked::DoesNotHold {
            lines.extend(signature.words().map(str::to_owned));
        }
        lines.push(match certificate.may_go_on_the_rig {
            true => "It says: may go on the rig.".to_owned(),
            false => "It says: must not go on the rig.".to_owned(),
        });
        print(&lines.join("\n"))?;
    }
    Ok(Outcome {
        checks_hold: wrong.is_empty(),
    })
}

/// What is to be said of a ledger that is not this program's.
fn ledger(certificate: &Certificate) -> Result<Option<String>, Failure> {
    Ok(match certificate.ledger()? {
        Ledger::Same | Ledger::Changed => None,
        Ledger::Other { known, claims } => Some(format!(
            "What it calls proved is of a ledger about other code than this program's: {known} of its {claims} claims are proved in this one's too, the others were not looked at."
        )),
    })
}

/// A seed that nobody knew before.
fn clock() -> u64 {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    since.map_or(1, |since| since.subsec_nanos().into())
}

/// The files beside a certificate that are not those it names.
fn changed_files(certificate: &Certificate, file: &Path) -> Vec<String> {
    let findings = certificate.findings.iter();
    let findings = findings.map(|named| (&named.file, &named.sha256));
    let worst = certificate.worst.iter();
    let all = findings.chain(worst.map(|named| (&named.file, &named.sha256)));
    let changed = all.filter(|(name, sha256)| {
        let bytes = std::fs::read(beside(file, name));
        !bytes.is_ok_and(|bytes| digest::of_bytes(&bytes) == **sha256)
    });
    changed
        .map(|(name, _)| format!("{name} is missing or was changed"))
        .collect()
}

fn beside(certificate: &Path, name: &str) -> PathBuf {
    certificate.parent().unwrap_or(Path::new("")).join(name)
}

/// The worst cases that do not come to what the certificate says when they are run again; those that were changed are said elsewhere.
fn otherwise(
    certificate: &Certificate,
    file: &Path,
    sources: &Sources<'_>,
) -> Result<Vec<String>, Failure> {
    let mut wrong = Vec::new();
    for named in &certificate.worst {
        let file = beside(file, &named.file);
        // What is missing is said elsewhere.
        let Ok(text) = read_text(&file) else { continue };
        let is_named = |worst: &Worst| {
            worst.target == named.target
                && worst.found == named.found
                && worst.controller == certificate.plan.controller
        };
        let holds = match Worst::parse(&text, &file) {
            Ok(worst) if is_named(&worst) => worst.replayed(sources.controller)?.is_same,
            _ => false,
        };
        if !holds {
            wrong.push(format!("{} comes out otherwise", named.file));
        }
    }
    Ok(wrong)
}

/// The findings whose law is not broken again as it was. Those of a controller that does not answer the same samples alike need not come again.
fn not_again(
    certificate: &Certificate,
    file: &Path,
    sources: &Sources<'_>,
) -> Result<Vec<String>, Failure> {
    let mut laws = certificate.laws.iter();
    let mut findings = certificate.findings.iter();
    if laws.any(|law| law.law == Law::Repeats && law.broken_in > 0)
        || findings.any(|named| named.law == Law::Repeats)
    {
        return Ok(Vec::new());
    }
    let mut wrong = Vec::new();
    for named in &certificate.findings {
        let file = beside(file, &named.file);
        // What is missing is said elsewhere.
        let Ok(text) = read_text(&file) else { continue };
        let holds = match Finding::parse(&text, &file) {
            Ok(found) if found.is(named)? && found.controller == certificate.plan.controller => {
                found.comes_again(sources.controller)?
            }
            _ => false,
        };
        if !holds {
            wrong.push(format!("{} comes out otherwise", named.file));
        }
    }
    Ok(wrong)
}
