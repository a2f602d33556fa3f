//! This file finds out why a recording disagrees with its rig's model.

use std::path::{Path, PathBuf};

use rayon::ThreadPool;
use rayon::prelude::*;
use rigproof_diagnose::report::{Report, Verdict};
use rigproof_diagnose::self_calibration::SelfTest;
use rigproof_diagnose::{Description, Diagnosis, Measured, Options};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::store::Folder;

use crate::input::{self, Cut, Source};
use crate::outcome::{Failure, Outcome, print};
use crate::{folder, progress, shell, text, threads};

/// What is to be diagnosed.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Another recording of the rig, on which the result is shown
    #[arg(long, value_name = "CSV", conflicts_with = "hold_out_share")]
    hold_out: Option<PathBuf>,
    /// Share of the recording's end on which the result is shown, 0.05 to 0.8
    #[arg(long, value_name = "SHARE", default_value_t = 0.25, value_parser = parse_share)]
    hold_out_share: f64,
    /// The folder to write [default: the recording's name with `-diagnosis`]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Say how far the result can be believed: diagnose as many simulated recordings like this one whose causes are known
    #[arg(long, value_name = "RUNS", num_args = 0..=1, default_missing_value = "20", value_parser = parse_runs)]
    calibrate: Option<usize>,
    /// Simulated recordings that are diagnosed at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse, requires = "calibrate")]
    jobs: usize,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Exit codes:
  0  diagnosed
  1  the recording is at fault or moves too little, or the held-out part did not improve
  2  the command line is wrong
  3  an input is not usable, or a file cannot be written

Examples:
  rigproof diagnose DATA_EMPS.csv --rig rigs/emps.toml --hold-out DATA_EMPS_PULSES.csv
  rigproof diagnose ensaio.A.1.csv --rig rigs/mr-damper.toml --from-s 2.5 --out damper --json
  rigproof diagnose recording.csv --rig rig.toml --calibrate 40";

/// Diagnoses a recording, writes the folder and prints the report.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let out = out(args)?;
    // A wrong place is refused before the work, not after it.
    drop(Folder::begin(&out)?);
    let rig = Description::read(&args.source.rig)?;
    let source = &args.source;
    let read = |file: &PathBuf, cut| input::measured(&rig, file, cut, &source.reading);
    let (recording, how) = read(&source.recording, source.cut)?;
    let held_out = match &args.hold_out {
        Some(file) => Some((file, read(file, Cut::default())?)),
        None => None,
    };
    let mut recordings = vec![(&source.recording, &how)];
    recordings.extend(held_out.iter().map(|(file, (_, how))| (*file, how)));
    let read_as: Vec<String> = recordings
        .iter()
        .flat_map(|(file, how)| how.lines(file))
        .collect();
    let files = recordings.iter().map(|(file, how)| (*file, how.dialect()));
    let identities = files.chain([(&source.rig, None)]);
    let identities = identities.map(|(file, dialect)| input::identity(file, dialect));
    let identities = identities.collect::<Result<Vec<_>, _>>()?;
    let options = Options {
        hold_out_share: args.hold_out_share,
        ..Options::default()
    };
    let mark = progress::spinner("diagnosing");
    let held_out = held_out.map(|(_, (recording, _))| recording);
    let diagnosis = rig.diagnose(&recording, held_out.as_ref(), &options);
    drop(mark);
    let Some(mut diagnosis) = diagnosis else {
        let problem = "the held-out recording is one of another plant".to_owned();
        return Err(Failure::unusable(&args.source.recording, problem));
    };
    if let Some(runs) = args.calibrate {
        let calibration = (runs, threads::pool(args.jobs)?);
        let (rig, whole) = (&rig, held_out.is_some());
        calibrate(
            rig,
            &recording,
            whole,
            &mut diagnosis,
            &options,
            calibration,
        );
    }
    diagnosis.report.inputs = identities;
    diagnosis.report.protocol.extend(read_as);
    let folder = Folder::begin(&out)?;
    let files = folder::write(&folder, rig.name(), &mut diagnosis)?;
    folder.finish()?;
    say(args, &out, &files, &diagnosis)?;
    Ok(Outcome {
        checks_hold: text::holds(&diagnosis.report),
    })
}

/// Enters into the report what is named on simulated recordings; where they cannot be simulated the protocol says why.
fn calibrate(
    rig: &Description,
    recording: &Measured,
    whole: bool,
    diagnosis: &mut Diagnosis,
    options: &Options,
    (runs, threads): (usize, ThreadPool),
) {
    let report = &mut diagnosis.report;
    if report.floor.is_none() {
        return;
    }
    let found = (&diagnosis.calibration, &*report);
    match SelfTest::new(rig, recording, found, (whole, runs), options) {
        Ok(test) => {
            let bar = progress::bar(test.len(), "simulated recordings");
            let named = threads.install(|| {
                let all = (0..test.len()).into_par_iter();
                all.map(|k| {
                    let named = test.named(k);
                    bar.inc(1);
                    named
                })
                .collect::<Vec<_>>()
            });
            report.self_calibration = Some(test.account(&named));
        }
        Err(why) => report.protocol.push(format!("no self-calibration: {why}")),
    }
}

fn say(args: &Args, out: &Path, files: &[&str], diagnosis: &Diagnosis) -> Result<Outcome, Failure> {
    if args.json {
        return print(&folder::json(diagnosis)?);
    }
    let paths = files
        .iter()
        .map(|file| format!("  {}", out.join(file).display()));
    print(&text::join([
        vec![text::report(&diagnosis.report)],
        text::section("Files", paths),
        text::section(
            "Next",
            [format!("  {}", next(args, out, &diagnosis.report))],
        ),
    ]))
}

/// The mechanism that the reference rig does not compute.
const LOAD: &str = Mechanism::LoadDependent.name();

/// What to do now, as a command where there is one.
fn next(args: &Args, out: &Path, report: &Report) -> String {
    let calibration = out.join(folder::CALIBRATION);
    match report.verdict {
        Verdict::DataFault => "mend the recording or the rig file, or cut the fault away with --from-s and --to-s; then diagnose again".to_owned(),
        Verdict::NotExcited => "record again with more motion: several reversals at several speeds".to_owned(),
        _ if !text::holds(report) => "record for longer, or hold out another recording with --hold-out".to_owned(),
        Verdict::NoneOfLibrary => format!(
            "look at {} and at {} in the report: {} what to look for on the rig",
            out.join("residual.svg").display(),
            report.unknown.as_ref().map_or("`located`", |_| "`unknown`"),
            report.unknown.as_ref().map_or("joint and regime hint at", |_| "the shape says"),
        ),
        _ if report.plant == "rig" && report.effects.iter().any(|e| e.mechanism == LOAD) => {
            format!("hold {} against a recording with other loads: `simulate` does not follow `{LOAD}` yet", calibration.display())
        }
        _ => shell::line(
            &["rigproof", "simulate"],
            &[
                ("", args.hold_out.as_ref().unwrap_or(&args.source.recording)),
                ("--rig", &args.source.rig),
                ("--calibration", &calibration),
            ],
        ),
    }
}

fn out(args: &Args) -> Result<PathBuf, Failure> {
    if let Some(out) = &args.out {
        return Ok(out.clone());
    }
    let Some(stem) = args.source.recording.file_stem() else {
        let file = args.source.recording.display();
        return Err(Failure::Input(format!(
            "{file}: it names no file; name a recording"
        )));
    };
    let mut name = stem.to_os_string();
    name.push("-diagnosis");
    Ok(PathBuf::from(name))
}

/// The most simulated recordings of each kind.
const MOST_RUNS: usize = 10_000;

fn parse_runs(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(runs) if (1..=MOST_RUNS).contains(&runs) => Ok(runs),
        _ => Err(format!("give a whole number from 1 to {MOST_RUNS}")),
    }
}

fn parse_share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.05..=0.8).contains(&share) => Ok(share),
        _ => Err("give a share from 0.05 to 0.8".to_owned()),
    }
}
