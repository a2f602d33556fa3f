//! This file looks for Kani, and type-checks its harnesses where it is not.

use std::path::Path;
use std::process::{Command, Stdio};

/// What proves every harness, where Kani is set up.
pub const COMMAND: &str = "cargo kani -p rigproof-impl";

/// Whether `cargo kani --version` succeeds. That a program of that name is there says nothing.
pub fn is_set_up(root: &Path) -> bool {
    succeeds(
        Command::new("cargo")
            .args(["kani", "--version"])
            .current_dir(root),
    )
}

/// Whether Kani proves every harness.
pub fn proves(root: &Path) -> bool {
    succeeds(
        Command::new("cargo")
            .args(["kani", "-p", "rigproof-impl"])
            .current_dir(root),
    )
}

/// Whether every harness compiles against the types of Kani's functions.
pub fn harnesses_type_check(root: &Path, target: &Path) -> bool {
    succeeds(
        Command::new("cargo")
            .args(["check", "--quiet", "-p", "rigproof-impl"])
            .arg("--target-dir")
            .arg(target)
            .env("RUSTFLAGS", "--cfg kani --cfg kani_shim")
            .current_dir(root),
    )
}

fn succeeds(command: &mut Command) -> bool {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}
