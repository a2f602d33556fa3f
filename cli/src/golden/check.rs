//! This file compares the golden cases with what the model computes now.

use std::path::PathBuf;

use rigproof_golden::{Case, Difference, FOLDER, check, orphans};
use serde_json::{Value, json};

use super::chosen;
use crate::outcome::{Failure, Outcome, print};
use crate::progress;
use crate::text::{join, section};

/// What is to be compared.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The cases; all of them when none is given
    #[arg(value_name = "CASE")]
    names: Vec<String>,
    /// The folder that holds the cases
    #[arg(long, value_name = "FOLDER", default_value = FOLDER)]
    cases: PathBuf,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Numbers stand in ten digits and must be equal in all of them. Without a case named, whatever lies in the folder and belongs to no
case is found as well.

Exit codes:
  0  every case is what the model computes
  1  a case differs
  2  the command line is wrong
  3  the folder is not there, a manifest is damaged, or a file cannot be read

Examples:
  rigproof golden check
  rigproof golden check brake_step_a --json";

/// Compares the cases and says where they differ.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let cases = chosen(&args.names)?;
    let bar = progress::bar(cases.len(), "cases");
    let mut differences = Vec::new();
    for case in &cases {
        differences.extend(check(case, &args.cases)?);
        bar.inc(1);
    }
    drop(bar);
    if args.names.is_empty() {
        differences.extend(orphans(&cases, &args.cases)?);
    }
    if args.json {
        print(&report(&cases, &differences).to_string())?;
    } else {
        print(&text(&cases, &differences))?;
    }
    Ok(Outcome {
        checks_hold: differences.is_empty(),
    })
}

fn report(cases: &[Case], differences: &[Difference]) -> Value {
    let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
    let differences = differences.iter().map(|difference| {
        let cell = difference.cell.as_ref().map(|cell| {
            json!({
                "run": cell.run, "row": cell.row, "column": cell.column, "unit": cell.unit,
                "found": cell.found, "computed": cell.computed,
            })
        });
        json!({
            "case": difference.case, "file": difference.file, "problem": difference.problem, "cell": cell,
            "command": difference.command,
        })
    });
    json!({ "checked": names, "differences": Value::from_iter(differences) })
}

fn text(cases: &[Case], differences: &[Difference]) -> String {
    let count = cases.len();
    if differences.is_empty() {
        let runs: usize = cases.iter().map(|case| case.runs.len()).sum();
        let line = format!("  {count} cases, {runs} runs: each is what the model computes");
        return join([section("Golden", [line])]);
    }
    let mut commands: Vec<String> = differences
        .iter()
        .filter_map(|difference| difference.command.as_ref())
        .map(|command| format!("  {command}"))
        .collect();
    commands.dedup();
    let found = section("Differences", differences.iter().flat_map(lines));
    if commands.is_empty() {
        return join([found]);
    }
    join([
        found,
        section("If the model is right and the case is old", commands),
    ])
}

/// A difference in one or two lines.
fn lines(difference: &Difference) -> Vec<String> {
    let Difference {
        case,
        file,
        problem,
        cell,
        ..
    } = difference;
    let mut lines = vec![format!("  {case}/{file}: {problem}")];
    if let Some(cell) = cell {
        let unit = if cell.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", cell.unit)
        };
        lines.push(format!(
            "    row {} (run {}), column `{}`: {}{unit} here, {}{unit} as computed",
            cell.row, cell.run, cell.column, cell.found, cell.computed
        ));
    }
    lines
}
