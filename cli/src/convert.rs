//! This file turns other people's recordings into CSV or MCAP.

mod messages;

use std::path::{Path, PathBuf};

use clap::ArgGroup;
use rigproof_trace::arrays::{Arrays, PassedOver, Selection, TimeSource};
use rigproof_trace::csv::{self, Dialect, Known, TimeColumn};
use rigproof_trace::foreign;
use rigproof_trace::mcap;
use rigproof_trace::suggest::quoted;
use rigproof_trace::{Trace, TraceError};
use serde_json::{Value, json};

use crate::outcome::{self, Failure, Outcome, plain, print};
use crate::reading::{self, Reading};
use crate::{input, keep};

/// What is to be converted.
#[derive(Clone, clap::Args)]
#[command(after_help = AFTER_HELP)]
#[command(group = ArgGroup::new("time").args(["rate_hz", "rate_from", "time_from"]))]
pub struct Args {
    /// The recording: HDF5, MATLAB (version 5 to 7.3), MCAP or CSV, told apart by its content
    input: PathBuf,
    /// The file to write: CSV if its name ends in `.csv` or `.txt`, MCAP if it ends in `.mcap`
    #[arg(required_unless_present = "list", conflicts_with = "list")]
    output: Option<PathBuf>,
    /// Say what the file holds, and write nothing
    #[arg(long)]
    list: bool,
    /// The HDF5 group that every variable stands in
    #[arg(long, value_name = "GROUP")]
    group: Option<String>,
    /// The variables to take, by name; `x[1]` is column 1 of a matrix, counted from 0
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    variables: Vec<String>,
    /// Time runs at this rate
    #[arg(long, value_name = "HZ")]
    rate_hz: Option<f64>,
    /// Time runs at the rate, in Hz, that this variable holds
    #[arg(long, value_name = "NAME")]
    rate_from: Option<String>,
    /// Time stamps are in this variable or column, in s unless `--unit` says otherwise; of MCAP also `log_time`,
    /// `publish_time` or a field such as `header.stamp`
    #[arg(long, value_name = "NAME")]
    time_from: Option<String>,
    /// State the unit of a variable; the numbers stay as they are
    #[arg(long = "unit", value_name = "NAME=UNIT", value_parser = reading::parse_unit)]
    units: Vec<(String, String)>,
    /// Put this file into the MCAP file, such as the rig description or the calibration
    #[arg(long, value_name = "FILE")]
    attach: Vec<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: Reading,
}

const AFTER_HELP: &str = "\
Examples:
  rigproof convert --list data_simulation_4.4_MRdamper.mat
  rigproof convert data_simulation_4.4_MRdamper.mat damper.csv --variables 'dist1[1],forc1[1]' \\
      --time-from 'forc1[0]' --unit 'dist1[1]=mm' --unit 'forc1[1]=N'
  rigproof convert test.h5 multisine.csv --group multisine --variables u,y --rate-hz 750
  rigproof convert run.csv run.mcap --attach rig.toml
  rigproof convert bag.mcap run.csv --variables '/joint_states.position[name=elbow],/wrench.wrench.torque.z'";

/// Converts a recording, or lists what it holds.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let args = &Args {
        input: input::file(&args.input)?,
        ..args.clone()
    };
    let to_mcap = match &args.output {
        Some(output) => is_mcap_wanted(output)?,
        None => false,
    };
    if !to_mcap && !args.attach.is_empty() {
        let problem = "--attach is for MCAP files; give the output a name that ends in `.mcap`";
        return Err(Failure::Usage(problem.into()));
    }
    if let Some(output) = &args.output {
        keep::check(output, [&args.input].into_iter().chain(&args.attach))?;
    }
    if mcap::is_mcap(&args.input)? {
        return messages::run(args, to_mcap);
    }
    let arrays = open(&args.input)?;
    // Without an output the command line asks for the list.
    let Some(output) = &args.output else {
        return list(args, arrays.as_ref());
    };
    let (trace, dialect) = match arrays {
        Some(arrays) => (arrays.recording(&selection(args)?)?, None),
        None => text_recording(args).map(|(trace, dialect)| (trace, Some(dialect)))?,
    };
    write(args, output, &trace, dialect, to_mcap)
}

/// Whether the name of an output asks for MCAP and not for CSV.
///
/// # Errors
/// It asks for neither.
fn is_mcap_wanted(output: &Path) -> Result<bool, Failure> {
    let extension = output.extension().unwrap_or_default();
    let is = |own: &str| extension.eq_ignore_ascii_case(own);
    match (is("mcap"), is("csv") || is("txt")) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(Failure::Usage(format!(
            "{}: the name does not say what to write; end it in `.csv` or `.mcap`",
            output.display()
        ))),
    }
}

/// Writes the recording and says what it holds.
fn write(
    args: &Args,
    output: &Path,
    trace: &Trace,
    dialect: Option<Dialect>,
    to_mcap: bool,
) -> Result<Outcome, Failure> {
    match to_mcap {
        true => mcap::write(output, trace, &messages::extras(args)?)?,
        false => csv::write(output, trace)?,
    }
    report(args, output, trace, dialect)
}

/// The arrays of an HDF5 or MATLAB file, or `None` for text.
fn open(input: &Path) -> Result<Option<Arrays>, Failure> {
    let arrays = Arrays::open(input)?;
    if arrays.is_none() {
        foreign::check(input)?;
    }
    let extension = input
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    if arrays.is_none() && ["h5", "hdf5", "mat"].contains(&extension) {
        let file = input.display();
        return Err(Failure::Input(format!(
            "{file}: the file is neither HDF5 nor MATLAB of version 5 to 7.3, as its name says; check how it was saved"
        )));
    }
    Ok(arrays)
}

fn selection(args: &Args) -> Result<Selection, Failure> {
    let rate_from = || args.rate_from.clone().map(TimeSource::RateFrom);
    let stamps = || args.time_from.clone().map(TimeSource::Stamps);
    let time = args
        .rate_hz
        .map(TimeSource::RateHz)
        .or_else(rate_from)
        .or_else(stamps);
    let time = time.ok_or_else(|| {
        let advice = "give one of --rate-hz, --rate-from and --time-from";
        Failure::Usage(format!(
            "{}: the time is not said; {advice}",
            args.input.display()
        ))
    })?;
    if let Some((name, _)) = args
        .units
        .iter()
        .find(|(name, _)| !args.variables.contains(name) && args.time_from.as_ref() != Some(name))
    {
        return Err(Failure::Usage(format!(
            "`{name}` of --unit is not among the variables"
        )));
    }
    Ok(Selection {
        group: args.group.clone(),
        variables: args.variables.clone(),
        time,
        units: args.units.clone(),
    })
}

fn text_recording(args: &Args) -> Result<(Trace, Dialect), Failure> {
    if args.rate_hz.is_some() || args.rate_from.is_some() || args.group.is_some() {
        return Err(Failure::Usage(
            "--rate-hz, --rate-from and --group are for HDF5 and MATLAB files; a text file has a time column".into(),
        ));
    }
    let mut units = args.units.clone();
    let time = args.time_from.as_ref().map(|name| {
        let stated = units.iter().position(|(unit_of, _)| unit_of == name);
        let unit = stated.map_or(String::new(), |index| units.remove(index).1);
        TimeColumn {
            name: name.clone(),
            unit,
        }
    });
    let known = Known {
        time: time.as_ref(),
        hints: args.reading.hints(),
        ..csv::Known::default()
    };
    let text = csv::read_text(&args.input, &known)?;
    outcome::note(&args.input, &text.remarks);
    let (mut trace, dialect) = (text.trace, text.dialect);
    let missing = |trace: &Trace, name: &str| {
        let names = quoted(trace.channels.iter().map(|channel| channel.name.as_str()));
        let problem =
            format!("there is no column `{name}` beside the time; the columns are {names}");
        Failure::from(TraceError::Recording {
            file: args.input.clone(),
            problem,
        })
    };
    for (name, unit) in units {
        let named = trace
            .channels
            .iter_mut()
            .find(|channel| channel.name == name);
        match named {
            Some(channel) => channel.unit = unit,
            None => return Err(missing(&trace, &name)),
        }
    }
    if !args.variables.is_empty() {
        let chosen = args.variables.iter().map(|name| {
            let channel = trace.channel(name).cloned();
            channel.ok_or_else(|| missing(&trace, name))
        });
        trace.channels = chosen.collect::<Result<_, _>>()?;
    }
    Ok((trace, dialect))
}

fn list(args: &Args, arrays: Option<&Arrays>) -> Result<Outcome, Failure> {
    let file = args.input.display().to_string();
    let Some(arrays) = arrays else {
        let (trace, dialect) = text_recording(args)?;
        return report(args, &args.input, &trace, Some(dialect));
    };
    let entries = arrays.entries();
    if args.json {
        let variables: Vec<Value> = entries
            .iter()
            .map(|e| json!({ "name": e.name, "rows": e.rows, "columns": e.columns }))
            .collect();
        let left_out = arrays.passed_over().iter();
        let left_out: Vec<String> = left_out.map(PassedOver::advice).collect();
        let result = json!({ "file": file, "variables": variables, "not_read": left_out });
        return print(&result.to_string());
    }
    let lines = entries
        .iter()
        .map(|e| format!("  {}  {} × {}", e.name, e.rows, e.columns));
    let left_out = arrays.passed_over().iter();
    let left_out = left_out.map(|other| format!("  {}", other.advice()));
    let lines = std::iter::once(file).chain(lines).chain(left_out);
    let lines: Vec<String> = lines.map(|line| plain(&line)).collect();
    print(&lines.join("\n"))
}

/// Says what a recording holds.
fn report(
    args: &Args,
    file: &Path,
    trace: &Trace,
    dialect: Option<Dialect>,
) -> Result<Outcome, Failure> {
    let from_s = trace.time_s.first();
    let to_s = trace.time_s.last();
    if args.json {
        let channels: Vec<Value> = trace
            .channels
            .iter()
            .map(|c| json!({ "name": c.name, "unit": c.unit }))
            .collect();
        let file = file.display().to_string();
        let result = json!({
            "file": file, "samples": trace.len(), "from_s": from_s, "to_s": to_s, "channels": channels,
            "read_as": dialect.map(reading::in_json),
        });
        return print(&result.to_string());
    }
    let channels = trace
        .channels
        .iter()
        .map(|channel| match channel.unit.as_str() {
            "" => channel.name.clone(),
            unit => format!("{} ({unit})", channel.name),
        });
    let channels: Vec<String> = channels.collect();
    let (from_s, to_s) = (from_s.unwrap_or(&0.0), to_s.unwrap_or(&0.0));
    let said = dialect.map_or(String::new(), |dialect| {
        format!("\n{}", reading::in_words(&args.input, &dialect))
    });
    print(&format!(
        "{}: {} samples from {from_s} s to {to_s} s; {}{said}",
        file.display(),
        trace.len(),
        channels.join(", ")
    ))
}
