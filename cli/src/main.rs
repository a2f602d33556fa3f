//! This file is the program: one verb a file, and what each exit code means.
//!
//! A verb is a module with `Args` and `run`, a line in [`Verb`] and a line in [`run`].

mod convert;
mod outcome;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::outcome::{Failure, Outcome};

/// Finds the physics that a rig's model left out, and shows the fit improve
#[derive(Parser)]
#[command(name = "rigproof", version, after_help = AFTER_HELP, arg_required_else_help = true)]
struct Program {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Turn a recording in HDF5, MATLAB or CSV into a normalised CSV file
    Convert(convert::Args),
}

const AFTER_HELP: &str = "\
Exit codes:
  0  done
  1  done, and a check did not hold
  2  the command line is wrong
  3  an input is not usable, or a file cannot be read or written

Example:
  rigproof convert --list test.h5
  rigproof convert test.h5 multisine.csv --group multisine --variables u,y --rate-from fs \\
      --unit u=N --unit y=m";

fn run(verb: &Verb) -> Result<Outcome, Failure> {
    match verb {
        Verb::Convert(args) => convert::run(args),
    }
}

fn main() -> ExitCode {
    outcome::exit(run(&Program::parse().verb))
}
