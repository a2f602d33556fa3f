//! This file builds controllers in C for the tests, runs trials with them, and looks for processes that are left.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use rigproof_certify::controller::{Controller, Failure, Source, Task};
use rigproof_certify::foreign::{Foreign, Host, Limits};
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

pub const ROOM: &str = env!("CARGO_MANIFEST_DIR");

/// What a controller without a fault answers.
pub const SOUND_A: [f64; 4] = [0.25, 0.0, 0.0, 0.0];

/// The C compiler, if there is one.
pub fn compiler() -> Option<String> {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let answers = Command::new(&compiler).arg("--version").output().is_ok();
    answers.then_some(compiler)
}

/// A shared library of this name from a source in C and what else the compiler is told; `None` without a C compiler.
pub fn compiled(name: &str, source: &str, told: &[&str]) -> Option<PathBuf> {
    let Some(compiler) = compiler() else {
        println!("no C compiler: {source} was not built");
        return None;
    };
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.so"));
    let output = Command::new(compiler)
        .args(["-std=c11", "-O1", "-shared", "-fPIC", "-ffp-contract=off"])
        .arg(format!("-I{ROOM}/../c/include"))
        .arg(format!("-I{ROOM}/../../impl/c/include"))
        .arg("-o")
        .arg(&library)
        .arg(Path::new(ROOM).join(source))
        .args(told)
        .arg("-lm")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{source}: {said}");
    Some(library)
}

/// The controller with faults: pairs of a place and the code that is put there.
pub fn faulty(name: &str, faults: &[(&str, &str)]) -> Option<PathBuf> {
    let faults: Vec<String> = faults
        .iter()
        .map(|(place, code)| format!("-D{place}={code}"))
        .collect();
    let mut told: Vec<&str> = faults.iter().map(String::as_str).collect();
    // What is wrong on purpose is not told of.
    told.push("-w");
    compiled(&format!("faulty_{name}"), "tests/foreign/faulty.c", &told)
}

/// Limits that a test has the patience for.
pub fn limits() -> Limits {
    Limits {
        start_ms: 3000,
        tick_ms: Some(700),
        ..Limits::default()
    }
}

pub fn foreign(library: &Path, limits: Limits) -> Foreign {
    let host = Host {
        program: PathBuf::from(env!("CARGO_BIN_EXE_rigproof-controller-host")),
        words: Vec::new(),
    };
    Foreign::new(library, host, limits).unwrap()
}

pub fn line() -> Task {
    Task::Chain(vec![[-0.113, 0.383], [0.107, 0.412]])
}

pub fn begin(foreign: &Foreign) -> Result<Box<dyn Controller + '_>, Failure> {
    foreign.begin(&Settings::thesis(Layout::FourBrake), &line())
}

pub fn sensed(number: u32) -> Sensed<f64> {
    Sensed {
        number,
        counts: [33_421, 14_327],
        tip_force_n: Vector::new(1.3, -2.7),
    }
}

/// A trial of so many ticks and its end: the first failure, or the currents of the last.
pub fn trial(foreign: &Foreign, ticks: u32) -> Result<[f64; 4], Failure> {
    let mut controller = begin(foreign)?;
    let mut last_a = [f64::NAN; 4];
    for number in 0..ticks {
        last_a = controller.tick(&sensed(number))?;
    }
    controller.end().map(|()| last_a)
}

/// What stands on the command lines of a library's processes: its whole path, since the tests may run elsewhere too.
pub fn named(library: &Path) -> String {
    let library = library.canonicalize().unwrap();
    library.to_str().unwrap().to_owned()
}

/// The processes whose command line holds this, with their numbers. One that has ended and was not waited for has none.
pub fn running(part: &str) -> Vec<u32> {
    let numbered = std::fs::read_dir("/proc").unwrap().filter_map(|entry| {
        let name = entry.ok()?.file_name();
        name.to_str()?.parse::<u32>().ok()
    });
    let mut found: Vec<u32> = numbered
        .filter(|number| *number != std::process::id())
        .filter(|number| {
            let words = std::fs::read(format!("/proc/{number}/cmdline")).unwrap_or_default();
            String::from_utf8_lossy(&words).contains(part)
        })
        .collect();
    found.sort_unstable();
    found
}

/// Waits until so many processes hold this on their command line, and gives them; fails after a while.
pub fn wait_for(part: &str, count: usize) -> Vec<u32> {
    let begun = Instant::now();
    loop {
        let found = running(part);
        if found.len() == count {
            return found;
        }
        let late = begun.elapsed() > Duration::from_secs(5);
        assert!(!late, "{} processes with {part}, not {count}", found.len());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Whether a process of this number is there, also one that has ended and was not waited for.
pub fn is_there(number: u32) -> bool {
    Path::new(&format!("/proc/{number}")).exists()
}
