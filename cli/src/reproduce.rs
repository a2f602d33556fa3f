//! This file runs what the thesis ran, and prints its numbers beside ours.

mod pages;

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use rigproof_experiments::{Experiment, Finding, Outcome as Left, Verdict, all, find};
use rigproof_trace::store::{Folder, write_aside};
use serde_json::{Value, json};

use crate::outcome::{Failure, Outcome, print};
use crate::text::{join, section};
use crate::{picture, progress, threads};

/// What is to be run again.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The experiments, by the number of their figure, or `all`; without one they are listed
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// The folder to write: for each experiment its tables (CSV) and pictures (SVG)
    #[arg(long, value_name = "FOLDER", default_value = "rigproof-reproduced")]
    out: PathBuf,
    /// Also write pages to look at in a browser: every statement and every picture; of several chapters an index, and a page for each beside it
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Experiments that run at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    jobs: usize,
    /// Print the findings as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Each statement of the text agrees with what comes out here, disagrees, or cannot be compared because its figure is lost.

Exit codes:
  0  run; a disagreement that an erratum or a gap of spec/thesis accounts for is no failure
  1  run, and a statement disagrees without an account
  2  the command line is wrong
  3  a file cannot be written

Examples:
  rigproof reproduce
  rigproof reproduce 3.3 3.5 --out brake
  rigproof reproduce all --html thesis.html";

/// One experiment and what it left behind.
struct Done {
    experiment: Experiment,
    left: Left,
}

/// Runs the experiments, writes the folder and prints the findings.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if args.ids.is_empty() {
        return list(args);
    }
    let experiments = chosen(&args.ids)?;
    // A wrong place is refused before the work, not after it.
    drop(Folder::begin(&args.out)?);
    let threads = threads::pool(args.jobs)?;
    let bar = progress::bar(experiments.len(), "experiments");
    let done = threads.install(|| {
        let one = |experiment: &Experiment| {
            let left = (experiment.run)()?;
            bar.inc(1);
            Ok(Done {
                experiment: *experiment,
                left,
            })
        };
        let experiments = experiments.par_iter().with_max_len(1);
        experiments.map(one).collect::<Result<Vec<Done>, Failure>>()
    })?;
    drop(bar);
    let files = write(&args.out, &done)?;
    if let Some(file) = &args.html {
        for (file, page) in pages::pages(file, &args.out, &done) {
            write_aside(&file, page.as_bytes())?;
        }
    }
    if args.json {
        print(&report(&done)?)?;
    } else {
        print(&text(&args.out, &files, &done))?;
    }
    let mut findings = done.iter().flat_map(|done| &done.left.findings);
    Ok(Outcome {
        checks_hold: !findings.any(Finding::is_unaccounted),
    })
}

fn list(args: &Args) -> Result<Outcome, Failure> {
    if args.json {
        let experiments = all();
        let experiments = experiments.iter().map(described);
        return print(&Value::from_iter(experiments).to_string());
    }
    let lines = all()
        .into_iter()
        .map(|e| format!("  {:<6} {}", e.id, e.title));
    print(&join([
        section("Experiments", lines),
        section("Next", ["  rigproof reproduce all".to_owned()]),
    ]))
}

fn chosen(ids: &[String]) -> Result<Vec<Experiment>, Failure> {
    if ids.iter().any(|id| id == "all") {
        return Ok(all());
    }
    let mut chosen: Vec<Experiment> = Vec::new();
    for id in ids {
        let Some(experiment) = find(id) else {
            let experiments = all();
            let known: Vec<&str> = experiments.iter().map(|e| e.id).chain(["all"]).collect();
            let advice = rigproof_trace::suggest::advice(id, "experiments", &known);
            return Err(Failure::Usage(format!("`{id}` is no experiment; {advice}")));
        };
        if !chosen.iter().any(|known| known.id == experiment.id) {
            chosen.push(experiment);
        }
    }
    Ok(chosen)
}

/// Writes the folder and gives the names of its files.
fn write(out: &Path, done: &[Done]) -> Result<Vec<String>, Failure> {
    let folder = Folder::begin(out)?;
    let mut files = Vec::new();
    let mut put = |name: String, bytes: &[u8]| -> Result<(), Failure> {
        folder.write(&name, bytes)?;
        files.push(name);
        Ok(())
    };
    for Done { experiment, left } in done {
        let id = experiment.id;
        for table in &left.tables {
            put(format!("{id}/{}.csv", table.name), &table.to_csv()?)?;
        }
        for drawn in &left.pictures {
            let svg = picture::figure(drawn);
            put(format!("{id}/{}.svg", drawn.name), svg.as_bytes())?;
        }
    }
    put(
        "findings.json".to_owned(),
        (report(done)? + "\n").as_bytes(),
    )?;
    folder.finish()?;
    Ok(files)
}

fn report(done: &[Done]) -> Result<String, Failure> {
    let experiments = done.iter().map(|Done { experiment, left }| {
        let mut entry = described(experiment);
        entry["findings"] = left.findings.iter().map(finding).collect();
        entry
    });
    serde_json::to_string_pretty(&Value::from_iter(experiments))
        .map_err(|error| Failure::Input(format!("cannot write the findings as JSON: {error}")))
}

fn described(experiment: &Experiment) -> Value {
    json!({ "id": experiment.id, "title": experiment.title, "what": experiment.what })
}

fn finding(finding: &Finding) -> Value {
    json!({
        "place": finding.place, "statement": finding.statement, "stated": finding.stated, "ours": finding.ours,
        "verdict": finding.verdict.name(), "because": finding.because, "account": finding.account,
    })
}

fn text(out: &Path, files: &[String], done: &[Done]) -> String {
    let sections = done.iter().map(|Done { experiment, left }| {
        let heading = format!("{}  {}", experiment.id, experiment.title);
        section(&heading, left.findings.iter().flat_map(lines))
    });
    let count = |verdict: Verdict| {
        let findings = done.iter().flat_map(|done| &done.left.findings);
        let count = findings.filter(|f| f.verdict == verdict).count();
        format!("{count} {}", plural(verdict, count))
    };
    let verdicts = [
        Verdict::Agrees,
        Verdict::Disagrees,
        Verdict::CannotBeCompared,
    ];
    let total = verdicts.map(count).join(", ");
    let written = format!("  {}: {} files", out.display(), files.len());
    join(sections.chain([
        section("Together", [format!("  {total}")]),
        section("Written", [written]),
    ]))
}

const fn plural(verdict: Verdict, count: usize) -> &'static str {
    match (verdict, count) {
        (_, 1) | (Verdict::CannotBeCompared, _) => verdict.name(),
        (Verdict::Agrees, _) => "agree",
        (Verdict::Disagrees, _) => "disagree",
    }
}

/// A finding in two lines: what is stated and what comes out, then what decided.
fn lines(finding: &Finding) -> [String; 2] {
    let account = finding.account.map(|id| format!(", `{id}`"));
    [
        format!(
            "  {:<18} {} {}: text {}; here {}",
            finding.verdict.name(),
            finding.place,
            finding.statement,
            finding.stated,
            finding.ours
        ),
        format!(
            "  {:<18} {}{}",
            "",
            finding.because,
            account.unwrap_or_default()
        ),
    ]
}
