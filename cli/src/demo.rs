//! This file shows the whole of it on a recording that the program makes: hide, diagnose, open the seal.

use std::path::{Path, PathBuf};

use rigproof_blind::{Answer, Plant, Score, Stratum, make, open, score};
use rigproof_diagnose::report::Report;
use rigproof_diagnose::{Description, Options, diagnose};
use rigproof_trace::rig::Rig;
use rigproof_trace::store::Folder;
use serde_json::json;

use crate::blind::{FILES, contents, in_words, truth};
use crate::outcome::{Failure, Outcome, print, print_steadied, steady};
use crate::text::summary::{Style, summary};
use crate::{folder, input, page, progress, shell, text};

/// What is to be shown.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder to write
    #[arg(long, value_name = "FOLDER", default_value = "rigproof-demo")]
    out: PathBuf,
    /// Print the report, the answer and the score as JSON
    #[arg(long)]
    json: bool,
    /// Print the whole report, the whole answer and the score
    #[arg(long, conflicts_with = "json")]
    verbose: bool,
}

const AFTER_HELP: &str = "\
Nothing but a seed is built in: the recording, its rig and the sealed answer are made anew.
Exit code 1 says that the hidden cause was not named, or that the held-out part did not improve.

Example:
  rigproof demo --out rigproof-demo";

/// A case whose two hidden effects look like less of each other.
const SEED: u64 = 48;
const PLANT: Plant = Plant::Axis;
const STRATUM: Stratum = Stratum::Masked;

/// Makes the recording, diagnoses it, and opens the seal.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let folder = Folder::begin(&args.out)?;
    let case = make(PLANT, SEED, Some(STRATUM))?;
    let [recording_name, rig_name, _] = FILES;
    let rig = Rig::parse(&case.rig_toml, Path::new(rig_name))?;
    let recording = rig.apply(&case.trace, Path::new(recording_name))?;
    if !args.json {
        print(&format!(
            "A recording of a driven axis with hidden causes, {} samples: {}\nSHA-256 of the sealed answer: {}\n",
            case.trace.len(),
            args.out.join(recording_name).display(),
            case.commitment
        ))?;
    }
    let (mark, watch) = progress::stages();
    let options = Options {
        watch,
        ..Options::default()
    };
    let diagnosis = diagnose(&rig, &[&recording], None, &options);
    let mut diagnosis = diagnosis.map(Description::Joint);
    drop(mark);
    let contents = contents(&case)?;
    let files = FILES.iter().zip(&contents);
    diagnosis.report.inputs = files
        .clone()
        .take(2)
        .map(|(name, bytes)| input::identity_of(name, bytes))
        .collect();
    for (name, bytes) in files {
        folder.write(name, bytes)?;
    }
    let mut written: Vec<&str> = FILES.to_vec();
    let beside = page::Beside {
        next: Some(next(&args.out)),
        ..page::Beside::default()
    };
    written.extend(folder::write(&folder, &rig.name, &mut diagnosis, beside)?);
    folder.finish()?;

    let report = serde_json::to_value(&diagnosis.report)
        .map_err(|error| Failure::Input(format!("cannot write the report as JSON: {error}")))?;
    let answer = open(&case.sealed)?;
    let score = score(&answer, &report)?;
    if args.json {
        let result = json!({
            "commitment": case.commitment, "report": report, "answer": answer, "score": score,
        });
        print(&result.to_string())?;
    } else {
        let said = match args.verbose {
            true => at_length(
                args,
                &diagnosis.report,
                in_words(&answer, &report, &score),
                &written,
            ),
            false => in_short(args, &diagnosis.report, &opened(&answer, &score)),
        };
        print_steadied(&said)?;
    }
    Ok(Outcome {
        checks_hold: score.exact && text::holds(&diagnosis.report),
    })
}

/// The whole report, the whole answer, and the files.
fn at_length(args: &Args, report: &Report, opened: String, written: &[&str]) -> String {
    let paths = written
        .iter()
        .map(|name| format!("  {}", args.out.join(name).display()));
    steady(&text::join([
        vec![text::report(report)],
        vec!["The seal is opened.".to_owned(), opened],
        text::section("Files", paths),
    ]))
}

/// The summary, marked for a terminal, and the answer.
fn in_short(args: &Args, report: &Report, opened: &[String]) -> String {
    let page = args.out.join(folder::PAGE);
    let found = steady(&summary(report, &next(&args.out), &page));
    let headed = Style::of_output().headed(&found, report.verdict);
    format!("{headed}\n\n{}", steady(&opened.join("\n")))
}

/// What was hidden, and how the diagnosis did.
fn opened(answer: &Answer, score: &Score) -> Vec<String> {
    let mut lines = vec!["The seal is opened. Hidden were:".to_owned()];
    lines.extend(truth(answer));
    let names = match score.exact {
        true => "Every name is right, and nothing else is named",
        false => "The names are not the hidden ones",
    };
    let of = score.parameters.iter().filter_map(|own| own.covered);
    let covered = of.clone().filter(|covered| *covered).count();
    lines.push(format!(
        "{names}; {covered} of {} intervals hold the hidden number.",
        of.count()
    ));
    lines
}

/// The command that shows what the calibration is worth.
fn next(out: &Path) -> String {
    let [recording, rig, _] = FILES;
    let at = |name: &str| out.join(name);
    shell::line(
        &["rigproof", "simulate"],
        &[
            ("", &at(recording)),
            ("--rig", &at(rig)),
            ("--calibration", &at(folder::CALIBRATION)),
        ],
    )
}
