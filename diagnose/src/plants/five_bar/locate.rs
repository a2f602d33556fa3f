//! This file defines the regimes of a five-bar: by joint, by equation and by time.

use super::run::{FiveBarRun, place, place_of};
use crate::cause::Place;
use crate::locate::{Cell, Regimes};
use crate::plant::Run;
use crate::rules::ON_A;
use crate::weak::Windows;
use rigproof_model::effects::Instant;
use rigproof_spec::joint::Joint;
use rigproof_spec::units::RAD_S_PER_RPM;

/// The regimes of each joint, and the thirds of the recording.
pub fn regimes(run: &FiveBarRun, windows: &Windows) -> Regimes {
    let mut cells: Vec<Cell> = Joint::ALL
        .into_iter()
        .flat_map(|joint| joint_cells(run, windows, joint))
        .collect();
    let third = run.clock().duration_s() / 3.0;
    for (label, rule) in [
        ("first third of the recording", (f64::NEG_INFINITY, third)),
        ("last third of the recording", (2.0 * third, f64::INFINITY)),
    ] {
        let times = windows.times_s().into_iter();
        let inside = times.map(|t| (rule.0..rule.1).contains(&(t - run.start_s)));
        cells.push(Cell {
            label,
            at: Place::Whole,
            member: inside.collect(),
        });
    }
    for (output, label) in [(0, "balance of arm AE (θA)"), (1, "balance of arm BC (θB)")] {
        let rows = 0..windows.centres.len();
        cells.push(Cell {
            label,
            at: Place::Whole,
            member: rows
                .map(|row| {
                    row % windows.outputs == output && windows.combined.get(row) == Some(&None)
                })
                .collect(),
        });
    }
    Regimes {
        output: "efforts of θA and θB",
        counted: windows.usable.clone(),
        cells,
    }
}

fn joint_cells(run: &FiveBarRun, windows: &Windows, joint: Joint) -> Vec<Cell> {
    let motion = run.motion_of(joint);
    let current = run.currents.get(place(joint)).and_then(Option::as_ref);
    let cell = |label, rule: &dyn Fn(usize, &Instant) -> bool| {
        let centres = windows.centres.iter();
        let inside = centres.map(|&k| motion.get(k).is_some_and(|now| rule(k, now)));
        Cell {
            label,
            at: place_of(Some(joint)),
            member: inside.collect(),
        }
    };
    let rpm = |now: &Instant| now.speed.abs() / RAD_S_PER_RPM;
    let on = |k: usize| current.and_then(|c| c.get(k)).is_some_and(|c| *c > ON_A);
    let mut cells = vec![
        cell("slow (below 0.5 rpm)", &|_, now| rpm(now) < 0.5),
        cell("0.5 to 4 rpm", &|_, now| (0.5..4.0).contains(&rpm(now))),
        cell("fast (above 4 rpm)", &|_, now| rpm(now) >= 4.0),
        cell("turning in the positive sense", &|_, now| now.sense > 0.0),
        cell("turning in the negative sense", &|_, now| now.sense < 0.0),
    ];
    if current.is_some() {
        cells.push(cell("brake on", &|k, _| on(k)));
        cells.push(cell("brake off", &|k, _| !on(k)));
    }
    cells
}
