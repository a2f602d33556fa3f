//! This file finds out why a recording disagrees with its rig's model.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use rigproof_diagnose::report::{InputFile, Verdict};
use rigproof_diagnose::self_calibration::SelfTest;
use rigproof_diagnose::{Description, Diagnosis, Measured, Options, Watch};
use rigproof_trace::store::Folder;

use crate::input::{self, Cut, Source, Taken};
use crate::outcome::{Failure, Outcome, print, print_steadied, steady};
use crate::text::summary::{Style, summary};
use crate::{folder, keep, page, progress, shell, text, threads};

/// The recordings to diagnose, and how.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(flatten)]
    pub source: Source,
    /// More recordings of the same rig, diagnosed together with the first
    #[arg(value_name = "MORE")]
    more: Vec<PathBuf>,
    /// Another recording of the rig, on which the result is shown
    #[arg(long, value_name = "CSV", conflicts_with = "hold_out_share")]
    hold_out: Option<PathBuf>,
    /// Share of the recording's end on which the result is shown, 0.05 to 0.8
    #[arg(long, value_name = "SHARE", default_value_t = 0.25, value_parser = parse_share)]
    pub hold_out_share: f64,
    /// The folder to write [default: the recording's name with `-diagnosis`, numbered from the second diagnosis on]. One that is named here and holds an earlier diagnosis is replaced
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Measure how reliable the result is: diagnose this many simulated recordings like this one,
    /// whose causes are known
    #[arg(long, value_name = "RUNS", num_args = 0..=1, default_missing_value = "20", value_parser = parse_runs)]
    pub calibrate: Option<usize>,
    /// Tasks to run at once, also those of --calibrate; 0 takes every processor. The result does
    /// not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    pub jobs: usize,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// Print everything that the report says, not only its summary
    #[arg(long, conflicts_with_all = ["json", "quiet"])]
    verbose: bool,
    /// Print nothing: the exit code and the folder tell the result
    #[arg(long, conflicts_with = "json")]
    quiet: bool,
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
  rigproof diagnose recording.csv --rig rig.toml --calibrate 40
  rigproof diagnose recordings/ --rig rig.toml
  rigproof diagnose slow.csv fast.csv --rig rig.toml

Several recordings of one rig, or a folder of them, are diagnosed together, and the result is shown on the end of the second of two, on the last of more.";

impl Args {
    /// The arguments for one recording and its rig, with every option at its default.
    pub fn of(recording: &Path, rig: &Path, out: &Path) -> Args {
        Args {
            source: Source {
                recording: recording.to_path_buf(),
                rig: rig.to_path_buf(),
                cut: Cut::default(),
                reading: Default::default(),
            },
            more: Vec::new(),
            hold_out: None,
            hold_out_share: Options::default().hold_out_share,
            out: Some(out.to_path_buf()),
            calibrate: None,
            jobs: 0,
            json: false,
            verbose: false,
            quiet: false,
        }
    }
}

/// Diagnoses recordings, writes the folder and prints the report.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let made = made(args)?;
    say(args, (&made.out, &made.next), &made.files, &made.diagnosis)?;
    Ok(Outcome {
        checks_hold: text::holds(&made.diagnosis.report),
    })
}

/// A diagnosis that was written to its folder.
pub struct Made {
    out: PathBuf,
    pub files: Vec<&'static str>,
    next: String,
    pub diagnosis: Diagnosis,
}

/// Diagnoses recordings and writes the folder.
///
/// # Errors
/// An input is not usable, or the folder cannot be written.
pub fn made(args: &Args) -> Result<Made, Failure> {
    let out = out(args)?;
    let Source { recording, rig, .. } = &args.source;
    let inputs = [recording, rig].into_iter().chain(&args.more);
    keep::check(&out, inputs.chain(&args.hold_out))?;
    // An unusable folder is refused before the work, not after it.
    drop(Folder::begin(&out)?);
    let rig = Description::read(&args.source.rig)?;
    let identity = input::identity(&args.source.rig, None)?;
    let given = Given::read(args, &rig, identity)?;
    written(args, out, &rig, given, None)
}

/// Diagnoses what was read, and writes the folder. `watch` is told of the stages; without it the
/// terminal shows them.
///
/// # Errors
/// It cannot be diagnosed, or the folder cannot be written.
pub fn written(
    args: &Args,
    out: PathBuf,
    rig: &Description,
    given: Given,
    watch: Option<Watch>,
) -> Result<Made, Failure> {
    if args.calibrate.is_some() && given.recordings.len() > 1 {
        let problem = "--calibrate simulates a single recording: give one, not several";
        return Err(Failure::Usage(problem.to_owned()));
    }
    let is_told = watch.is_some();
    let (mark, watch) = match watch {
        Some(watch) => (None, watch),
        None => {
            let (mark, watch) = progress::stages();
            (Some(mark), watch)
        }
    };
    let options = Options {
        hold_out_share: args.hold_out_share,
        watch,
        ..Options::default()
    };
    let diagnosis = threads::pool(args.jobs)?
        .install(|| rig.diagnose(&given.recordings, given.held_out.as_ref(), &options));
    drop(mark);
    let Some(mut diagnosis) = diagnosis else {
        let problem = "it is a recording of another plant than the rig file describes";
        return Err(Failure::unusable(
            &args.source.recording,
            problem.to_owned(),
        ));
    };
    if let Some(runs) = args.calibrate {
        let bar = match is_told {
            true => progress::nothing,
            false => progress::bar,
        };
        calibrate(
            rig,
            &given,
            &mut diagnosis,
            &options,
            (runs, args.jobs),
            bar,
        )?;
    }
    diagnosis.report.inputs = given.identities;
    diagnosis.report.protocol.extend(given.read_as);
    let folder = Folder::begin(&out)?;
    let next = next(&args.source.rig, &out, &given.shown_on, &diagnosis);
    let shown = given.held_out.as_ref().or(given.recordings.last());
    let beside = page::Beside {
        replay: page::replay(rig, &diagnosis, shown),
        next: Some(next.clone()),
    };
    let files = folder::write(&folder, rig.name(), &mut diagnosis, beside)?;
    folder.finish()?;
    Ok(Made {
        out,
        files,
        next,
        diagnosis,
    })
}

/// The inputs that the command line names, after reading.
pub struct Given {
    recordings: Vec<Measured>,
    held_out: Option<Measured>,
    /// The file on which the result is shown.
    shown_on: PathBuf,
    identities: Vec<InputFile>,
    /// How each recording was read.
    read_as: Vec<String>,
}

impl Given {
    fn read(args: &Args, rig: &Description, rig_file: InputFile) -> Result<Given, Failure> {
        let paths = [&args.source.recording].into_iter().chain(&args.more);
        let files: Vec<_> = paths
            .map(|path| input::recordings(path))
            .collect::<Result<_, _>>()?;
        let fitted = files.into_iter().flatten().map(Taken::File).collect();
        Given::of(
            args,
            (rig, rig_file),
            fitted,
            args.hold_out.clone().map(Taken::File),
        )
    }

    /// Reads the recordings to fit, and the held-out one if there is one.
    ///
    /// # Errors
    /// One of them is not usable.
    pub fn of(
        args: &Args,
        (rig, rig_file): (&Description, InputFile),
        fitted: Vec<Taken>,
        held_out: Option<Taken>,
    ) -> Result<Given, Failure> {
        let reading = &args.source.reading;
        let names: Vec<PathBuf> = fitted
            .iter()
            .chain(&held_out)
            .map(|one| one.name().to_path_buf())
            .collect();
        let (mut recordings, mut hows, mut identities) = (Vec::new(), Vec::new(), Vec::new());
        for one in fitted {
            let (recording, how, identity) = input::taken(rig, one, args.source.cut, reading)?;
            recordings.push(recording);
            hows.push(how);
            identities.push(identity);
        }
        let mut other = None;
        if let Some(one) = held_out {
            let name = one.name().to_path_buf();
            let (recording, how, shown) = input::taken(rig, one, Cut::default(), reading)?;
            if identities.iter().any(|own| own.sha256 == shown.sha256) {
                let problem = "it is one of the recordings that are fitted: hold out another one, or leave --hold-out away, and the end of the recording is held out";
                return Err(Failure::unusable(&name, problem.to_owned()));
            }
            other = Some(recording);
            hows.push(how);
            identities.push(shown);
        }
        identities.push(rig_file);
        let pairs = names.iter().zip(&hows);
        Ok(Given {
            recordings,
            held_out: other,
            identities,
            read_as: pairs.flat_map(|(name, how)| how.lines(name)).collect(),
            shown_on: names.last().cloned().unwrap_or_default(),
        })
    }
}

/// Adds to the report what is named on simulated recordings. Where they cannot be simulated the
/// protocol says why.
fn calibrate(
    rig: &Description,
    given: &Given,
    diagnosis: &mut Diagnosis,
    options: &Options,
    (runs, jobs): (usize, usize),
    bar: fn(usize, &'static str) -> ProgressBar,
) -> Result<(), Failure> {
    let report = &mut diagnosis.report;
    if report.floor.is_none() {
        return Ok(());
    }
    // Many recordings are diagnosed at once, so a bar shows their number instead of stages.
    let options = &Options {
        watch: Watch::default(),
        ..options.clone()
    };
    let [recording] = given.recordings.as_slice() else {
        return Ok(());
    };
    let found = (&diagnosis.calibration, &*report);
    let whole = given.held_out.is_some();
    match SelfTest::new(rig, recording, found, (whole, runs), options) {
        Ok(test) => {
            let bar = bar(test.len(), "simulated recordings");
            let all: Vec<usize> = (0..test.len()).collect();
            let named = threads::apart(jobs, &all, |k| {
                let named = test.named(*k);
                bar.inc(1);
                Ok(named)
            })?;
            report.self_calibration = Some(test.account(&named));
        }
        Err(why) => report.protocol.push(format!("no self-calibration: {why}")),
    }
    Ok(())
}

fn say(
    args: &Args,
    (out, next): (&Path, &str),
    files: &[&str],
    diagnosis: &Diagnosis,
) -> Result<Outcome, Failure> {
    if args.quiet {
        return Ok(Outcome::DONE);
    }
    if args.json {
        return print(&folder::json(diagnosis)?);
    }
    let report = &diagnosis.report;
    if !args.verbose {
        let text = steady(&summary(report, next, &out.join(folder::PAGE)));
        return print_steadied(&Style::of_output().headed(&text, report.verdict));
    }
    let paths = files
        .iter()
        .map(|file| format!("  {}", out.join(file).display()));
    print(&text::join([
        vec![text::report(report)],
        text::section("Files", paths),
        text::section("Next", [format!("  {next}")]),
    ]))
}

/// The next step, as a command where there is one.
fn next(rig: &Path, out: &Path, shown_on: &Path, diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
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
        // A model of another simulator is simulated there.
        _ => match &diagnosis.calibration.beside()[..] {
            [(model, _)] if !model.ends_with(".csv") => format!(
                "take {} into your own simulation; {} has all that was found",
                out.join(model).display(),
                calibration.display()
            ),
            [(model, _), (table, _)] => format!(
                "take {} into your own simulation; {} lists what it cannot hold",
                out.join(model).display(),
                out.join(table).display()
            ),
            _ => shell::line(
                &["rigproof", "simulate"],
                &[
                    ("", shown_on),
                    ("--rig", rig),
                    ("--calibration", &calibration),
                ],
            ),
        },
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
    Ok(not_there_yet(PathBuf::from(name)))
}

/// The folder itself, or the first numbered one that does not exist: an earlier diagnosis is kept.
fn not_there_yet(folder: PathBuf) -> PathBuf {
    if folder.symlink_metadata().is_err() {
        return folder;
    }
    let numbered = (2_u64..).map(|number| {
        let mut name = folder.clone().into_os_string();
        name.push(format!("-{number}"));
        PathBuf::from(name)
    });
    let mut free = numbered.filter(|name| name.symlink_metadata().is_err());
    free.next().unwrap_or(folder)
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
