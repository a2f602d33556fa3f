//! This file runs a campaign and writes its certificate.

use std::path::Path;

use ed25519_compact::KeyPair;
use rigproof_certify::calibration::Calibration;
use rigproof_certify::campaign;
use rigproof_certify::certificate::{Certificate, records};
use rigproof_certify::cluster;
use rigproof_certify::description::Description;
use rigproof_certify::digest;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal::{Chunks, FILE, Header};
use rigproof_certify::law::Law;
use rigproof_certify::plan::{FORM, Plan, Sources, Subject, least_met};
use rigproof_certify::search::{Met, Searched, Target, Worst, search};
use rigproof_certify::tool::Tool;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_trace::rig::five_bar::FiveBar;
use rigproof_trace::store::{read_text, write_aside};

use super::compiled::{Opened, sources};
use super::{Args, page, sign, words};
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::section;
use crate::threads;

/// The certificate's file.
pub const CERTIFICATE: &str = "certificate.json";

/// Runs what is not done yet; the certificate is written when the campaign is whole.
pub fn run(args: &Args, file: &Path, text: &str) -> Result<Outcome, Failure> {
    args.without_old()?;
    let description = Description::parse(text, file)?;
    let [_, parts] = args.shard;
    if parts > 1 && args.sign.is_some() {
        let problem = "a part has no certificate to sign: give --sign to `rigproof certify merge`";
        return Err(Failure::Usage(problem.to_owned()));
    }
    let keys = args.sign.as_deref().map(sign::secret).transpose()?;
    let compiled = args.compiled.opened()?;
    let plan = plan(args, file, &description, compiled.as_ref())?;
    let sources = sources(&plan, compiled.as_ref())?;
    let threads = threads::pool(args.jobs)?;
    let total: u64 = campaign::chunks(&plan, args.shard)
        .map(|chunk| campaign::indices(&plan, chunk).count() as u64)
        .sum();
    let bar = progress::bar(total as usize, "scenarios");
    let header = Header {
        plan: plan.clone(),
        shard: args.shard,
        tool: tool()?,
    };
    let chunks =
        threads.install(|| campaign::run(&header, &sources, &args.out, &|done| bar.inc(done)))?;
    drop(bar);
    let [part, parts] = args.shard;
    if parts > 1 {
        if let Some(between) = between(compiled.as_ref()) {
            return between_trials(&between, &args.out);
        }
        return print(&format!(
            "Part {} of {parts} is done: {total} scenarios. When all parts are, join their folders with `rigproof certify merge`.",
            part + 1
        ));
    }
    let written = Written {
        folder: &args.out,
        library: args.compiled.library(),
        compiled: compiled.as_ref(),
        keys,
        as_json: args.json,
    };
    threads.install(|| finish(&plan, &sources, &chunks, &written))
}

/// What went wrong between trials, if anything did, all that ran the controller being done.
fn between(compiled: Option<&Opened>) -> Option<Vec<String>> {
    let between = compiled.map(Opened::ended);
    between.filter(|between| !between.is_empty())
}

/// What no law sees must not be certified by going on from the journal either.
pub fn between_trials(what: &[String], folder: &Path) -> Result<Outcome, Failure> {
    let journal = folder.join(FILE);
    take_away(&journal)?;
    campaign::withdraw(folder)?;
    let lines = section(
        "Must NOT go on the rig: it failed between trials, where no law looks",
        what.iter().map(|line| format!("  {line}")),
    );
    let end = "No certificate is written, and no journal is kept: nothing goes on from it.";
    print(&format!("{}\n{end}", lines.join("\n")))?;
    Ok(Outcome { checks_hold: false })
}

fn plan(
    args: &Args,
    file: &Path,
    description: &Description,
    compiled: Option<&Opened>,
) -> Result<Plan, Failure> {
    let controller = match (description.controller, compiled) {
        (Some(law), None) => Subject::beside(law, description.reference_every),
        (None, Some(own)) => own.subject(description.declares),
        (Some(_), Some(_)) => {
            return Err(Failure::Input(
                "two controllers are named: take the table [controller] away, or --controller; a law of the rig may stand in [baseline]"
                    .to_owned(),
            ));
        }
        (None, None) => {
            return Err(Failure::Input(
                "nothing is to be certified: add a table [controller] with `kind` or `named`, or --controller"
                    .to_owned(),
            ));
        }
    };
    let calibration = args.calibration.as_deref().map(calibration).transpose()?;
    let mut rigs = description.rigs.clone();
    if let Some(calibration) = &calibration {
        rigs.retain(|rig| *rig == calibration.rig);
    }
    if rigs.is_empty() {
        let problem = "its `layout` is not the calibration's: take `layout` away, or --calibration";
        return Err(Failure::unusable(file, problem.to_owned()));
    }
    Ok(Plan {
        form: FORM,
        name: description.name.clone(),
        controller,
        baseline: description.baseline.map(Subject::built_in),
        rigs,
        seed: args.seed.unwrap_or(1),
        scenarios: args.scenarios,
        ticks: libm::round(args.seconds / SAMPLE_STEP_S) as u32,
        calibration,
        search: args.search,
        limits: description.limits,
        regressions: description.regressions,
        least_met: description
            .least_met
            .unwrap_or_else(|| least_met(args.scenarios)),
        requirements: description.requirements.clone(),
    })
}

/// A calibration as the plant of scenarios.
fn calibration(file: &Path) -> Result<Calibration, Failure> {
    let text = read_text(file)?;
    if !FiveBar::describes(&text, file)? {
        let problem = "it is no calibration of a five-bar (`plant = \"rig\"`): hand over the calibration.toml that `rigproof diagnose` wrote for one";
        return Err(Failure::unusable(file, problem.to_owned()));
    }
    let rig = FiveBar::parse(&text, file)?;
    let name = file.file_name().unwrap_or(file.as_os_str());
    let sha256 = digest::of_bytes(text.as_bytes());
    Calibration::of(&rig, name.to_string_lossy().into_owned(), sha256)
        .map_err(|problem| Failure::unusable(file, problem))
}

/// What is written, and how it is said.
pub struct Written<'a> {
    /// The folder.
    pub folder: &'a Path,
    /// The compiled controller's library, if it is one.
    pub library: Option<&'a Path>,
    /// The compiled controller itself.
    pub compiled: Option<&'a Opened>,
    /// The key that the certificate is signed with.
    pub keys: Option<KeyPair>,
    /// Whether the certificate is printed as JSON.
    pub as_json: bool,
}

/// Shrinks what broke a law, searches for worse, and writes certificate, findings and worst cases.
pub fn finish(
    plan: &Plan,
    sources: &Sources<'_>,
    chunks: &Chunks,
    written: &Written<'_>,
) -> Result<Outcome, Failure> {
    let folder = written.folder;
    let searched = searched(plan, sources, chunks, folder)?;
    let found = findings(plan, sources, chunks, &searched.met, folder)?;
    let named = found.iter().map(Finding::named);
    let named = named.collect::<Result<_, _>>()?;
    let worst = searched.worst.iter().map(Worst::named);
    let worst = worst.collect::<Result<_, _>>()?;
    let run = page::worst(plan, sources, chunks, found.first())?;
    let certificate = Certificate::new(plan, chunks, named, worst, tool()?)?;
    let certificate = with_examples(certificate, plan, sources, folder)?;
    // Shrinking and searching run the controller too.
    if let Some(between) = between(written.compiled) {
        return between_trials(&between, folder);
    }
    let (file, text) = (folder.join(CERTIFICATE), certificate.to_json()?);
    campaign::withdraw(folder)?;
    write_aside(&file, text.as_bytes())?;
    let page = page::html(&certificate, run.as_ref(), folder, written.library);
    write_aside(&folder.join("certificate.html"), page.as_bytes())?;
    if let Some(keys) = &written.keys {
        sign::write(keys, &file, text.as_bytes())?;
    }
    if written.as_json {
        print(text.trim_end())?;
    } else {
        print(&words::certificate(&certificate, folder, written.library))?;
    }
    Ok(Outcome {
        checks_hold: certificate.may_go(),
    })
}

/// Searches for a worse case of every law and metric, and writes what was found.
fn searched(
    plan: &Plan,
    sources: &Sources<'_>,
    chunks: &Chunks,
    folder: &Path,
) -> Result<Searched, Failure> {
    let spinner = progress::spinner("searching for worse");
    let found = search(plan, sources.controller, &records(chunks))?;
    drop(spinner);
    for target in Target::all() {
        let file = folder.join(Worst::file_of(target));
        match found.worst.iter().find(|worst| worst.target == target) {
            Some(worst) => write_aside(&file, worst.to_json()?.as_bytes())?,
            None => take_away(&file)?,
        }
    }
    Ok(found)
}

/// Shrinks what broke a law, drawn or met by the search, and writes it with its recording.
fn findings(
    plan: &Plan,
    sources: &Sources<'_>,
    chunks: &Chunks,
    met: &[Met],
    folder: &Path,
) -> Result<Vec<Finding>, Failure> {
    let spinner = progress::spinner("shrinking what was found");
    let found = Finding::all(plan, sources.controller, &records(chunks), met)?;
    for law in Law::ALL {
        let stem = Finding::stem_of(law);
        let [json, mcap] = ["json", "mcap"].map(|ending| folder.join(format!("{stem}.{ending}")));
        match found.iter().find(|found| found.law == law) {
            Some(own) => {
                write_aside(&json, own.to_json()?.as_bytes())?;
                write_aside(&mcap, &own.to_mcap(sources.controller)?)?;
            }
            None => {
                take_away(&json)?;
                take_away(&mcap)?;
            }
        }
    }
    drop(spinner);
    Ok(found)
}

/// Shrinks and writes an example of every cluster of failures.
fn with_examples(
    certificate: Certificate,
    plan: &Plan,
    sources: &Sources<'_>,
    folder: &Path,
) -> Result<Certificate, Failure> {
    let examples = cluster::examples(plan, sources.controller, &certificate.clusters)?;
    for number in 1..=cluster::MOST {
        let file = folder.join(cluster::stem_of(number) + ".json");
        match examples.get(number - 1) {
            Some(Some(own)) => write_aside(&file, own.to_json()?.as_bytes())?,
            _ => take_away(&file)?,
        }
    }
    Ok(certificate.with_examples(cluster::named(&examples)?)?)
}

/// Takes away what an earlier campaign left: it is none of this one's.
fn take_away(file: &Path) -> Result<(), Failure> {
    match std::fs::remove_file(file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(Failure::unusable(file, error.to_string()))
        }
        _ => Ok(()),
    }
}

/// This program, by the hash of its file.
pub fn tool() -> Result<Tool, Failure> {
    let unreadable = |error: std::io::Error| {
        Failure::Input(format!("the program's own file cannot be read: {error}"))
    };
    let own = std::env::current_exe().map_err(unreadable)?;
    Ok(Tool {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        sha256: digest::of_bytes(&std::fs::read(own).map_err(unreadable)?),
    })
}
