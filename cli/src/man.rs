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
        let page = with_usage(&String::from_utf8_lossy(&page), verb);
        folder.write(&format!("{name}.1"), page.as_bytes())?;
        count += 1;
    }
    folder.finish()?;
    print(&format!("{count} pages in {}", args.out.display()))
}

/// The page with the usage of the help as its synopsis: that of `clap_mangen` leaves out what an option takes.
fn with_usage(page: &str, verb: &Command) -> String {
    const SYNOPSIS: &str = ".SH SYNOPSIS\n";
    let Some((before, rest)) = page.split_once(SYNOPSIS) else {
        return page.to_owned();
    };
    let after = rest.find(".SH ").and_then(|at| rest.get(at..));
    let usage = verb.clone().render_usage().to_string();
    let usage = usage.trim_start_matches("Usage:").replace('-', "\\-");
    let lines: Vec<&str> = usage.lines().map(str::trim).collect();
    format!(
        "{before}{SYNOPSIS}{}\n{}",
        lines.join("\n.br\n"),
        after.unwrap_or_default()
    )
}

/// The command and every command below it that a person is meant to see.
fn shown(command: &Command) -> Vec<&Command> {
    let below = command.get_subcommands();
    let below = below.filter(|verb| !verb.is_hide_set() && verb.get_name() != "help");
    std::iter::once(command)
        .chain(below.flat_map(shown))
        .collect()
}
