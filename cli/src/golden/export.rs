//! This file writes what the model computes for the golden cases as MCAP files, a file a run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use rigproof_golden::{Case, Table, computed};
use rigproof_trace::mcap::{self, Extras};
use rigproof_trace::store::Folder;
use rigproof_trace::{Channel, Trace};
use serde_json::json;

use super::chosen;
use crate::outcome::{Failure, Outcome, print};
use crate::text::section;

/// What is to be written.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder to write
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// The cases; all of them when none is given
    #[arg(value_name = "CASE")]
    names: Vec<String>,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
A run becomes CASE-RUN.mcap, with the files of its case attached; Foxglove, Lichtblick, PlotJuggler and Rerun plot it.

Example:
  rigproof golden export golden-mcap brake_step_a";

/// Computes the cases and writes their runs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let folder = Folder::begin(&args.folder)?;
    let mut written = Vec::new();
    for case in chosen(&args.names)? {
        let computed = computed(&case)?;
        let attachments = computed.files.iter().map(|(name, bytes)| {
            let kind = if name.ends_with(".csv") {
                "text/csv"
            } else {
                "application/toml"
            };
            (name.to_string(), kind.to_string(), bytes.clone())
        });
        let attachments: Vec<_> = attachments.collect();
        for number in 1..=case.runs.len() {
            let Some(trace) = trace(&computed.expected, number)? else {
                continue;
            };
            let extras = Extras {
                attachments: attachments.clone(),
                texts: texts(&case, number),
            };
            let name = format!("{}-{number}.mcap", case.name);
            let bytes = mcap::to_bytes(&trace, &extras);
            folder.write(&name, &bytes.map_err(Failure::Input)?)?;
            written.push(name);
        }
    }
    folder.finish()?;
    if args.json {
        return print(&json!({ "written": written }).to_string());
    }
    let lines = written.iter().map(|file| format!("  {file}"));
    print(&section("Written", lines).join("\n"))
}

/// The rows of a run whose time grows, and every column of numbers; `None` for a table without time.
fn trace(table: &Table, run: usize) -> Result<Option<Trace>, Failure> {
    if table.place("time").is_none() {
        return Ok(None);
    }
    let mut channels = Vec::new();
    for (name, unit) in table
        .columns
        .iter()
        .filter(|(name, _)| name != "run" && name != "time")
    {
        let cells = table.words(run, name)?;
        let samples: Result<Vec<f64>, _> = cells.iter().map(|cell| cell.parse()).collect();
        // Words are no signal.
        if let Ok(samples) = samples {
            channels.push(Channel {
                name: name.clone(),
                unit: unit.clone(),
                samples,
            });
        }
    }
    let time_s = table.numbers(run, "time")?;
    Ok(Some(Trace { time_s, channels }))
}

fn texts(case: &Case, run: usize) -> BTreeMap<String, String> {
    BTreeMap::from([
        ("case".to_string(), case.name.clone()),
        ("run".to_string(), run.to_string()),
        ("purpose".to_string(), case.purpose.clone()),
        (
            "producer".to_string(),
            format!("rigproof golden export {}", case.name),
        ),
    ])
}
