//! This file is the verb of the golden cases: what the model computed, checked in.

mod check;
mod export;
mod regenerate;

use clap::Subcommand;
use rigproof_golden::{Case, cases};

use crate::outcome::{Failure, Outcome};

/// What is to be done with the golden cases.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Compare the checked-in cases with what the model computes now
    Check(check::Args),
    /// Write cases anew from the model
    Regenerate(regenerate::Args),
    /// Write what the model computes as MCAP files, to look at
    Export(export::Args),
}

const AFTER_HELP: &str = "\
A case is a folder with manifest.toml, input.csv and expected.csv. Nothing but `golden regenerate` writes one.

Example:
  rigproof golden check
  rigproof golden regenerate brake_step_a
  rigproof golden export golden-mcap brake_step_a";

/// Runs one of the verbs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    match &args.verb {
        Verb::Check(args) => check::run(args),
        Verb::Regenerate(args) => regenerate::run(args),
        Verb::Export(args) => export::run(args),
    }
}

/// The cases of these names; all of them when none is given.
fn chosen(names: &[String]) -> Result<Vec<Case>, Failure> {
    let all = cases();
    for name in names {
        if !all.iter().any(|case| case.name == *name) {
            let known: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
            let advice = rigproof_trace::suggest::advice(name, "cases", &known);
            return Err(Failure::Usage(format!(
                "`{name}` is no golden case; {advice}"
            )));
        }
    }
    let wanted = |case: &Case| names.is_empty() || names.contains(&case.name);
    Ok(all.into_iter().filter(wanted).collect())
}
