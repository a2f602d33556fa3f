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
Examples, for a shell that is started afterwards:
  rigproof completions bash > ~/.local/share/bash-completion/completions/rigproof
  rigproof completions zsh > ~/.zfunc/_rigproof
  rigproof completions fish > ~/.config/fish/completions/rigproof.fish";

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
