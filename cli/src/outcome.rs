//! This file says how a verb ends: its exit code, its one line of error, and its output.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use rigproof_trace::TraceError;

/// How a verb ended that did its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Whether every check held: exit code 0, or 1 when one did not.
    pub checks_hold: bool,
}

impl Outcome {
    /// The work is done and nothing was to be checked.
    pub const DONE: Outcome = Outcome { checks_hold: true };
}

/// Why a verb could not do its work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The command line is wrong in a way its parser cannot see; exit code 2.
    Usage(String),
    /// An input is not usable, or a file cannot be read or written; exit code 3.
    Input(String),
}

impl Failure {
    /// A file that can be read but not used, and why.
    pub fn unusable(file: &Path, problem: String) -> Failure {
        let file = file.to_path_buf();
        TraceError::Recording { file, problem }.into()
    }
}

impl From<rigproof_blind::Error> for Failure {
    fn from(error: rigproof_blind::Error) -> Failure {
        Failure::Input(error.to_string())
    }
}

impl From<rigproof_model::ModelError> for Failure {
    fn from(error: rigproof_model::ModelError) -> Failure {
        Failure::Input(error.to_string())
    }
}

impl From<rigproof_experiments::Error> for Failure {
    fn from(error: rigproof_experiments::Error) -> Failure {
        Failure::Input(error.to_string())
    }
}

impl From<rigproof_golden::Error> for Failure {
    fn from(error: rigproof_golden::Error) -> Failure {
        Failure::Input(error.to_string())
    }
}

impl From<TraceError> for Failure {
    fn from(error: TraceError) -> Failure {
        Failure::Input(error.to_string())
    }
}

/// Prints the error, if there is one, and gives the exit code.
pub fn exit(result: Result<Outcome, Failure>) -> ExitCode {
    let (code, message) = match result {
        Ok(outcome) => return ExitCode::from(u8::from(!outcome.checks_hold)),
        Err(Failure::Usage(message)) => (2, message),
        Err(Failure::Input(message)) => (3, message),
    };
    // An input may hold anything; the message stays on one line and cannot steer the terminal.
    // Nobody is left to be told when this fails.
    let _ = writeln!(io::stderr(), "error: {}", plain(&message));
    ExitCode::from(code)
}

/// Says beside the result how a file was read and what of it is missing.
pub fn note(file: &Path, lines: &[String]) {
    for line in lines {
        // Nobody is left to be told when this fails.
        let _ = writeln!(io::stderr(), "{}: {}", file.display(), plain(line));
    }
}

/// A text of an input as it may be printed: nothing in it steers the terminal or ends the line.
pub fn plain(text: &str) -> String {
    let shown = |character: char| match character.is_control() {
        true => '\u{fffd}',
        false => character,
    };
    text.chars().map(shown).collect()
}

/// A text of several lines that cannot steer the terminal, nor end an XML file that it stands in.
pub fn steady(text: &str) -> String {
    let shown = |character: char| match character {
        '\n' | '\t' => character,
        '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        _ if character.is_control() => '\u{fffd}',
        _ => character,
    };
    text.chars().map(shown).collect()
}

/// Prints the result of a verb on standard output; a reader that went away is no error.
pub fn print(text: &str) -> Result<Outcome, Failure> {
    // What an input is called may stand in it.
    print_steadied(&steady(text))
}

/// Prints a text that holds marks for a terminal; what comes from an input must be [`steady`] already.
pub fn print_steadied(text: &str) -> Result<Outcome, Failure> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Input(format!("cannot write the result: {error}")))
        }
        _ => Ok(Outcome::DONE),
    }
}
