//! This program writes the runs that `docs/compare` sets side by side with other engines, and what a step of ours costs.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a program that compares stops at the first surprise"
)]

mod case;
mod engine;
mod fixed_step;
mod output;
mod reference;
mod timing;

use std::path::PathBuf;

use rigproof_impl::plant::Scheme;

use case::{Case, Joints};
use engine::{Engine, apart_m, run, time};
use output::{Entry, Folder, Ours};

/// How often a run is timed.
const REPEATS: usize = 15;
/// Steps a millisecond of the converged solution, and of the one it is compared with.
const CONVERGED: [f64; 2] = [16.0, 32.0];

const REFERENCE: &str = "reference model";
const FIXED: &str = "fixed step";
/// The schemes of the fixed-step implementation: what they are called, and steps a tick.
const SCHEMES: [(&str, Scheme, &[u32]); 2] = [
    ("semi-implicit Euler", Scheme::SemiImplicitEuler, &[1]),
    ("midpoint", Scheme::Midpoint, &[1, 4, 16]),
];
/// The same where the tick is long: steps of 8 ms to 1/16 ms.
const WORK: [(&str, Scheme, &[u32]); 2] = {
    let steps = &[1, 2, 4, 8, 16, 32, 64, 128];
    [
        ("semi-implicit Euler", Scheme::SemiImplicitEuler, steps),
        ("midpoint", Scheme::Midpoint, steps),
    ]
};

fn main() {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("name the folder to write to");
        std::process::exit(2);
    };
    let folder = Folder::new(PathBuf::from(path));
    let entries = Case::all()
        .iter()
        .map(|case| entry(case, &folder))
        .collect();
    folder.write_index(entries);
}

fn entry(case: &Case, folder: &Folder) -> Entry {
    let one_a_ms = case.tick_s() * 1e3;
    let [converged, finer] = CONVERGED.map(|steps_a_ms| {
        let steps = libm::round(steps_a_ms * one_a_ms) as u32;
        match case.joints {
            Joints::Free => run(&reference::Free::new(case, steps), case),
            _ => run(&reference::Braked::new(case, steps), case),
        }
    });
    folder.write_run("converged", case, &converged);
    let one = |engine, settings, steps| Line {
        case,
        folder,
        engine,
        settings,
        steps,
    };
    let of_the_reference = one(REFERENCE, "RK4", libm::round(one_a_ms) as u32);
    let mut ours = vec![match case.joints {
        Joints::Free => of_the_reference.of(&reference::Free::new(case, of_the_reference.steps)),
        _ => Line {
            settings: "RK4, ends a step where a brake changes",
            ..of_the_reference
        }
        .of(&reference::Braked::new(case, of_the_reference.steps)),
    }];
    let schemes = match case.joints {
        Joints::Work => WORK,
        _ => SCHEMES,
    };
    for (settings, scheme, all_steps) in schemes {
        for steps in all_steps {
            let line = one(FIXED, settings, *steps);
            ours.push(match case.joints {
                Joints::Free => line.of(&fixed_step::Free::new(case, scheme, *steps)),
                _ => line.of(&fixed_step::Braked::new(case, scheme, *steps)),
            });
        }
    }
    Entry::new(case, apart_m(&converged, &finer), &ours)
}

/// One engine with its settings on a case.
#[derive(Clone, Copy)]
struct Line<'a> {
    case: &'a Case,
    folder: &'a Folder,
    engine: &'static str,
    settings: &'static str,
    steps: u32,
}

impl Line<'_> {
    /// Its run, written down, and what that costs.
    fn of(&self, start: &impl Engine) -> Ours {
        let file = format!("{}-{}-{}", self.engine, self.settings, self.steps);
        let file = file.replace([' ', ','], "-");
        Ours {
            engine: self.engine,
            settings: self.settings,
            steps: self.steps,
            cost: time(start, self.case, REPEATS),
            run: self
                .folder
                .write_run(&file, self.case, &run(start, self.case)),
        }
    }
}
