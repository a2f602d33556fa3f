//! This file runs a rig's model along a recording and says how far the two lie apart.

mod experiment;
mod five_bar;

use std::path::{Path, PathBuf};

use rigproof_diagnose::Description;
use rigproof_diagnose::align::Fault;
use rigproof_diagnose::plants::joint::from_rig;
use rigproof_diagnose::plants::joint::run::{JointRun, PlantKind};
use rigproof_diagnose::plants::joint::simulate::{Protocol, output};
use rigproof_spec::effect::Quantity;
use rigproof_trace::compare::{Comparison, compare};
use rigproof_trace::rig::{Rig, motion_name};
use rigproof_trace::{Channel, Trace, csv};
use serde_json::json;

use crate::input::{self, HowRead, Source};
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::{significant, with_unit};
use crate::{keep, progress};

/// What is to be simulated.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// The calibration that a diagnosis wrote; without it the rig's own numbers count
    #[arg(long, value_name = "TOML")]
    calibration: Option<PathBuf>,
    /// How long a five-bar runs freely before it starts from the recorded state again, s
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = parse_restart)]
    restart_s: f64,
    /// A CSV file to write: time, recorded and simulated output; of an experiment, what the rig would record
    #[arg(long, value_name = "CSV")]
    out: Option<PathBuf>,
    /// Seed of the counts and the noise that the rig file states, in the recording of an experiment; without it there are none
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
An axis runs freely from the recorded command; a bench follows the recorded motion. A five-bar runs freely from the
recorded force and currents, every `--restart-s` from the recorded state: nothing holds it where the hand's stiffness did.
The experiment that a diagnosis of a five-bar writes (columns hand_x and hand_y in m, current_a and so on in A) is played
from rest with a hand of 420 N/m and 11 N·s/m; `--out` then is a recording, which `diagnose` takes.

Examples:
  rigproof simulate run.csv --rig rig.toml --calibration run-diagnosis/calibration.toml \\
      --out simulated.csv
  rigproof simulate run-diagnosis/next-experiment.csv --rig rig.toml --seed 7 \\
      --calibration run-diagnosis/calibration.toml --out expected.csv";

/// Simulates, compares, and writes both outputs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if let Some(out) = &args.out {
        let Source { recording, rig, .. } = &args.source;
        keep::check(out, [recording, rig].into_iter().chain(&args.calibration))?;
    }
    let rig = match Description::read(&args.source.rig)? {
        Description::Joint(rig) => rig,
        Description::FiveBar(rig) => return five_bar::run(args, &rig),
    };
    let source = &args.source;
    let (recording, how) = input::recording(&rig, &source.recording, source.cut, &source.reading)?;
    let model = model(args, &rig)?;
    let run = from_rig::aligned(&model, &recording)
        .map_err(|fault| Failure::Input(refusal(&args.source.recording, &fault)))?;
    let protocol = from_rig::protocol(&model);
    let mark = progress::spinner("simulating");
    let simulated = output(&from_rig::plant(&model), &run, &protocol);
    drop(mark);
    let (name, recorded, quantity) = match run.plant {
        PlantKind::Axis => ("position", &run.position, Quantity::Travel),
        PlantKind::Bench => ("effort", &run.effort, Quantity::Effort),
    };
    let unit = quantity.dimension(model.motion).to_string();
    let comparison = compare(&counted(&run, recorded, &protocol), &simulated)?;
    if let Some(out) = &args.out {
        let first_s = recording.time_s.first().copied().unwrap_or(0.0);
        let channel = |source: &str, samples: &[f64]| Channel {
            name: format!("{name}_{source}"),
            unit: unit.clone(),
            samples: samples.to_vec(),
        };
        let times = (0..run.len()).map(|k| first_s + run.start_s + k as f64 * run.step_s);
        let trace = Trace {
            time_s: times.collect(),
            channels: vec![
                channel("recorded", recorded),
                channel("simulated", &simulated),
            ],
        };
        csv::write(out, &trace)?;
    }
    say(args, &unit, &comparison, &how)
}

/// The rig whose numbers count.
fn model(args: &Args, rig: &Rig) -> Result<Rig, Failure> {
    let Some(file) = &args.calibration else {
        return Ok(rig.clone());
    };
    let calibration = Rig::read(file)?;
    if (calibration.plant, calibration.motion) != (rig.plant, rig.motion) {
        let problem = format!(
            "the calibration is of a {} {}, the rig is a {} {}; give the calibration of this rig",
            motion_name(calibration.motion),
            calibration.plant.name(),
            motion_name(rig.motion),
            rig.plant.name(),
        );
        return Err(Failure::unusable(file, problem));
    }
    Ok(calibration)
}

/// The recorded output where it counts: not where it gave the start state, and not where a sample was filled in.
fn counted(run: &JointRun, recorded: &[f64], protocol: &Protocol) -> Vec<f64> {
    let start = match run.plant {
        PlantKind::Axis if protocol.warm_up_periods == 0 => protocol.start_samples,
        _ => 0,
    };
    let samples = recorded.iter().zip(&run.recorded).enumerate();
    samples
        .map(|(k, (&x, &was_recorded))| {
            if was_recorded && k >= start {
                x
            } else {
                f64::NAN
            }
        })
        .collect()
}

fn refusal(file: &Path, fault: &Fault) -> String {
    format!(
        "{}: the {} is at fault from {:.3} s to {:.3} s: {}; mend it or cut it away with --from-s and --to-s",
        file.display(),
        fault.channel,
        fault.from_s,
        fault.to_s,
        fault.reason
    )
}

fn say(
    args: &Args,
    unit: &str,
    comparison: &Comparison,
    how: &HowRead,
) -> Result<Outcome, Failure> {
    if args.json {
        let result = json!({
            "recording": args.source.recording.display().to_string(),
            "read_as": how.json(),
            "rig": args.source.rig.display().to_string(),
            "calibration": path(&args.calibration),
            "unit": unit,
            "samples": comparison.pairs,
            "rms": comparison.rms,
            "maximum": comparison.maximum,
            "nrmse_percent": comparison.nrmse_percent,
            "file": path(&args.out),
        });
        return print(&result.to_string());
    }
    let mut lines = vec![format!(
        "simulated less recorded over {} samples",
        comparison.pairs
    )];
    lines.extend(measures(comparison, unit));
    lines.extend(read_as(how));
    lines.extend(path(&args.out).map(|file| format!("  file     {file}")));
    print(&lines.join("\n"))
}

/// How far two outputs lie apart, a line each.
fn measures(comparison: &Comparison, unit: &str) -> Vec<String> {
    let nrmse = comparison.nrmse_percent.map_or_else(
        || "not defined: the recorded output never moves".to_owned(),
        |nrmse| format!("{} %", significant(nrmse, 3)),
    );
    vec![
        format!("  rms      {}", with_unit(comparison.rms, unit)),
        format!("  maximum  {}", with_unit(comparison.maximum, unit)),
        format!("  NRMSE    {nrmse}"),
    ]
}

fn read_as(how: &HowRead) -> Vec<String> {
    match how {
        HowRead::Text(dialect, remarks) => {
            let first = format!("  read as  {dialect}");
            let more = remarks.iter().map(|line| format!("           {line}"));
            std::iter::once(first).chain(more).collect()
        }
        HowRead::Messages(lines) => lines.iter().map(|line| format!("  {line}")).collect(),
    }
}

fn path(path: &Option<PathBuf>) -> Option<String> {
    path.as_ref().map(|path| path.display().to_string())
}

fn parse_restart(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.001..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("give seconds from 0.001 to 3600".to_owned()),
    }
}
