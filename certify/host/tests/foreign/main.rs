//! This file says that whatever a compiled controller does ends in a finding, and that nothing of it stays.
#![cfg(target_os = "linux")]

mod bench;
mod examples;
mod faults;
mod hostile;
mod planted;
mod planted_law;
mod processes;
mod trials;

use std::path::Path;
use std::process::Command;

#[test]
fn the_header_is_what_cbindgen_makes() {
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rigproof_controller.h");
    let cbindgen = Command::new("cbindgen")
        .args(["--quiet", "--config", "cbindgen.toml", "--output"])
        .arg(&made)
        .current_dir(bench::ROOM)
        .status();
    let Ok(status) = cbindgen else {
        println!("no cbindgen: the header was not made again (cargo install cbindgen)");
        return;
    };
    assert!(status.success());
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let kept = Path::new(bench::ROOM).join("../c/include/rigproof_controller.h");
    assert!(read(&made) == read(&kept), "run `make header` in certify/c");
}
