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
/// Steps a tick of the converged solution, and of the one it is compared with.
const CONVERGED: [u32; 2] = [16, 32];

const REFERENCE: &str = "reference model";
const FIXED: &str = "fixed step";
/// The schemes of the fixed-step implementation: what they are called, and steps a tick.
const SCHEMES: [(&str, Scheme, u32); 4] = [
    ("semi-implicit Euler", Scheme::SemiImplicitEuler, 1),
    ("midpoint", Scheme::Midpoint, 1),
    ("midpoint, 4 steps a ms", Scheme::Midpoint, 4),
    ("midpoint, 16 steps a ms", Scheme::Midpoint, 16),
];

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
    let [converged, finer] = CONVERGED.map(|steps| match case.joints {
        Joints::Free => run(&reference::Free::new(case, steps), case),
        Joints::Dry | Joints::Locked => run(&reference::Braked::new(case, steps), case),
    });
    folder.write_run("converged", case, &converged);
    let name = "RK4, ends a step where a brake changes";
    let mut ours = vec![match case.joints {
        Joints::Free => one(
            case,
            folder,
            REFERENCE,
            "RK4",
            &reference::Free::new(case, 1),
        ),
        _ => one(
            case,
            folder,
            REFERENCE,
            name,
            &reference::Braked::new(case, 1),
        ),
    }];
    for (settings, scheme, steps) in SCHEMES {
        ours.push(match case.joints {
            Joints::Free => one(
                case,
                folder,
                FIXED,
                settings,
                &fixed_step::Free::new(case, scheme, steps),
            ),
            _ => one(
                case,
                folder,
                FIXED,
                settings,
                &fixed_step::Braked::new(case, scheme, steps),
            ),
        });
    }
    Entry::new(case, apart_m(&converged, &finer), &ours)
}

fn one(
    case: &Case,
    folder: &Folder,
    engine: &'static str,
    settings: &'static str,
    start: &impl Engine,
) -> Ours {
    let file = format!("{engine}-{settings}").replace([' ', ','], "-");
    Ours {
        engine,
        settings,
        cost: time(start, case, REPEATS),
        run: folder.write_run(&file, case, &run(start, case)),
    }
}
