//! This file runs Osaka's ER display, figure 2.3: two brakes, locked at a wall, alternating in a track.

use super::compared::{paths, table};
use super::shown::Shown;
use super::statements::judged;
use super::tasks::TASKS;
use super::trials::of;
use crate::{Error, Experiment, Outcome};

pub const EXPERIMENT: Experiment = Experiment {
    id: "2.3",
    title: "Dissipative Passive Haptic Display with ER Fluid Brakes",
    what: "Free motion, a virtual wall by locking both brakes and a line by alternating them in a track, nine runs each, with the arms and \
           masses of the 3-brake layout and assumed brakes (decision 0242).",
    run,
};

fn run() -> Result<Outcome, Error> {
    let mut findings = Vec::new();
    let mut own = Vec::new();
    for task in TASKS {
        findings.push(judged(Shown::Osaka, task)?);
        own.push(of(Shown::Osaka, task)?.clone());
    }
    Ok(Outcome {
        tables: vec![table(&own)?],
        pictures: vec![paths("runs", "Osaka's ER display", &[Shown::Osaka])?],
        findings,
    })
}
