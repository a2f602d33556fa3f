//! This file checks a certificate: every byte, every hash, and a sample of its scenarios run again.

use std::path::Path;

use rigproof_certify::campaign::CHUNK;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::digest;
use rigproof_certify::proved::Ledger;
use rigproof_trace::store::read_text;
use serde_json::json;

use super::compiled::sources;
use super::{Args, campaign};
use crate::outcome::{Failure, Outcome, print};

/// Checks, and says what was checked.
pub fn run(args: &Args, file: &Path) -> Result<Outcome, Failure> {
    let certificate = Certificate::parse(&read_text(file)?, file)?;
    let mut wrong = changed_findings(&certificate, file);
    let compiled = args.compiled.opened_again(&certificate.plan.controller)?;
    let sources = sources(&certificate.plan, compiled.as_ref())?;
    // Whoever wrote the certificate must not know what is run again.
    let seed = args.seed.unwrap_or_else(clock);
    let count = args.sample.div_ceil(CHUNK) as usize;
    let (drawn, differ) = certificate.again(&sources, count, seed)?;
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
            "ledger": ledger(&certificate)?, "holds": wrong.is_empty(), "wrong": wrong, "run_again": again, "seed": seed, "same_build": same_tool,
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

/// The findings beside a certificate that are not those it names.
fn changed_findings(certificate: &Certificate, file: &Path) -> Vec<String> {
    let beside = |name: &str| file.parent().unwrap_or(Path::new("")).join(name);
    let findings = certificate.findings.iter();
    let changed = findings.filter(|named| {
        let bytes = std::fs::read(beside(&named.file));
        !bytes.is_ok_and(|bytes| digest::of_bytes(&bytes) == named.sha256)
    });
    changed
        .map(|named| format!("{} is missing or was changed", named.file))
        .collect()
}
