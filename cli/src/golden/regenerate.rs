//! This file writes golden cases anew from the model.

use std::path::PathBuf;

use rigproof_golden::{FOLDER, regenerate};
use serde_json::{Value, json};

use super::chosen;
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::{join, section};

/// What is to be written.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The cases; all of them when none is given
    #[arg(value_name = "CASE")]
    names: Vec<String>,
    /// The folder that holds the cases
    #[arg(long, value_name = "FOLDER", default_value = FOLDER)]
    cases: PathBuf,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
A file is written only when its bytes change. A change of a number is a commit of its own that says which equation moved.

Examples:
  rigproof golden regenerate
  rigproof golden regenerate brake_step_a path_three_brake";

/// Computes the cases and writes what changed.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let cases = chosen(&args.names)?;
    let bar = progress::bar(cases.len(), "cases");
    let mut written = Vec::new();
    for case in &cases {
        for file in regenerate(case, &args.cases)? {
            written.push(format!("{}/{file}", case.name));
        }
        bar.inc(1);
    }
    drop(bar);
    if args.json {
        let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        let written = Value::from_iter(written);
        return print(&json!({ "computed": names, "written": written }).to_string());
    }
    let unchanged = 3 * cases.len() - written.len();
    let lines = written.iter().map(|file| format!("  {file}"));
    let unchanged = format!("  as they were: {unchanged}");
    print(&join([section("Written", lines.chain([unchanged]))]))
}
