//! This file turns bench recordings of a brake into a brake table in the rig file (§3.4).

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use rigproof_diagnose::identify::{Identified, identify};
use rigproof_trace::TraceError;
use rigproof_trace::rig::{Brake, Recording, Rig};
use rigproof_trace::store::write_aside;

use super::words;
use crate::input::HowRead;
use crate::outcome::{Failure, Outcome, print};
use crate::reading::RigReading;
use crate::text::{join, section};
use crate::{input, keep, progress, shell};

/// What is to be identified.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The recordings, CSV or MCAP: steps of current at constant speeds, and motion that reverses at constant current
    #[arg(required = true)]
    recordings: Vec<PathBuf>,
    /// The rig description: a turning bench with position, torque and current
    #[arg(long, value_name = "TOML")]
    rig: PathBuf,
    /// The rig file to write, with the brake's table [default: the rig's name with `-brake`]
    #[arg(long, value_name = "TOML")]
    out: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: RigReading,
}

const AFTER_HELP: &str = "\
What to record: at eight speeds from 0.5 to 64 rpm, three steps each between no current and 0.1, 0.2, 0.4, 0.6, 0.8 and
1 A, every current held for five time constants; and a few reversals of more than 6 degrees at 0.5 A and at 1 A.

Exit codes:
  0  every part of the table is identified
  1  some part is not; it is said what to record for it
  2  the command line is wrong
  3  an input is not usable, or a file cannot be written

Example:
  rigproof identify brake steps-0.5-rpm.csv steps-4-rpm.csv sine.csv --rig bench.toml --out brake.toml";

/// Identifies, writes the rig file and prints the table.
pub fn run<'a>(args: &'a Args) -> Result<Outcome, Failure> {
    let out = out(args)?;
    keep::check(&out, args.recordings.iter().chain([&args.rig]))?;
    once_each(&args.recordings)?;
    let rig = Rig::read(&args.rig)?;
    let mut read_as: Vec<(&PathBuf, HowRead)> = Vec::new();
    let read = |file: &'a PathBuf| -> Result<(String, Recording), Failure> {
        let (recording, how) = input::whole(&rig, file, &args.reading)?;
        read_as.push((file, how));
        Ok((file.display().to_string(), recording))
    };
    let recordings = args.recordings.iter().map(read);
    let recordings = recordings.collect::<Result<Vec<_>, _>>()?;
    let mark = progress::spinner("identifying");
    let found = identify(&recordings).map_err(|error| Failure::Input(error.to_string()))?;
    drop(mark);
    let written = with_brake(&rig, &found, &recordings);
    // What reads back is what the model accepts.
    let written = Rig::parse(&written.to_toml(), &out).map_err(|error| refusal(&error));
    let file = match &written {
        Ok(rig) => {
            write_aside(&out, rig.to_toml().as_bytes())?;
            Some(out.as_path())
        }
        Err(_) => None,
    };
    let refused = written.as_ref().err().map(String::as_str);
    if args.json {
        let mut result = words::json(&found, file, refused);
        result["read_as"] = read_as.iter().map(|(_, how)| how.json()).collect();
        print(&result.to_string())?;
    } else {
        let said = read_as.iter().flat_map(|(file, how)| how.lines(file));
        let said = said.map(|line| format!("  {line}"));
        let next = file.map(|file| next(args, file));
        print(&join(
            words::sections(&found, recordings.len())
                .into_iter()
                .chain([
                    section("Recordings", said),
                    section("No rig file was written", refused.map(|r| format!("  {r}"))),
                    section("Files", file.map(|file| format!("  {}", file.display()))),
                    section("Next", next.map(|next| format!("  {next}"))),
                ]),
        ))?;
    }
    Ok(Outcome {
        checks_hold: found.missing.is_empty() && file.is_some(),
    })
}

/// Refuses a recording that is given twice: it would count as two, and make the intervals too narrow.
fn once_each(recordings: &[PathBuf]) -> Result<(), Failure> {
    let mut seen = BTreeSet::new();
    for file in recordings {
        if !seen.insert(file.canonicalize().unwrap_or_else(|_| file.clone())) {
            let problem = "it is given twice; give each recording once".to_owned();
            return Err(Failure::unusable(file, problem));
        }
    }
    Ok(())
}

/// The rig with the parts that were found; those that were not stay as they were.
fn with_brake(rig: &Rig, found: &Identified, recordings: &[(String, Recording)]) -> Rig {
    let before = rig.brake.clone().unwrap_or_default();
    let now = found.brake.clone();
    let mut rig = rig.clone();
    rig.brake = Some(Brake {
        joint: before.joint,
        backlash_width: now.backlash_width.or(before.backlash_width),
        torque_gain: now.torque_gain.or(before.torque_gain),
        rising: now.rising.or(before.rising),
        falling: now.falling.or(before.falling),
    });
    let names: Vec<&str> = recordings.iter().map(|(name, _)| name.as_str()).collect();
    rig.provenance.insert(
        "brake".to_owned(),
        format!(
            "identified from {} steps and {} reversals of {}",
            found.steps.len(),
            found.reversals.len(),
            names.join(", ")
        ),
    );
    rig
}

/// Why the table is none that a rig can have, without the place in a file that was not written.
fn refusal(error: &TraceError) -> String {
    match error {
        TraceError::Rig { problem, .. } => problem.clone(),
        error => error.to_string(),
    }
}

fn next(args: &Args, file: &Path) -> String {
    let recording = args
        .recordings
        .first()
        .map_or(Path::new(""), PathBuf::as_path);
    shell::line(
        &["rigproof", "diagnose"],
        &[("", recording), ("--rig", file)],
    )
}

fn out(args: &Args) -> Result<PathBuf, Failure> {
    if let Some(out) = &args.out {
        return Ok(out.clone());
    }
    let Some(stem) = args.rig.file_stem() else {
        let file = args.rig.display();
        return Err(Failure::Input(format!(
            "{file}: it names no file; name a rig description"
        )));
    };
    let mut name = stem.to_os_string();
    name.push("-brake.toml");
    Ok(PathBuf::from(name))
}
