//! This file shows the whole of it on a recording that the program makes: hide, diagnose, open the seal.

use std::path::{Path, PathBuf};

use rigproof_blind::{Plant, Stratum, make, open, score};
use rigproof_diagnose::{Description, Options, diagnose};
use rigproof_trace::rig::Rig;
use rigproof_trace::store::Folder;
use serde_json::json;

use crate::blind::{FILES, contents, in_words};
use crate::outcome::{Failure, Outcome, print};
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
            "A recording of a driven axis with hidden causes, {} samples. SHA-256 of the sealed answer:\n{}\n",
            case.trace.len(),
            case.commitment
        ))?;
    }
    let mark = progress::spinner("diagnosing");
    let diagnosis = diagnose(&rig, &[&recording], None, &Options::default());
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
        let paths = written
            .iter()
            .map(|name| format!("  {}", args.out.join(name).display()));
        print(&text::join([
            vec![text::report(&diagnosis.report)],
            vec![
                "The seal is opened.".to_owned(),
                in_words(&answer, &report, &score),
            ],
            text::section("Files", paths),
            text::section(
                "Look at it in a browser",
                [format!("  {}", args.out.join(folder::PAGE).display())],
            ),
        ]))?;
    }
    Ok(Outcome {
        checks_hold: score.exact && text::holds(&diagnosis.report),
    })
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
