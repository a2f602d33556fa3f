//! This file says what is in a recording that nobody has described yet, and begins a rig description for it.

mod arm;
mod messages;
mod noise;
mod pace;
mod signal;
mod skeleton;
mod sparkline;

use std::path::{Path, PathBuf};

use rigproof_trace::arrays::{Arrays, PassedOver};
use rigproof_trace::csv::{self, Dialect, Known, TimeColumn};
use rigproof_trace::{Channel, mcap};
use serde_json::{Value, json};

use crate::input;
use crate::outcome::{Failure, Outcome, plain, print};
use crate::reading::{self, Reading};
use crate::schema;
use crate::shell;
use crate::text::{join, section};
use pace::Pace;
use signal::SignalView;

/// Columns of a file without time stamps that are shown.
const SHOWN: usize = 64;

/// What is to be looked at.
#[derive(Clone, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The recording: CSV in any dialect, MCAP, HDF5 or MATLAB (version 5 to 7.3), told apart by its content
    recording: PathBuf,
    /// The column that holds the time, where its name does not say so; of MCAP `log_time`, `publish_time` or a field such
    /// as `header.stamp`
    #[arg(long, value_name = "NAME")]
    time_from: Option<String>,
    /// Only this topic of an MCAP file, with all of its channels; may be given several times
    #[arg(long, value_name = "NAME")]
    topic: Vec<String>,
    /// A rig description to begin with; what must be filled in says so
    #[arg(long, value_name = "TOML")]
    write_rig: Option<PathBuf>,
    /// The rows are a static sweep: an effort over a command or a speed, each row settled, without a time
    #[arg(long, conflicts_with_all = ["time_from", "topic", "model"])]
    sweep: bool,
    #[command(flatten)]
    model: arm::Model,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: Reading,
}

impl Args {
    fn time_column(&self) -> Option<TimeColumn> {
        self.time_from.as_ref().map(|name| TimeColumn {
            name: name.clone(),
            unit: String::new(),
        })
    }
}

const AFTER_HELP: &str = "\
From an unknown file to a first diagnosis:
  1. look at it and begin a rig description   2. fill in what is marked `fill in`   3. diagnose

Examples:
  rigproof inspect run.csv
  rigproof inspect run.csv --write-rig rig.toml
  rigproof inspect run.csv --write-rig rig.toml --model arm.urdf
  rigproof inspect torque-over-current.csv --sweep --write-rig rig.toml
  rigproof inspect scope.txt --separator ';' --decimal ',' --header-lines 12 --json";

/// Looks at a recording, and writes the beginning of a rig description if asked.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let args = &Args {
        recording: input::file(&args.recording)?,
        ..args.clone()
    };
    if mcap::is_mcap(&args.recording)? {
        return messages::run(args);
    }
    if !args.topic.is_empty() {
        let file = args.recording.display();
        let problem = format!("{file}: --topic is for MCAP files; this one has no topics");
        return Err(Failure::Usage(problem));
    }
    match Arrays::open(&args.recording)? {
        Some(arrays) => variables(args, &arrays),
        None => text(args),
    }
}

/// A text recording.
fn text(args: &Args) -> Result<Outcome, Failure> {
    let time = args.time_column();
    let hints = args.reading.hints();
    let known = Known {
        time: time.as_ref(),
        hints,
        is_sweep: args.sweep,
        ..csv::Known::default()
    };
    let text = csv::read_text(&args.recording, &known)?;
    let (trace, dialect, remarks) = (text.trace, text.dialect, text.remarks);
    let pace = Pace::of(&trace.time_s);
    let view = match args.sweep {
        true => SignalView::of_sweep,
        false => SignalView::of,
    };
    let signals: Vec<SignalView> = trace.channels.into_iter().map(view).collect();
    let signals: Vec<&SignalView> = signals.iter().collect();
    if let Some(file) = &args.write_rig {
        let text = begun(args, file, time.as_ref(), &signals)?;
        write_rig(file, &text)?;
    }
    if args.json {
        let mut result = match args.sweep {
            true => json!({ "rows": trace.time_s.len() }),
            false => pace.json(),
        };
        result["file"] = json!(args.recording.display().to_string());
        result["read_as"] = reading::in_json(dialect);
        result["remarks"] = json!(remarks);
        result["channels"] = signals.iter().map(|s| s.json(args.ascii)).collect();
        result["rig"] = json!(
            args.write_rig
                .as_ref()
                .map(|file| file.display().to_string())
        );
        return print(&result.to_string());
    }
    show([
        head(&args.recording, trace.time_s.len(), signals.len(), &dialect),
        section("Reading", remarks.iter().map(|line| format!("  {line}"))),
        section("Time", pace.lines().into_iter().filter(|_| !args.sweep)),
        section("Channels", signal::lines(&signals, args.ascii, usize::MAX)),
        section("Next", [format!("  {}", next(args))]),
    ])
}

fn head(file: &Path, samples: usize, channels: usize, dialect: &Dialect) -> Vec<String> {
    vec![
        format!(
            "{}: {samples} samples of {channels} channels",
            file.display()
        ),
        format!("read as: {dialect}"),
    ]
}

/// Prints sections; what a file calls things cannot steer the terminal.
fn show(sections: impl IntoIterator<Item = Vec<String>>) -> Result<Outcome, Failure> {
    let sections = sections.into_iter();
    let sections = sections.map(|lines| lines.iter().map(|line| plain(line)).collect());
    print(&join(sections))
}

fn next(args: &Args) -> String {
    let recording = ("", args.recording.as_path());
    match &args.write_rig {
        Some(file) => {
            let command = shell::line(&["rigproof", "diagnose"], &[recording, ("--rig", file)]);
            format!("{command}   (check and complete {} first)", file.display())
        }
        None => {
            shell::line(
                &["rigproof", "inspect"],
                &[recording, ("--write-rig", Path::new("rig.toml"))],
            ) + if args.sweep { " --sweep" } else { "" }
        }
    }
}

/// The beginning of a description: of an arm where its model is given.
fn begun(
    args: &Args,
    rig: &Path,
    time: Option<&TimeColumn>,
    signals: &[&SignalView],
) -> Result<String, Failure> {
    let hints = args.reading.hints();
    let files = (args.recording.as_path(), rig);
    let arm = args.model.toml(files, time, &hints, signals)?;
    Ok(arm.unwrap_or_else(|| match args.sweep {
        true => skeleton::of_sweep(&args.recording, &hints, signals),
        false => skeleton::toml(&args.recording, time, &hints, signals),
    }))
}

/// Writes the description unless one stands there: it may hold somebody's work.
fn write_rig(file: &Path, text: &str) -> Result<(), Failure> {
    if file.exists() {
        let problem = "a file stands there already; name another".to_owned();
        return Err(Failure::unusable(file, problem));
    }
    rigproof_trace::store::write_aside(file, text.as_bytes())?;
    schema::beside(file)
}

/// A file of arrays, which do not say what the time is.
fn variables(args: &Args, arrays: &Arrays) -> Result<Outcome, Failure> {
    let file = args.recording.display();
    if args.write_rig.is_some() || args.time_from.is_some() {
        return Err(Failure::Usage(format!(
            "{file}: --write-rig and --time-from are for text recordings; take one out of this file with `rigproof convert` first"
        )));
    }
    let entries = arrays.entries().iter();
    let columns = entries.flat_map(|entry| (0..entry.columns).map(move |k| (entry, k)));
    let mut signals = Vec::new();
    for (entry, k) in columns.clone().take(SHOWN) {
        let name = match entry.columns {
            1 => entry.name.clone(),
            _ => format!("{}[{k}]", entry.name),
        };
        signals.push(SignalView::of(Channel {
            samples: arrays.column(&name)?,
            unit: String::new(),
            name,
        }));
    }
    let left_out = columns.count() - signals.len();
    let not_read: Vec<String> = arrays
        .passed_over()
        .iter()
        .map(PassedOver::advice)
        .collect();
    if args.json {
        let channels: Vec<Value> = signals.iter().map(|s| s.json(args.ascii)).collect();
        let result = json!({
            "file": file.to_string(), "channels": channels, "left_out": left_out, "not_read": not_read,
        });
        return print(&result.to_string());
    }
    let more =
        (left_out > 0).then(|| format!("  and {left_out} more, which --list of convert names"));
    let advice = format!(
        "  {} --variables NAMES --time-from NAME   (or --rate-from NAME, or --rate-hz HZ)",
        shell::line(
            &["rigproof", "convert"],
            &[("", &args.recording), ("", Path::new("run.csv"))]
        )
    );
    show([
        vec![format!("{file}: {} variables", arrays.entries().len())],
        section(
            "Variables",
            signal::lines(&signals.iter().collect::<Vec<_>>(), args.ascii, SHOWN)
                .into_iter()
                .chain(more),
        ),
        section("Not read", not_read.iter().map(|line| format!("  {line}"))),
        section("Next", (!signals.is_empty()).then_some(advice)),
    ])
}
