//! Figure 3.3: how a brake answers a step of current at constant speed.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::torque_gain_fit;
use rigproof_spec::units::rad_s_from_rpm;

use super::bench::{Command, Recorded, turn};
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "3.3",
    title: "Torque response to current step of 0.8 A at 4 rpm",
    what: "Each brake, turned at 4 rpm, from 0 to 0.8 A at 0.1 s and back at 0.25 s; the text does not say which brake it shows.",
    run,
};

const CURRENT_A: f64 = 0.8;
const ON_S: f64 = 0.1;
const OFF_S: f64 = 0.25;

fn run() -> Result<Outcome, Error> {
    let runs: Vec<(Joint, Recorded)> = Joint::ALL.map(|joint| (joint, step(joint))).into();
    let curves = runs.iter().map(|(joint, run)| {
        let name = format!("brake {}", joint.letter());
        Curve::line(name, &run.time_s, &run.torque_nm)
    });
    let picture = Picture {
        name: "current-step".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "model, all four brakes".to_owned(),
        panels: vec![Panel::new(
            ("time", "s"),
            ("torque", "N·m"),
            curves.collect(),
        )],
    };
    let tables = runs
        .iter()
        .map(|(joint, run)| run.table(&format!("brake-{}", joint.letter().to_lowercase())));
    Ok(Outcome {
        tables: tables.collect(),
        pictures: vec![picture],
        findings: findings(&runs),
    })
}

fn step(joint: Joint) -> Recorded {
    let omega_rad_s = rad_s_from_rpm(4.0);
    turn(joint, 0.4, |time_s| Command {
        current_a: if (ON_S..OFF_S).contains(&time_s) {
            CURRENT_A
        } else {
            0.0
        },
        theta_rad: omega_rad_s * time_s,
        omega_rad_s,
    })
}

fn findings(runs: &[(Joint, Recorded)]) -> Vec<Finding> {
    let shape = runs
        .iter()
        .map(|(joint, run)| first_order_error(*joint, run));
    let worst = shape.fold(0.0, f64::max);
    let coil_s = 0.150 / 8.0;
    vec![
        Finding::claim(
            "§3.3.1",
            "the torque shows a typical first-order response",
            "first order",
            (
                format!(
                    "{:.2} % of the step at most from one exponential",
                    100.0 * worst
                ),
                worst < 0.02,
            ),
            "2 % of the step, as the eye tells a figure",
        ),
        Finding::number(
            "§3.3.1",
            "the coil's time constant on a voltage step, 0.150 H / 8 Ω",
            (19.0, 1e3 * coil_s, "ms"),
            0.5,
            "half the last printed digit",
        ),
        Finding::lost(
            "§3.3.1",
            "the torque that the step of 0.8 A reaches",
            runs.iter()
                .map(|(joint, run)| {
                    let peak = run.torque_nm.iter().copied().fold(0.0, f64::max);
                    format!("{} {peak:.2} N·m", joint.letter())
                })
                .collect::<Vec<_>>()
                .join(", "),
            "the text prints no number beside the figure",
        ),
    ]
}

/// Greatest distance of the rise from the exponential through its own 63.2 % point, as a share of the step.
fn first_order_error(joint: Joint, run: &Recorded) -> f64 {
    let start_nm = torque_gain_fit(joint).off_state_nm();
    let rise: Vec<(f64, f64)> = run
        .time_s
        .iter()
        .zip(&run.torque_nm)
        .filter(|(time_s, _)| (ON_S..OFF_S).contains(*time_s))
        .map(|(time_s, torque_nm)| (time_s - ON_S, *torque_nm))
        .collect();
    let end_nm = rise.last().map_or(start_nm, |(_, torque_nm)| *torque_nm);
    let share = |torque_nm: f64| (torque_nm - start_nm) / (end_nm - start_nm);
    // (3.4) straightens an exponential, so that a crossing between two samples is exact.
    let elapsed = |torque_nm: f64| -libm::log(1.0 - share(torque_nm));
    let at = |level: f64| crossing(&rise, |torque_nm| elapsed(torque_nm) - level);
    let (Some(first_s), Some(second_s)) = (at(0.5), at(1.0)) else {
        return f64::INFINITY;
    };
    let a_s = 2.0 * (second_s - first_s);
    let start_s = second_s - a_s;
    rise.iter()
        .map(|(time_s, torque_nm)| {
            let exponential = -libm::expm1(-(time_s - start_s).max(0.0) / a_s);
            (share(*torque_nm) - exponential).abs()
        })
        .fold(0.0, f64::max)
}

/// When a growing signal passes zero, between two samples.
fn crossing(points: &[(f64, f64)], height: impl Fn(f64) -> f64) -> Option<f64> {
    points.windows(2).find_map(|pair| match pair {
        [(t_0, y_0), (t_1, y_1)] => {
            let (h_0, h_1) = (height(*y_0), height(*y_1));
            (h_0 < 0.0 && h_1 >= 0.0).then(|| t_0 + (t_1 - t_0) * h_0 / (h_0 - h_1))
        }
        _ => None,
    })
}
