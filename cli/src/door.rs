//! This file is the way in for another program: a diagnosis of files or of channels in memory, written by the verb's own functions.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use rigproof_diagnose::stop::Stopped;
use rigproof_diagnose::{Description, Watch};
use rigproof_trace::clock::{self, Settled};
use rigproof_trace::csv::LEAST_SAMPLES;
use rigproof_trace::store::Folder;
use rigproof_trace::{Place, Trace, TraceError};

pub use rigproof_diagnose::Curves;
pub use rigproof_diagnose::stop::Stop;

use crate::diagnose::{Args, Given, written};
use crate::input::{self, Cut, Taken};
use crate::outcome::Failure;

/// A recording.
pub enum Recording {
    /// A file or a folder of files.
    File(PathBuf),
    /// Channels in memory, and what messages and the report call them.
    Channels(String, Trace),
}

/// A rig description.
pub enum Rig {
    /// A TOML file.
    File(PathBuf),
    /// The text of one, and what messages and the report call it.
    Text(String, String),
}

/// What is to be diagnosed.
pub struct Asked {
    /// The recordings that are fitted.
    pub recordings: Vec<Recording>,
    /// The recording on which the result is shown; without it the end of the recording.
    pub held_out: Option<Recording>,
    /// The rig.
    pub rig: Rig,
    /// The share of the end that is held out; what the program takes where it is not given.
    pub hold_out_share: Option<f64>,
    /// What lies between these time stamps counts, s.
    pub between_s: [Option<f64>; 2],
    /// How many simulated recordings say what the result is worth.
    pub calibrate: Option<usize>,
    /// What is worked on at once; 0 takes every processor.
    pub jobs: usize,
    /// The folder to write.
    pub out: PathBuf,
    /// Ends the work early.
    pub stop: Stop,
    /// What is worked on, in words; nothing is drawn on a terminal.
    pub doing: Doing,
}

/// What is worked on, in words.
pub type Doing = Arc<Mutex<&'static str>>;

/// Why something could not be done; the message names file, line and column where there are any.
#[derive(Debug)]
pub struct Refused(pub String);

impl From<Failure> for Refused {
    fn from(failure: Failure) -> Refused {
        match failure {
            Failure::Usage(message) | Failure::Input(message) => Refused(message),
        }
    }
}

impl From<TraceError> for Refused {
    fn from(error: TraceError) -> Refused {
        Failure::from(error).into()
    }
}

/// Diagnoses, writes the folder as the program does, and gives the curves of its pictures.
///
/// # Errors
/// An input is not usable, the folder cannot be written, or the work was ended; nothing is written then.
pub fn diagnose(asked: Asked) -> Result<Curves, Refused> {
    let stop = asked.stop.clone();
    let work = AssertUnwindSafe(|| stop.during(|| worked(asked)));
    catch_unwind(work).unwrap_or_else(|payload| match payload.is::<Stopped>() {
        true => Err(Refused("the diagnosis was ended".to_owned())),
        false => resume_unwind(payload),
    })
}

fn worked(asked: Asked) -> Result<Curves, Refused> {
    drop(Folder::begin(&asked.out)?);
    let (rig, rig_path, rig_file) = match &asked.rig {
        Rig::File(file) => (
            Description::read(file)?,
            file.clone(),
            input::identity(file, None)?,
        ),
        Rig::Text(text, name) => (
            Description::parse(text, Path::new(name))?,
            PathBuf::from(name),
            input::identity_of(name, text.as_bytes()),
        ),
    };
    let mut args = Args::of(Path::new(""), &rig_path, &asked.out);
    args.calibrate = asked.calibrate;
    args.jobs = asked.jobs;
    args.hold_out_share = asked.hold_out_share.unwrap_or(args.hold_out_share);
    if !(0.05..=0.8).contains(&args.hold_out_share) {
        return Err(Refused(format!(
            "hold_out is {}; give a share from 0.05 to 0.8",
            args.hold_out_share
        )));
    }
    args.source.cut = Cut::between(asked.between_s[0], asked.between_s[1]);
    let mut fitted = Vec::new();
    for one in asked.recordings {
        match one {
            Recording::File(path) => {
                fitted.extend(input::recordings(&path)?.into_iter().map(Taken::File))
            }
            Recording::Channels(name, trace) => fitted.push(in_turn(name, trace)?),
        }
    }
    let held_out = match asked.held_out {
        Some(Recording::File(path)) => Some(Taken::File(path)),
        Some(Recording::Channels(name, trace)) => Some(in_turn(name, trace)?),
        None => None,
    };
    let given = Given::of(&args, (&rig, rig_file), fitted, held_out)?;
    let doing = asked.doing;
    let watch = Watch::new(move |stage| {
        if let Ok(mut words) = doing.lock() {
            *words = stage.doing();
        }
    });
    let made = written(&args, asked.out, &rig, given, Some(watch))?;
    Ok(made.diagnosis.curves)
}

/// Channels whose time stamps are in order; what text recordings are mended in is mended here too.
fn in_turn(name: String, mut trace: Trace) -> Result<Taken, Refused> {
    let file = PathBuf::from(name);
    let samples = trace.len();
    if samples < LEAST_SAMPLES {
        return Err(TraceError::TooFewSamples {
            file,
            samples,
            least: LEAST_SAMPLES,
        }
        .into());
    }
    let at = |row: usize| Place::line(&file, row + 1);
    if let Some(row) = trace.time_s.iter().position(|t| !t.is_finite()) {
        return Err(TraceError::TimeMissing { place: at(row) }.into());
    }
    let mut pairs = trace.time_s.iter().zip(trace.time_s.iter().skip(1));
    if let Some(row) = pairs.position(|(previous, next)| next < previous) {
        let [previous_s, time_s] =
            [row, row + 1].map(|k| trace.time_s.get(k).copied().unwrap_or(f64::NAN));
        return Err(TraceError::TimeOrder {
            place: at(row + 1),
            time_s,
            previous_s,
        }
        .into());
    }
    let mut pairs = trace.time_s.iter().zip(trace.time_s.iter().skip(1));
    let repeated = pairs.position(|(previous, next)| next == previous);
    let mut said = Vec::new();
    if let Some(row) = repeated {
        match clock::settle(&trace.time_s, 0.0) {
            Settled::AsTheyAre => {}
            Settled::Even(time_s, how) => {
                trace.time_s = time_s;
                said.push(how);
            }
            Settled::Once(rows, how) => {
                let only = |all: &[f64]| rows.iter().filter_map(|k| all.get(*k).copied()).collect();
                trace.time_s = only(&trace.time_s);
                for channel in &mut trace.channels {
                    channel.samples = only(&channel.samples);
                }
                said.push(how);
            }
            Settled::Refused => return Err(TraceError::TimeRepeated { place: at(row) }.into()),
        }
    }
    Ok(Taken::Channels(file, trace, said))
}
