//! This file runs PTER, figure 2.4: its four local paths, its three tasks, and what its clutches cost it.

use rigproof_model::displays::{Aim, Pter};
use rigproof_spec::displays::{ClutchFigures, PTER_CLUTCH};
use rigproof_spec::methods::SAMPLE_STEP_S;

use super::compared::{paths, table};
use super::shown::{Shown, of_a_display};
use super::statements::judged;
use super::tasks::{TASKS, Task};
use super::trials::{Measured, measure, of};
use crate::finding::with_unit;
use crate::{Error, Experiment, Finding, Outcome};

pub const EXPERIMENT: Experiment = Experiment {
    id: "2.4",
    title: "PTER (Passive Trajectory Enhancing Robot)",
    what: "Free motion, a virtual wall by local paths and a line by velocity ratio control, nine runs each, with the arms and masses of \
           the 3-brake layout and clutches whose figures are assumed (decision 0241).",
    run,
};

fn run() -> Result<Outcome, Error> {
    let mut findings = vec![local_paths()?];
    let mut own = Vec::new();
    for task in TASKS {
        findings.push(judged(Shown::Pter, task)?);
        own.push(of(Shown::Pter, task)?.clone());
    }
    findings.push(actuators()?);
    Ok(Outcome {
        tables: vec![table(&own)?],
        pictures: vec![paths("runs", "PTER", &[Shown::Pter])?],
        findings,
    })
}

/// "PTER is capable of locking the tip into any one of four local SDOF paths": the links' rates with each clutch locked.
fn local_paths() -> Result<Finding, Error> {
    let refused = |error| Error::model("PTER with a clutch locked", error);
    let mut texts = Vec::new();
    let mut all = true;
    for clutch in 0..4 {
        let start_m = [0.037, 0.353];
        let mut display = Pter::new()
            .with_locked(clutch)
            .at(start_m)
            .map_err(refused)?;
        for tick in 0..500_u32 {
            let push = if tick < 400 { [0.0; 2] } else { [3.3, 2.1] };
            display
                .tick(&Aim::Free, push, SAMPLE_STEP_S, |_| {})
                .map_err(refused)?;
        }
        let held = display.plant().resisted().held;
        all &= held.get(clutch) == Some(&true) && held.iter().filter(|held| **held).count() == 1;
        let [a, b] = display.plant().rates();
        all &= a.abs() + b.abs() > 1e-3;
        texts.push(format!("clutch {}: {a:.3} and {b:.3}", clutch + 1));
    }
    let ours = format!("rates of links A and B, rad/s: {}", texts.join("; "));
    let because = "each clutch alone holds its row while the tip moves: a link stands, or both turn alike or oppositely";
    let stated = "one link, the other, direct and reverse coupling";
    Ok(Finding::claim(
        "§1.1",
        "the four local paths",
        stated,
        (ours, all),
        because,
    ))
}

/// "The performance of PTER is limited primarily by its actuators": the same display with clutches that answer at once.
fn actuators() -> Result<Finding, Error> {
    let fast = ClutchFigures {
        kinetic_over_static: 1.0,
        delay_s: 0.0,
        response_s: 0.002,
        ..PTER_CLUTCH
    };
    let refused = |error| Error::model("PTER with faster clutches", error);
    let mut runs = Vec::new();
    for run in 0..9 {
        let display = Pter::with_clutches(fast)
            .at(Task::Line.start_m())
            .map_err(refused)?;
        let ran = of_a_display(display, Task::Line, 31 + 7919 * run).map_err(refused)?;
        runs.push(measure(Task::Line, &ran)?);
    }
    let middle = |of: fn(&Measured) -> f64| {
        let mut values: Vec<f64> = runs.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let own = of(Shown::Pter, Task::Line)?;
    let pairs = [
        (
            own.median(|m| 1e3 * m.error_m),
            middle(|m| 1e3 * m.error_m),
            "mm",
        ),
        (
            own.median(|m| m.roughness_m_s3),
            middle(|m| m.roughness_m_s3),
            "m/s³",
        ),
    ];
    let [error, rough] = pairs.map(|(slow, fast, unit)| {
        format!("{} beside {}", with_unit(slow, unit), with_unit(fast, unit))
    });
    let all = pairs.iter().all(|(slow, fast, _)| fast < slow);
    let ours = format!("on the line, mean distance {error}; DFT sum {rough}");
    let because = "its clutches beside ones without delay, of 2 ms and one friction: nearer and smoother with the second";
    let finding = Finding::claim(
        "§1.1",
        "what limits PTER",
        "primarily its actuators",
        (ours, all),
        because,
    );
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("pter-control"),
        false => finding,
    })
}
