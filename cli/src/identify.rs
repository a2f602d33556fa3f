//! This file is the verb that turns recordings into the numbers of a rig.

mod brake;
mod words;

use clap::Subcommand;

use crate::outcome::{Failure, Outcome};

/// What is to be identified.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Turn bench recordings of a brake into its table: torque gain, time constants, backlash
    Brake(brake::Args),
}

const AFTER_HELP: &str = "\
Example:
  rigproof identify brake steps-0.5-rpm.csv steps-4-rpm.csv sine.csv --rig bench.toml --out brake.toml";

/// Runs one of the verbs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    match &args.verb {
        Verb::Brake(args) => brake::run(args),
    }
}
