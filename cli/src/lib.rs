//! This file is the program: one verb a file, and what each exit code means. [`door`] is its way in for another program.
//!
//! A verb is a module with `Args` and `run`, a line in `Verb` and a line in `run`.

mod blind;
mod certify;
mod cite;
mod completions;
mod controller;
mod convert;
mod demo;
mod design;
mod diagnose;
mod diff;
pub mod door;
mod folder;
mod golden;
mod identify;
mod input;
mod inspect;
mod keep;
mod man;
mod new;
mod outcome;
mod page;
mod picture;
mod progress;
mod reading;
mod reproduce;
mod schema;
mod serve;
mod shell;
mod simulate;
mod text;
mod threads;

use std::process::ExitCode;

use clap::error::ErrorKind;
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
    /// Find out why a recording disagrees with the rig's model, and calibrate the model
    Diagnose(diagnose::Args),
    /// Say what changed between two diagnoses, or between two calibrations
    Diff(diff::Args),
    /// Run a rig's model along a recording and say how far the two lie apart
    Simulate(simulate::Args),
    /// Show the whole of it on a recording that is made for it: hide, diagnose, open the seal
    Demo(demo::Args),
    /// Lay out a folder to begin with: a rig description, a recording, three commands
    New(new::Args),
    /// Turn bench recordings into the numbers of a rig
    Identify(identify::Args),
    /// Test the diagnosis with recordings whose cause is hidden
    Blind(blind::Args),
    /// Say whether a changed controller may go on the rig
    Certify(Box<certify::Args>),
    /// Draw the workspace of a linkage, compare it with others, and rank arm lengths
    Design(design::Args),
    /// Run again what the thesis ran, and set its numbers beside ours
    Reproduce(reproduce::Args),
    /// Check the golden cases against the model, or write them anew
    Golden(golden::Args),
    /// Say where an equation of the thesis is obeyed, witnessed, and known to be wrong
    Cite(cite::Args),
    /// Say what is in a recording, and begin a rig description for it
    Inspect(inspect::Args),
    /// Turn a recording in HDF5, MATLAB, MCAP or CSV into a normalised CSV file, or into MCAP for viewers
    Convert(convert::Args),
    /// Show a folder of runs in a browser on this machine, and diagnose recordings as they come
    Serve(serve::Args),
    /// Try a compiled controller in a process of its own
    Controller(controller::Args),
    /// Print what a shell needs to complete the words of a command line
    Completions(completions::Args),
    /// Write the manual pages
    Man(man::Args),
}

const AFTER_HELP: &str = "\
Exit codes:
  0  done
  1  done, and a check did not hold
  2  the command line is wrong
  3  an input is not usable, or a file cannot be read or written

Examples:
  rigproof demo
  rigproof new my-lab
  rigproof diagnose run.csv --rig rig.toml";

fn run(verb: &Verb) -> Result<Outcome, Failure> {
    match verb {
        Verb::Diagnose(args) => diagnose::run(args),
        Verb::Diff(args) => diff::run(args),
        Verb::Simulate(args) => simulate::run(args),
        Verb::Demo(args) => demo::run(args),
        Verb::New(args) => new::run(args),
        Verb::Identify(args) => identify::run(args),
        Verb::Blind(args) => blind::run(args),
        Verb::Certify(args) => certify::run(args),
        Verb::Design(args) => design::run(args),
        Verb::Reproduce(args) => reproduce::run(args),
        Verb::Golden(args) => golden::run(args),
        Verb::Cite(args) => cite::run(args),
        Verb::Inspect(args) => inspect::run(args),
        Verb::Convert(args) => convert::run(args),
        Verb::Serve(args) => serve::run(args),
        Verb::Controller(args) => controller::run(args),
        Verb::Completions(args) => completions::run(args),
        Verb::Man(args) => man::run(args),
    }
}

/// Reads the command line, does what it says, and gives the exit code.
pub fn main() -> ExitCode {
    match Program::try_parse() {
        Ok(program) => outcome::exit(run(&program.verb)),
        Err(error) => refused(&error),
    }
}

/// Says what is wrong with a command line; where the rig description is missing, also how to begin one.
fn refused(error: &clap::Error) -> ExitCode {
    // Nobody is left to be told when this fails.
    let _ = error.print();
    if error.kind() == ErrorKind::MissingRequiredArgument && error.to_string().contains("--rig <") {
        eprintln!("\n{BEGIN_A_RIG}");
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

const BEGIN_A_RIG: &str = "\
No rig description yet? This begins one from a recording:
  rigproof inspect RECORDING --write-rig rig.toml";

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Command, CommandFactory};

    /// Every verb and every verb below a verb.
    fn verbs(command: &Command) -> Vec<Command> {
        let below = command.get_subcommands();
        let below = below.filter(|verb| verb.get_name() != "help");
        below
            .flat_map(|verb| std::iter::once(verb.clone()).chain(verbs(verb)))
            .collect()
    }

    /// The commands of the examples, continued lines joined.
    fn examples(help: &str) -> Vec<String> {
        let (_, examples) = help.split_once("Example").unwrap();
        let joined = examples.replace("\\\n", " ");
        let lines = joined.lines().map(str::trim);
        let commands = lines.filter(|line| line.starts_with("rigproof "));
        commands.map(|line| line.replace('\'', "")).collect()
    }

    #[test]
    fn the_help_of_every_verb_ends_with_examples_that_are_right() {
        let program = Program::command();
        let verbs = verbs(&program);
        assert!(verbs.len() >= 8);
        for verb in std::iter::once(program).chain(verbs) {
            let name = verb.get_name();
            let help = verb.get_after_help().unwrap().to_string();
            let examples = examples(&help);
            assert!(!examples.is_empty(), "{name}");
            for example in examples {
                let parsed = Program::try_parse_from(example.split_whitespace());
                assert!(parsed.is_ok(), "{example}: {}", parsed.err().unwrap());
            }
        }
    }
}
