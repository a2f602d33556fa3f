//! This file runs a rig's model along a recording and says how far the two lie apart.

mod experiment;
mod uncalibrated;

use std::path::{Path, PathBuf};

use rigproof_diagnose::Description;
use rigproof_diagnose::align::Fault;
use rigproof_diagnose::plant::{Simulated, SimulatedOutput, Unsimulated};
use rigproof_trace::compare::{Comparison, compare};
use rigproof_trace::{Channel, Trace, csv, store};
use serde_json::{Value, json};

use crate::input::{self, HowRead, Source};
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::{significant, with_unit};
use crate::{keep, progress};
use uncalibrated::Uncalibrated;

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
    /// A picture to write: the recorded output, and both models over it; it needs a calibration
    #[arg(long, value_name = "SVG", requires = "calibration")]
    picture: Option<PathBuf>,
    /// Seed of the counts and the noise that the rig file states, in the recording of an experiment; without it there are none
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
An axis runs freely from the recorded command; a bench follows the recorded motion, and so does an arm, whose efforts
are those of inverse dynamics along the smoothed positions. A five-bar runs freely from the
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
    for out in args.out.iter().chain(&args.picture) {
        let Source { recording, rig, .. } = &args.source;
        keep::check(out, [recording, rig].into_iter().chain(&args.calibration))?;
    }
    let rig = Description::read(&args.source.rig)?;
    if let Some(plan) = experiment::plan(args, &rig)? {
        return experiment::run(args, &plan, &model(args, &rig)?);
    }
    let source = &args.source;
    let (recording, how) = input::measured(&rig, &source.recording, source.cut, &source.reading)?;
    let model = model(args, &rig)?;
    let mark = progress::spinner("simulating");
    let simulated = rig.simulated(&model, &recording, args.restart_s);
    drop(mark);
    let simulated = simulated.map_err(|why| match why {
        Unsimulated::Recording(fault) => Failure::Input(refusal(&source.recording, &fault)),
        Unsimulated::Model(why) => Failure::unusable(file(args), why),
    })?;
    let outputs = simulated.outputs.iter();
    let off = outputs.map(|own| compare(&own.counted(), &own.simulated));
    let off: Vec<Comparison> = off.collect::<Result<_, _>>()?;
    if let Some(out) = &args.out {
        let first_s = recording.time_s().first().copied().unwrap_or(0.0);
        csv::write(out, &trace(&simulated, first_s))?;
    }
    let without = match &args.calibration {
        Some(_) => Uncalibrated::of(&rig, &recording, args.restart_s),
        None => None,
    };
    if let Some(file) = &args.picture {
        let drawn = uncalibrated::picture(rig.name(), without.as_ref(), &simulated);
        let drawn = drawn.map_err(|why| Failure::unusable(file, why))?;
        store::write_aside(file, drawn.as_bytes())?;
    }
    say(args, &simulated, (&off, without.as_ref()), &how)
}

/// The file whose numbers count.
fn file(args: &Args) -> &Path {
    args.calibration.as_ref().unwrap_or(&args.source.rig)
}

/// The description whose numbers count.
fn model(args: &Args, rig: &Description) -> Result<Description, Failure> {
    let Some(file) = &args.calibration else {
        return Ok(rig.clone());
    };
    let calibration = Description::read(file)?;
    match rig.refuses(&calibration) {
        Some(problem) => Err(Failure::unusable(file, problem)),
        None => Ok(calibration),
    }
}

/// Both outputs over time, from the recording's first stamp on.
fn trace(simulated: &Simulated, first_s: f64) -> Trace {
    let channel = |name: String, unit: &str, samples: &[f64]| Channel {
        name,
        unit: unit.to_owned(),
        samples: samples.to_vec(),
    };
    let both = |own: &SimulatedOutput| match &own.recorded {
        Some(recorded) => vec![
            channel(format!("{}_recorded", own.name), &own.unit, recorded),
            channel(format!("{}_simulated", own.name), &own.unit, &own.simulated),
        ],
        None => vec![channel(
            format!("{}_off", own.name),
            &own.unit,
            &own.simulated,
        )],
    };
    Trace {
        time_s: simulated.time_s.iter().map(|t| first_s + t).collect(),
        channels: simulated.outputs.iter().flat_map(both).collect(),
    }
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

/// How far an output is off, in JSON.
fn in_json(off: &Comparison, unit: &str) -> Value {
    json!({
        "unit": unit,
        "samples": off.pairs,
        "rms": off.rms,
        "maximum": off.maximum,
        "nrmse_percent": off.nrmse_percent,
    })
}

fn say(
    args: &Args,
    simulated: &Simulated,
    (off, without): (&[Comparison], Option<&Uncalibrated>),
    how: &HowRead,
) -> Result<Outcome, Failure> {
    let pairs = || simulated.outputs.iter().zip(off);
    if args.json {
        let mut result = json!({
            "recording": args.source.recording.display().to_string(),
            "read_as": how.json(),
            "rig": args.source.rig.display().to_string(),
            "calibration": path(&args.calibration),
            "file": path(&args.out),
            "picture": path(&args.picture),
            "without_calibration": without.map(|own| own.json(simulated)),
        });
        let mut of = |name: &str, value: Value| result[name] = value;
        if let Some([runs, broken_off]) = simulated.runs {
            of("restart_s", json!(args.restart_s));
            of("runs", json!(runs));
            of("broken_off", json!(broken_off));
        }
        if simulated.runs.is_some() || off.len() > 1 {
            let all = pairs().map(|(own, off)| (own.name.to_owned(), in_json(off, &own.unit)));
            of("outputs", Value::Object(all.collect()));
        } else {
            let all = pairs().map(|(own, off)| in_json(off, &own.unit));
            let all = all.filter_map(|own| own.as_object().cloned()).flatten();
            all.for_each(|(name, value)| of(&name, value));
        }
        return print(&result.to_string());
    }
    let mut lines = Vec::new();
    let arrow = match without {
        Some(_) => ", without → with the calibration",
        None => "",
    };
    if let Some([runs, broken_off]) = simulated.runs {
        lines.push(format!(
            "simulated less recorded in {runs} free runs of {} s, each from the recorded state{arrow}",
            args.restart_s,
        ));
        if broken_off > 0 {
            lines.push(format!(
                "  {broken_off} of them drove the linkage out of its assembly and count up to there"
            ));
        }
    }
    for (k, (own, off)) in pairs().enumerate() {
        lines.push(heading(simulated, own, off, arrow));
        let shown = if own.recorded.is_none() { 2 } else { 3 };
        let before = without.and_then(|own| own.off.get(k));
        lines.extend(measures(before, off, &own.unit).into_iter().take(shown));
    }
    lines.extend(read_as(how));
    lines.extend(path(&args.out).map(|file| format!("  file     {file}")));
    lines.extend(path(&args.picture).map(|file| format!("  picture  {file}")));
    print(&lines.join("\n"))
}

/// What stands above the measures of an output: its name where there are several.
fn heading(simulated: &Simulated, own: &SimulatedOutput, off: &Comparison, arrow: &str) -> String {
    match (simulated.runs, simulated.outputs.len()) {
        (Some(_), _) => format!("{}, {} samples", own.name, off.pairs),
        (None, 0 | 1) => format!("simulated less recorded over {} samples{arrow}", off.pairs),
        (None, _) => format!(
            "{}, simulated less recorded over {} samples{arrow}",
            own.name, off.pairs
        ),
    }
}

/// How far two outputs lie apart, a line each: with the rig's own numbers where there is a calibration, and with those that count.
fn measures(before: Option<&Comparison>, now: &Comparison, unit: &str) -> Vec<String> {
    let nrmse = |off: &Comparison| {
        off.nrmse_percent.map_or_else(
            || "not defined: the recorded output never moves".to_owned(),
            |nrmse| format!("{} %", significant(nrmse, 3)),
        )
    };
    let line = |name: &str, of: &dyn Fn(&Comparison) -> String| match before {
        Some(before) => format!("  {name} {} → {}", of(before), of(now)),
        None => format!("  {name} {}", of(now)),
    };
    vec![
        line("rms     ", &|off| with_unit(off.rms, unit)),
        line("maximum ", &|off| with_unit(off.maximum, unit)),
        line("NRMSE   ", &nrmse),
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
