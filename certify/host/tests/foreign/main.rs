//! This file says that whatever a compiled controller does ends in a finding, and that nothing of it stays.
#![cfg(target_os = "linux")]

mod axis;
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
fn the_headers_are_what_cbindgen_makes() {
    is_made("cbindgen.toml", "rigproof_controller.h");
    is_made("cbindgen-axis.toml", "rigproof_axis_controller.h");
}

fn is_made(config: &str, header: &str) {
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join(header);
    let cbindgen = Command::new("cbindgen")
        .args(["--quiet", "--config", config, "--output"])
        .arg(&made)
        .current_dir(bench::ROOM)
        .status();
    let Ok(status) = cbindgen else {
        println!("no cbindgen: the header was not made again (cargo install cbindgen)");
        return;
    };
    assert!(status.success());
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let kept = Path::new(bench::ROOM).join("../c/include").join(header);
    assert!(read(&made) == read(&kept), "run `make header` in certify/c");
}
