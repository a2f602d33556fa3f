//! This file says what changed between two diagnoses, or between two calibrations.

mod change;
mod page;
mod side;

use std::path::PathBuf;

use rigproof_trace::store;
use serde_json::json;

use crate::keep;
use crate::outcome::{Failure, Outcome, print};
use change::changes;
use side::Side;

/// What is to be compared.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder of a diagnosis, or a calibration
    #[arg(value_name = "A")]
    one: PathBuf,
    /// Another of the same kind
    #[arg(value_name = "B")]
    other: PathBuf,
    /// A page to write: what changed, and the curves of both on one chart
    #[arg(long, value_name = "HTML")]
    html: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
A number changed for certain where the two 95 % intervals do not meet; where they do, the change may be chance.

Examples:
  rigproof diff run-diagnosis run-diagnosis-2
  rigproof diff monday/calibration.toml friday/calibration.toml --json
  rigproof diff monday friday --html what-changed.html";

/// Reads both, compares them, and says what changed.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let (one, other) = (Side::read(&args.one)?, Side::read(&args.other)?);
    if one.is_diagnosis != other.is_diagnosis {
        let problem = "one is a diagnosis and the other a calibration; give two of a kind";
        return Err(Failure::Usage(problem.to_owned()));
    }
    let changes = changes(&one, &other);
    if let Some(file) = &args.html {
        keep::check(file, [&args.one, &args.other])?;
        let page = page::page((&one, &other), &changes);
        store::write_aside(file, page.as_bytes())?;
    }
    if args.json {
        let all: Vec<_> = changes.iter().map(change::Change::json).collect();
        let result = json!({
            "one": one.name, "other": other.name, "same": changes.is_empty(), "changes": all,
            "file": args.html.as_ref().map(|file| file.display().to_string()),
        });
        return print(&result.to_string());
    }
    let mut lines = vec![match changes.len() {
        0 => format!("{} and {} say the same.", one.name, other.name),
        1 => format!("One thing changed from {} to {}:", one.name, other.name),
        count => format!(
            "{count} things changed from {} to {}:",
            one.name, other.name
        ),
    }];
    lines.extend(changes.iter().map(|own| format!("  {}", own.words())));
    lines.extend(
        args.html
            .iter()
            .map(|file| format!("  page   {}", file.display())),
    );
    print(&lines.join("\n"))
}
