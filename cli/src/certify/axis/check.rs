//! This file checks the certificate of an axis: every byte, and every figure by running all of its trials again.

use std::path::Path;

use rigproof_certify::axis::campaign::records;
use rigproof_certify::axis::certificate::Certificate;
use rigproof_certify::axis::plan::Library;
use serde_json::json;

use super::super::compiled::{Compiled, Opened, opened};
use super::super::sign::{self, Looked};
use super::super::{Args, campaign};
use super::{ended, sources};
use crate::outcome::{Failure, Outcome, print};
use crate::threads;

/// Checks, and says what was checked.
pub fn run(args: &Args, file: &Path, text: &str) -> Result<Outcome, Failure> {
    if args.sample.is_some() {
        let problem =
            "the certificate of an axis is checked by all of its trials: leave --sample away";
        return Err(Failure::Usage(problem.to_owned()));
    }
    let threads = threads::pool(args.jobs)?;
    let signature = sign::looked_at(file, text.as_bytes(), args.public_key.as_deref())?;
    let looked =
        threads.install(|| looked_through(text, file, &args.compiled, args.old.as_deref()));
    let (certificate, mut wrong) = looked?;
    if signature == Looked::DoesNotHold {
        wrong.extend(signature.words().map(str::to_owned));
    }
    let holds = wrong.is_empty();
    let may_go = holds && certificate.may_go();
    let same_build = campaign::tool()?.sha256 == certificate.tool.sha256;
    if args.json {
        let result = json!({
            "signature": signature.key(), "holds": holds, "wrong": wrong, "run_again": certificate.plan.scenarios,
            "same_build": same_build, "is_proof": true, "is_rebuilt": true, "share": 1.0, "may_go_on_the_rig": may_go,
        });
        print(&result.to_string())?;
    } else {
        let said = said(&certificate, &wrong, same_build, signature);
        print(&said.join("\n"))?;
    }
    Ok(Outcome { checks_hold: holds })
}

fn said(
    certificate: &Certificate,
    wrong: &[String],
    same_build: bool,
    signature: Looked,
) -> Vec<String> {
    let mut lines = vec![match wrong.is_empty() {
        true => "The certificate holds: nothing that was looked at disagrees with it.".to_owned(),
        false => "The certificate does NOT hold:".to_owned(),
    }];
    lines.extend(wrong.iter().map(|line| format!("  {line}")));
    lines.push(format!(
        "A proof of what its trials say: all {} were run again, and every figure and the verdict were built anew from them.",
        certificate.plan.scenarios
    ));
    if !same_build {
        lines.push("It was made by another build of this program; the trials were run again with this one.".to_owned());
    }
    if signature != Looked::DoesNotHold {
        lines.extend(signature.words().map(str::to_owned));
    }
    let verdict = match (wrong.is_empty(), certificate.may_go()) {
        (true, true) => "By its figures it may go on the rig.",
        (true, false) => "By its figures it must not go on the rig.",
        (false, _) => "Nothing follows from it: it must not go on the rig.",
    };
    lines.push(verdict.to_owned());
    lines
}

/// The certificate, and what disagrees with it when all of its trials are run again.
///
/// # Errors
/// It is no certificate any more, or a library is not at hand.
pub fn looked_through(
    text: &str,
    file: &Path,
    compiled: &Compiled,
    old: Option<&Path>,
) -> Result<(Certificate, Vec<String>), Failure> {
    let certificate = Certificate::parse(text, file)?;
    compiled.without_limits()?;
    let plan = &certificate.plan;
    let controller = again(&plan.controller, compiled.library(), "--controller")?;
    let baseline = plan.baseline.as_ref();
    let baseline = baseline.map(|own| again(own, old, "--old")).transpose()?;
    let sources = sources(&controller, baseline.as_ref());
    let records = records(plan, &sources, &|| {});
    let mut wrong = certificate.unlike(&records)?;
    let between = ended(&[Some(&controller), baseline.as_ref()]);
    let between = between.iter();
    wrong.extend(between.map(|what| format!("it failed between trials: {what}")));
    Ok((certificate, wrong))
}

/// A library of a plan, opened again with the limits that it had.
fn again(library: &Library, file: Option<&Path>, option: &str) -> Result<Opened, Failure> {
    let Some(file) = file else {
        return Err(Failure::Usage(format!(
            "this is about the compiled controller {}: name it with {option}",
            library.name
        )));
    };
    let own = opened(file, library.process)?;
    let (is, was) = (own.source().sha256(), &library.sha256);
    match is == was {
        true => Ok(own),
        false => Err(Failure::Input(format!(
            "{} is another controller: its SHA-256 is {is}, that of {} was {was}",
            file.display(),
            library.name
        ))),
    }
}
