//! This file writes the manual pages.

use std::path::PathBuf;

use clap::{Command, CommandFactory};
use clap_mangen::Man;
use rigproof_trace::store::Folder;

use crate::outcome::{Failure, Outcome, print};

/// Where the pages go.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder to write
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

const AFTER_HELP: &str = "\
One page for the program and one for each verb, such as rigproof-diagnose.1; `man -l FOLDER/rigproof.1` shows one.

Example:
  rigproof man --out man1";

/// Writes a page for the program and each of its verbs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let mut program = crate::Program::command();
    program.build();
    let folder = Folder::begin(&args.out)?;
    let mut count = 0;
    for verb in shown(&program) {
        let name = verb
            .get_display_name()
            .unwrap_or(verb.get_name())
            .to_owned();
        let mut page = Vec::new();
        let failed = |error| Failure::Input(format!("cannot write the page of {name}: {error}"));
        Man::new(verb.clone()).render(&mut page).map_err(failed)?;
        folder.write(&format!("{name}.1"), &page)?;
        count += 1;
    }
    folder.finish()?;
    print(&format!("{count} pages in {}", args.out.display()))
}

/// The command and every command below it that a person is meant to see.
fn shown(command: &Command) -> Vec<&Command> {
    let below = command.get_subcommands();
    let below = below.filter(|verb| !verb.is_hide_set() && verb.get_name() != "help");
    std::iter::once(command)
        .chain(below.flat_map(shown))
        .collect()
}
