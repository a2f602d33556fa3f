//! This program is the host by itself, for the tests of this room; and it tries a controller with it.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use rigproof_certify::controller::Failure;
use rigproof_certify::foreign::{Foreign, Host, Limits};
use rigproof_certify_host::{Role, run, try_out};
use rigproof_spec::layout::Layout;

const USAGE: &str = "usage: rigproof-controller-host watch|work LIBRARY MEMORY_BYTES
       rigproof-controller-host try LIBRARY TICKS";

fn main() -> ExitCode {
    let words: Vec<_> = std::env::args_os().skip(1).collect();
    let [role, library, number] = words.as_slice() else {
        return usage();
    };
    let (Some(role), Some(number)) = (role.to_str(), number.to_str()) else {
        return usage();
    };
    let Ok(number) = number.parse::<u64>() else {
        return usage();
    };
    match Role::of(role) {
        Some(role) => ExitCode::from(run(role, PathBuf::from(library), number)),
        None if role == "try" => match tried(Path::new(library), number) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => {
                eprintln!("error: {failure}");
                ExitCode::FAILURE
            }
        },
        None => usage(),
    }
}

fn usage() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}

fn tried(library: &Path, ticks: u64) -> Result<(), Failure> {
    let host = Host {
        program: PathBuf::from("/proc/self/exe"),
        words: Vec::new(),
    };
    let source = Foreign::new(library, host, Limits::default())?;
    let ticks = u32::try_from(ticks).unwrap_or(u32::MAX);
    println!("{:?}", try_out(&source, Layout::FourBrake, ticks)?);
    Ok(())
}
