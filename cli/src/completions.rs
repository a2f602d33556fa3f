//! This file writes what a shell needs to complete the program's words.

use clap::CommandFactory;
use clap_complete::{Shell, generate};

use crate::outcome::{Failure, Outcome, print};

/// For which shell.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

const AFTER_HELP: &str = "\
Put what is printed where the shell looks: for bash ~/.local/share/bash-completion/completions/rigproof, for zsh _rigproof in a
folder of fpath, for fish ~/.config/fish/completions/rigproof.fish; a shell that is started afterwards completes.

Examples:
  rigproof completions bash
  rigproof completions zsh";

/// Prints the script.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    generate(
        args.shell,
        &mut crate::Program::command(),
        "rigproof",
        &mut script,
    );
    print(String::from_utf8_lossy(&script).trim_end())
}
