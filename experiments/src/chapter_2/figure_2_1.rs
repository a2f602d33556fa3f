//! This file runs Scooter, figure 2.1: the one way that its castors leave it, and its three tasks.

use rigproof_model::displays::{Aim, Scooter};
use rigproof_spec::laws::{Castor, one_degree, rolls};
use rigproof_spec::methods::SAMPLE_STEP_S;

use super::compared::{paths, table};
use super::shown::{DISSIPATIVE, Shown, of_a_display};
use super::statements::judged;
use super::tasks::{TASKS, Task};
use super::trials::{measure, of};
use crate::finding::with_unit;
use crate::{Error, Experiment, Finding, Outcome};

pub const EXPERIMENT: Experiment = Experiment {
    id: "2.1",
    title: "Scooter Cobot",
    what: "Free motion by the direction of the hand's force, a virtual wall by steering along it and a line by the velocity field of \
           §6.1.1, nine runs each; mass, grip and steering are assumed (decision 0244).",
    run,
};

fn run() -> Result<Outcome, Error> {
    let mut findings = vec![one_way()?];
    let mut own = Vec::new();
    for task in TASKS {
        findings.push(judged(Shown::Scooter, task)?);
        own.push(of(Shown::Scooter, task)?.clone());
    }
    findings.push(without_looking_ahead()?);
    Ok(Outcome {
        tables: vec![table(&own)?],
        pictures: vec![paths("runs", "Scooter", &[Shown::Scooter])?],
        findings,
    })
}

/// "Constrains the user to a single kinematic degree of freedom using three motorized castors": the castors over a push that turns.
fn one_way() -> Result<Finding, Error> {
    let refused = |error| Error::model("Scooter under a push that turns", error);
    let display = Shown::Scooter.display([0.013, 0.36]).map_err(refused)?;
    let Some(mut display) = display else {
        return Err(Error::model(
            "Scooter under a push that turns",
            "it is no display",
        ));
    };
    let (mut sideways_m_s, mut fastest_m_s, mut all) = (0.0_f64, 0.0_f64, true);
    for tick in 0..800_u32 {
        let (sine, cosine) = libm::sincos(0.004 * f64::from(tick));
        let push = [6.0 * cosine, 6.0 * sine];
        display
            .tick(&Aim::Free, push, SAMPLE_STEP_S, |plant| {
                let rates = plant.resisted().rates;
                sideways_m_s = rates
                    .iter()
                    .fold(sideways_m_s, |most, rate| most.max(rate.abs()));
                let [x, y] = plant.tip_velocity_m_s();
                let speed = libm::hypot(x, y);
                fastest_m_s = fastest_m_s.max(speed);
                if speed > 1e-3 {
                    let castors = amid([x / speed, y / speed]);
                    all &= one_degree(&castors, 1e-9).holds();
                    all &= rolls(&castors, [x, y, 0.0], 1e-9).holds();
                }
            })
            .map_err(refused)?;
    }
    let ours = format!(
        "sideways speed of a castor at most {} at {}; the three rows have rank 2",
        with_unit(sideways_m_s, "m/s"),
        with_unit(fastest_m_s, "m/s")
    );
    let holds = all && sideways_m_s <= 1e-9 && fastest_m_s > 0.05;
    let because = "every step of 0.8 s under 6 N whose direction turns by 183°";
    Ok(Finding::claim(
        "§2.2.1",
        "degrees of freedom left",
        "one",
        (ours, holds),
        because,
    ))
}

/// The same wall for castors that turn only once they are in it, as brakes lock: what looking ahead is worth.
fn without_looking_ahead() -> Result<Finding, Error> {
    let refused = |error| Error::model("Scooter that does not look ahead", error);
    let mut depths_m = Vec::new();
    for run in 0..9 {
        let start_m = Task::Wall.start_m();
        let display = Scooter::new(0.0)
            .with_ahead_s(0.0)
            .at(start_m)
            .map_err(refused)?;
        let ran = of_a_display(display, Task::Wall, 31 + 7919 * run).map_err(refused)?;
        depths_m.push(measure(Task::Wall, &ran)?.greatest_m);
    }
    depths_m.sort_by(f64::total_cmp);
    let depth_m = depths_m.get(4).copied().unwrap_or(f64::NAN);
    let mut best_m = f64::INFINITY;
    for other in DISSIPATIVE {
        best_m = best_m.min(of(other, Task::Wall)?.median(|m| m.greatest_m));
    }
    let ours = format!("greatest depth {}", with_unit(1e3 * depth_m, "mm"));
    let because = format!(
        "deeper than the best dissipative display, {}, which does not look ahead either",
        with_unit(1e3 * best_m, "mm")
    );
    let statement = "Scooter at a wall that it meets unawares";
    let stated = "steerable devices do a poor job of simulating walls";
    let judged = (ours, depth_m > best_m);
    let finding = Finding::claim("§1.1", statement, stated, judged, because);
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("scooter-figures"),
        false => finding,
    })
}

/// Three castors around the handle with one heading.
fn amid(heading: [f64; 2]) -> [Castor; 3] {
    [[0.2, 0.0], [-0.1, 0.17], [-0.1, -0.17]].map(|at_m| Castor { at_m, heading })
}
