//! Figures 3.15 and 3.16: the model beside data of the brakes; the data are lost, what the text says of them is not.

use rigproof_spec::joint::Joint;
use rigproof_spec::units::{deg_from_rad, rad_s_from_rpm};

use super::bench::{Command, Recorded, each, name, turn};
use super::figure_3_5::sinusoid;
use super::matrix::SCATTER_NM_PER_A;
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture};

/// The model's answer to the steps of figure 3.3.
pub const STEP: Experiment = Experiment {
    id: "3.15",
    title: "Comparison of model to current step response",
    what: "Each brake at 4 rpm, from 0 to 0.8 A and back; only the model's half of the figure can be drawn.",
    run: step,
};

/// The model's answer to sinusoidal motion.
pub const SINUSOID: Experiment = Experiment {
    id: "3.16",
    title: "Comparison of model to sinusoidal data",
    what: "Each brake at 1 A, its speed a sinusoid of 10 rpm at 1 Hz; only the model's half of the figure can be drawn.",
    run: sinusoidal,
};

fn step() -> Result<Outcome, Error> {
    let omega_rad_s = rad_s_from_rpm(4.0);
    let runs = Joint::ALL.map(|joint| {
        let run = turn(joint, 0.4, |time_s| Command {
            current_a: if (0.1..0.25).contains(&time_s) {
                0.8
            } else {
                0.0
            },
            theta_rad: omega_rad_s * time_s,
            omega_rad_s,
        });
        (joint, run)
    });
    let rise = |joint: Joint| {
        let run = runs.iter().find(|(j, _)| *j == joint);
        run.map_or(f64::NAN, |(_, run)| 1e3 * rise_s(run))
    };
    Ok(Outcome {
        tables: tables(&runs),
        pictures: vec![Picture {
            name: "current-step".to_owned(),
            title: STEP.title.to_owned(),
            subtitle: "model alone: the data of the figure are lost".to_owned(),
            panels: vec![over_time(&runs)],
        }],
        findings: vec![Finding::lost(
            "§3.5",
            "the model closely matches the data",
            format!(
                "10 to 90 % of the rise in {}",
                each(|joint| format!("{:.1} ms", rise(joint)))
            ),
            "the data are in the figure only; on the model's own steps (3.4) finds table 3.3 again (3.12, 3.13)",
        )],
    })
}

fn sinusoidal() -> Result<Outcome, Error> {
    let runs = Joint::ALL.map(|joint| (joint, sinusoid(joint, 1.0, 1.0)));
    let loops = runs.iter().map(|(joint, run)| {
        let degrees: Vec<f64> = run.theta_rad.iter().map(|t| deg_from_rad(*t)).collect();
        Curve::line(name(*joint), &degrees, &run.torque_nm)
    });
    let interval_nm = 1.959_964 * SCATTER_NM_PER_A;
    Ok(Outcome {
        tables: tables(&runs),
        pictures: vec![Picture {
            name: "sinusoidal-speed".to_owned(),
            title: SINUSOID.title.to_owned(),
            subtitle: "model alone: the data of the figure are lost".to_owned(),
            panels: vec![
                over_time(&runs),
                Panel::new(("position", "°"), ("torque", "N·m"), loops.collect()),
            ],
        }],
        findings: vec![
            Finding::claim(
                "§3.5",
                "an error of just over 1 N·m is within a 95 % interval of the scatter",
                "within",
                (
                    format!("the interval ends at {interval_nm:.2} N·m"),
                    interval_nm > 1.0,
                ),
                "1.96 of the stated greatest standard deviation, 0.4 N·m",
            )
            .accounted("confidence-interval"),
            Finding::lost(
                "§3.5",
                "the torque is generally higher than expected after a change in the sign of speed",
                "the model gives the same torque before and after",
                "the text gives no amount; left out of the model, as printed (gap torque-after-reversal)",
            ),
        ],
    })
}

fn tables(runs: &[(Joint, Recorded)]) -> Vec<crate::Table> {
    runs.iter()
        .map(|(joint, run)| run.table(&name(*joint)))
        .collect()
}

fn over_time(runs: &[(Joint, Recorded)]) -> Panel {
    let curves = runs
        .iter()
        .map(|(joint, run)| Curve::line(name(*joint), &run.time_s, &run.torque_nm));
    Panel::new(("time", "s"), ("torque", "N·m"), curves.collect())
}

/// Time from 10 to 90 % of the greatest torque, s.
fn rise_s(run: &Recorded) -> f64 {
    let most = run.torque_nm.iter().copied().fold(0.0, f64::max);
    let first = |share: f64| {
        let index = run
            .torque_nm
            .iter()
            .position(|torque| *torque >= share * most);
        index
            .and_then(|k| run.time_s.get(k))
            .copied()
            .unwrap_or(f64::NAN)
    };
    first(0.9) - first(0.1)
}
