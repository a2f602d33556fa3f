//! This program is the host by itself, for the tests of this room; and it takes the time of a controller's ticks in it.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use rigproof_certify::controller::{Failure, Source, Task};
use rigproof_certify::foreign::{Foreign, Host, Limits};
use rigproof_certify_host::{Role, run};
use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

const USAGE: &str = "usage: rigproof-controller-host watch|work LIBRARY MEMORY_BYTES
       rigproof-controller-host time LIBRARY TICKS";

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
        Some(role) => run(role, PathBuf::from(library), number),
        None if role == "time" => match time(Path::new(library), number) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => {
                eprintln!("error: {failure}");
                ExitCode::from(1)
            }
        },
        None => usage(),
    }
}

fn usage() -> ExitCode {
    eprintln!("{USAGE}");
    ExitCode::from(2)
}

/// Prints how long the ticks of one trial take, there and back.
fn time(library: &Path, ticks: u64) -> Result<(), Failure> {
    let host = Host {
        program: PathBuf::from("/proc/self/exe"),
        words: Vec::new(),
    };
    let foreign = Foreign::new(library, host, Limits::default())?;
    let settings = Settings::thesis(Layout::FourBrake);
    let line = Task::Chain(vec![[-0.113, 0.383], [0.107, 0.412]]);
    let mut controller = foreign.begin(&settings, &line)?;
    let mut times_us = Vec::new();
    for number in 0..ticks {
        let sensed = Sensed {
            number: number as u32,
            counts: [33_421, 14_327],
            tip_force_n: Vector::new(1.3, -2.7),
        };
        let begun = Instant::now();
        controller.tick(&sensed)?;
        times_us.push(begun.elapsed().as_secs_f64() * 1e6);
    }
    times_us.sort_by(f64::total_cmp);
    let at = |part: f64| times_us.get((part * times_us.len() as f64) as usize);
    if let (Some(half), Some(most), Some(nearly_all)) = (at(0.5), at(0.9), at(0.999)) {
        println!(
            "{ticks} ticks: median {half:.1} us, 90 % within {most:.1} us, 99.9 % within {nearly_all:.1} us"
        );
    }
    Ok(())
}
