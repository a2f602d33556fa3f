//! This file makes a recording with a hidden cause.

use std::path::PathBuf;

use rigproof_blind::{Case, Forms, Plant, Stratum, make_in, under};
use rigproof_trace::csv;
use rigproof_trace::store::Folder;
use serde_json::json;

use super::{parse_forms, parse_plant, parse_stratum};
use crate::keep;
use crate::outcome::{Failure, Outcome, print};
use crate::shell;

/// What is to be made.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The plant: axis (command in, position out), bench (motion in, force or torque out), rig (the five-bar) or chain (a serial arm)
    #[arg(long, value_parser = parse_plant)]
    plant: Plant,
    /// The seed that everything follows from
    #[arg(long)]
    seed: u64,
    /// The kind of case; drawn from the seed if it is not given
    #[arg(long, value_parser = parse_stratum)]
    stratum: Option<Stratum>,
    /// The forms of what is hidden: usual (the textbook's) or other (the same physics in other forms, in a laboratory whose numbers are partly known)
    #[arg(long, value_parser = parse_forms, default_value = "usual")]
    forms: Forms,
    /// An experiment that `diagnose` asks for, its next-experiment.csv, to be done on the rig of the seed: recording.csv is its recording; only with --plant rig
    #[arg(long, value_name = "FILE")]
    experiment: Option<PathBuf>,
    /// The folder to write
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
The strata: nothing, single, masked, late_onset, too_small, not_in_library, data_fault; on the rig also noisy,
in_loop, unidentifiable, wrong_inertia.
With --plant chain, and with --forms other: nothing, single, two, three, late_onset, not_in_library.
The folder holds recording.csv, rig.toml and answer.sealed.

Example:
  rigproof blind make --plant bench --seed 41 --stratum single --out case";

/// The files of a case.
pub const FILES: [&str; 3] = ["recording.csv", "rig.toml", "answer.sealed"];

/// The contents of [`FILES`], in that order.
///
/// # Errors
/// The recording cannot be written as CSV.
pub fn contents(case: &Case) -> Result<[Vec<u8>; 3], Failure> {
    let recording = csv::to_bytes(&case.trace).map_err(Failure::Input)?;
    let rig = case.rig_toml.clone().into_bytes();
    Ok([recording, rig, case.sealed.clone().into_bytes()])
}

/// Makes a case, prints its commitment and writes the folder.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if args.experiment.is_some() && args.plant != Plant::Rig {
        let problem = "--experiment does an experiment on the five-bar: add --plant rig";
        return Err(Failure::Usage(problem.to_owned()));
    }
    if args.experiment.is_some() && args.forms == Forms::Other {
        let problem = "--experiment does an experiment on a rig with the usual forms: leave out --forms other";
        return Err(Failure::Usage(problem.to_owned()));
    }
    keep::check(&args.out, &args.experiment)?;
    let asked = args.experiment.as_deref().map(csv::read).transpose()?;
    let folder = Folder::begin(&args.out)?;
    let case = match &asked {
        Some(experiment) => under(args.seed, args.stratum, experiment)?,
        None => make_in(args.forms, args.plant, args.seed, args.stratum)?,
    };
    if !args.json {
        print(&format!(
            "SHA-256 of the sealed answer: {}",
            case.commitment
        ))?;
    }
    for (name, bytes) in FILES.into_iter().zip(contents(&case)?) {
        folder.write(name, &bytes)?;
    }
    folder.finish()?;
    let paths = FILES.map(|name| args.out.join(name));
    let [recording, rig, answer] = &paths;
    if args.json {
        let files = paths.each_ref().map(|path| path.display().to_string());
        let result = json!({
            "plant": args.plant.name(), "seed": args.seed, "commitment": case.commitment, "files": files,
        });
        return print(&result.to_string());
    }
    let samples = case.trace.len();
    let lines = paths.iter().map(|path| format!("  {}", path.display()));
    let lines: Vec<String> = lines.collect();
    let found = args.out.with_file_name("found");
    let diagnose = shell::line(
        &["rigproof", "diagnose"],
        &[("", recording), ("--rig", rig), ("--out", &found)],
    );
    let report = found.join(crate::folder::REPORT);
    let score = shell::line(
        &["rigproof", "blind", "score"],
        &[("", answer), ("", &report)],
    );
    print(&format!(
        "{samples} samples\nFiles\n{}\nNext\n  {diagnose}\n  {score}",
        lines.join("\n")
    ))
}
