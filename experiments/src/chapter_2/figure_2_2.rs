//! This file runs PADyC, figure 2.2: its four modes.

use rigproof_model::control::path::Line;
use rigproof_model::displays::{Aim, Padyc, run as run_display};
use rigproof_model::operator::{Abilities, Operator};

use super::compared::{paths, table};
use super::shown::Shown;
use super::statements::judged;
use super::tasks::TASKS;
use super::trials::of;
use crate::finding::with_unit;
use crate::{Error, Experiment, Finding, Outcome};

pub const EXPERIMENT: Experiment = Experiment {
    id: "2.2",
    title: "3-DOF PADyC Prototype",
    what: "Free, region and trajectory mode on the three tasks, nine runs each, and position mode towards a point, with two joints, \
           the arms and masses of the 3-brake layout and assumed speeds (decision 0243).",
    run,
};

fn run() -> Result<Outcome, Error> {
    let mut findings = Vec::new();
    let mut own = Vec::new();
    for task in TASKS {
        findings.push(judged(Shown::Padyc, task)?);
        own.push(of(Shown::Padyc, task)?.clone());
    }
    findings.push(position()?);
    Ok(Outcome {
        tables: vec![table(&own)?],
        pictures: vec![paths("runs", "PADyC", &[Shown::Padyc])?],
        findings,
    })
}

/// "Position mode helps the user move the tool to the desired position": the operator along the straight way to a point, and on.
fn position() -> Result<Finding, Error> {
    let refused = |error| Error::model("PADyC in position mode", error);
    let (start_m, point_m) = ([-0.04, 0.33], [0.03, 0.37]);
    let mut left_m = Vec::new();
    for run in 0..9 {
        let way = Line::through(start_m, point_m).map_err(refused)?;
        let seed = 31 + 7919 * run;
        let mut hand = Operator::new(way, Abilities::CAREFUL, seed).map_err(refused)?;
        let mut display = Padyc::new().at(start_m).map_err(refused)?;
        let ran = run_display(&mut display, &Aim::Point(point_m), &mut hand, 4.0, |_| {
            false
        });
        ran.map_err(refused)?;
        let [x, y] = display.plant().place().tip_m;
        left_m.push(libm::hypot(x - point_m[0], y - point_m[1]));
    }
    left_m.sort_by(f64::total_cmp);
    let middle_m = left_m.get(4).copied().unwrap_or(f64::NAN);
    let most_m = left_m.last().copied().unwrap_or(f64::NAN);
    let ours = format!(
        "{} left after 4 s, at most {}",
        with_unit(1e3 * middle_m, "mm"),
        with_unit(1e3 * most_m, "mm")
    );
    let because =
        "the operator along the straight way of 81 mm and on, nine runs; helped is within 1 mm";
    let stated = "helps the user to the position";
    let judged = (ours, most_m < 1e-3);
    let finding = Finding::claim("§2.2.1", "position mode", stated, judged, because);
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("padyc-modes"),
        false => finding,
    })
}
