//! This file is the program as an executable; the verbs stand in the library beside it.

use std::process::ExitCode;

fn main() -> ExitCode {
    rigproof::main()
}
