//! This file checks a certificate: every byte, every hash, every figure that can be built anew, and a sample of its scenarios or all of them run again.

use std::path::{Path, PathBuf};

use rigproof_certify::certificate::Certificate;
use rigproof_certify::digest;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal::{self, Chunks, FILE};
use rigproof_certify::law::Law;
use rigproof_certify::plan::Sources;
use rigproof_certify::proved::Ledger;
use rigproof_certify::recheck::{Checked, Means, recheck};
use rigproof_certify::search::Worst;
use rigproof_trace::store::read_text;
use serde_json::json;

use super::compiled::{Compiled, sources};
use super::sign::{self, Looked};
use super::{Args, axis, campaign};
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::significant;
use crate::threads;

/// Scenarios that are run again where no number is given.
const SAMPLE: u64 = 64;

/// Checks, and says what was checked.
pub fn run(args: &Args, file: &Path) -> Result<Outcome, Failure> {
    let threads = threads::pool(args.jobs)?;
    let text = read_text(file)?;
    if axis::is_certificate(&text) {
        return axis::check::run(args, file, &text);
    }
    args.without_old()?;
    let signature = sign::looked_at(file, text.as_bytes(), args.public_key.as_deref())?;
    // Whoever wrote the certificate must not know what is run again.
    let seed = args.seed.map_or_else(unforeseen, Ok)?;
    let compiled = &args.compiled;
    let (certificate, mut checked) = threads
        .install(|| looked_through(&text, file, compiled, args.sample.unwrap_or(SAMPLE), seed))?;
    if signature == Looked::DoesNotHold {
        checked.wrong.extend(signature.words().map(str::to_owned));
    }
    let same_tool = campaign::tool()?.sha256 == certificate.tool.sha256;
    if args.json {
        let result = json!({
            "signature": signature.key(), "ledger": ledger(&certificate)?, "holds": checked.wrong.is_empty(), "wrong": checked.wrong,
            "run_again": checked.again, "seed": seed, "same_build": same_tool, "is_proof": checked.is_proof, "is_rebuilt": checked.is_rebuilt,
            "share": checked.share, "may_go_on_the_rig": checked.may_go(&certificate),
        });
        print(&result.to_string())?;
    } else {
        let mut lines = said(&certificate, &checked, seed);
        if !same_tool {
            lines.push("It was made by another build of this program; the scenarios were run again with this one.".to_owned());
        }
        lines.extend(ledger(&certificate)?);
        if signature != Looked::DoesNotHold {
            lines.extend(signature.words().map(str::to_owned));
        }
        lines.push(match (checked.wrong.is_empty(), certificate.may_go()) {
            (true, true) => "By its figures it may go on the rig.".to_owned(),
            (true, false) => "By its figures it must not go on the rig.".to_owned(),
            (false, _) => "Nothing follows from it: it must not go on the rig.".to_owned(),
        });
        print(&lines.join("\n"))?;
    }
    Ok(Outcome {
        checks_hold: checked.wrong.is_empty(),
    })
}

/// What a check came to, and whether it was a proof or a sample.
fn said(certificate: &Certificate, checked: &Checked, seed: u64) -> Vec<String> {
    let scenarios = certificate.plan.scenarios;
    let mut lines = vec![match checked.wrong.is_empty() {
        true => "The certificate holds: nothing that was looked at disagrees with it.".to_owned(),
        false => "The certificate does NOT hold:".to_owned(),
    }];
    lines.extend(checked.wrong.iter().map(|line| format!("  {line}")));
    let again = checked.again;
    if checked.is_proof {
        lines.push(format!("A proof of what its trials say: all {scenarios} scenarios were run again, and every figure, finding and worse case was built anew from them."));
        return lines;
    }
    let share = significant(100.0 * checked.share, 3);
    lines.push(format!("A sample, no proof: {again} of {scenarios} scenarios were run again, drawn by seed {seed}. Of records forged in one chunk of scenarios that sees {share} %; --sample {scenarios} runs all."));
    lines.push(match checked.is_rebuilt {
        true => "Every figure was built anew from the records that stand beside it; the search was not run again.".to_owned(),
        false => "No records stand beside it: its figures were held to what the sample alone allows.".to_owned(),
    });
    lines
}

/// Looks through a certificate with the files beside it, and runs so many of its scenarios again.
///
/// # Errors
/// It is no certificate any more, or cannot be run.
pub fn looked_through(
    text: &str,
    file: &Path,
    compiled: &Compiled,
    sample: u64,
    seed: u64,
) -> Result<(Certificate, Checked), Failure> {
    let certificate = Certificate::parse(text, file)?;
    let tool = campaign::tool()?;
    let (kept, mut wrong) = kept(&certificate, file)?;
    wrong.extend(changed_files(&certificate, file));
    let is_own = certificate.tool.sha256 == tool.sha256;
    if is_own && (certificate.tool != tool || certificate.ledger()? != Ledger::Same) {
        let problem = "it names this build of the program with another version or another ledger";
        wrong.push(problem.to_owned());
    }
    let compiled = compiled.opened_again(&certificate.plan.controller)?;
    let sources = sources(&certificate.plan, compiled.as_ref())?;
    let means = Means {
        sources,
        kept: kept.as_ref(),
        sample,
        seed,
    };
    let mut checked = recheck(&certificate, &means)?;
    wrong.extend(otherwise(&certificate, file, &sources)?);
    wrong.extend(not_again(&certificate, file, &sources)?);
    wrong.append(&mut checked.wrong);
    if let Some(compiled) = &compiled {
        let between = compiled.ended();
        let between = between.iter();
        wrong.extend(between.map(|what| format!("it failed between trials: {what}")));
    }
    checked.wrong = wrong;
    Ok((certificate, checked))
}

/// The records beside a certificate, if there are any, and what is wrong with them.
fn kept(certificate: &Certificate, file: &Path) -> Result<(Option<Chunks>, Vec<String>), Failure> {
    let folder = file.parent().unwrap_or(Path::new(""));
    if !folder.join(FILE).exists() {
        return Ok((None, Vec::new()));
    }
    let (header, chunks) = match journal::read(folder) {
        Ok(read) => read,
        Err(error) => return Ok((None, vec![error.to_string()])),
    };
    let is_own = header.plan == certificate.plan
        && header.shard == [0, 1]
        && header.tool == certificate.tool;
    match is_own {
        true => Ok((Some(chunks), Vec::new())),
        false => {
            let problem = format!("{FILE} beside it is of another campaign");
            Ok((None, vec![problem]))
        }
    }
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
///
/// # Errors
/// The system gives no random numbers.
pub fn unforeseen() -> Result<u64, Failure> {
    getrandom::u64()
        .map_err(|error| Failure::Input(format!("the system gives no random numbers: {error}")))
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
