//! Figure 3.4: whether a brake's torque depends on its speed.

use rigproof_model::brake::identify::{Row, least_squares};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::torque_gain_fit;
use rigproof_spec::units::{rad_s_from_rpm, rpm_from_rad_s};

use super::bench::{Command, Recorded, each, name, turn};
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "3.4",
    title: "Torque response to ramp in speed at 0.8 A",
    what: "Each brake at 0.8 A, from 0 to 60 rpm in 10 s; the text does not give the duration. The straight line is fitted from 5 rpm.",
    run,
};

const DURATION_S: f64 = 10.0;
const GREATEST_RPM: f64 = 60.0;
/// What the text found, N·m/rpm.
const STATED_NM_PER_RPM: f64 = 0.0082;

fn run() -> Result<Outcome, Error> {
    let runs = Joint::ALL.map(|joint| (joint, ramp(joint)));
    let curves = runs.iter().map(|(joint, run)| {
        let rpm: Vec<f64> = run.omega_rad_s.iter().map(|w| rpm_from_rad_s(*w)).collect();
        Curve::line(name(*joint), &rpm, &run.torque_nm)
    });
    let picture = Picture {
        name: "speed-ramp".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "model, all four brakes: the model has no viscous drag".to_owned(),
        panels: vec![Panel::new(
            ("speed", "rpm"),
            ("torque", "N·m"),
            curves.collect(),
        )],
    };
    let steepest = runs.iter().map(|(_, run)| slope(run)).fold(0.0, f64::max);
    let drag_nm = STATED_NM_PER_RPM * GREATEST_RPM;
    Ok(Outcome {
        tables: runs
            .iter()
            .map(|(joint, run)| run.table(&name(*joint)))
            .collect(),
        pictures: vec![picture],
        findings: vec![
            Finding::number(
                "§3.3.2",
                "viscous damping, straight line through the steady region",
                (STATED_NM_PER_RPM, steepest, "N·m/rpm"),
                0.00005,
                "half the last printed digit; the thesis leaves the drag out of its model",
            )
            .accounted("viscous-drag"),
            Finding::claim(
                "§3.3.2",
                "the drag is at most a few tenths of 1 N·m in the range of the robot",
                "a few tenths of 1 N·m",
                (format!("{drag_nm:.2} N·m at 60 rpm"), drag_nm < 0.5),
                format!(
                    "up to five tenths; yet it is more than the off-state torque, {} N·m",
                    each(|joint| format!("{}", torque_gain_fit(joint).off_state_nm()))
                ),
            ),
        ],
    })
}

fn ramp(joint: Joint) -> Recorded {
    let rate = rad_s_from_rpm(GREATEST_RPM) / DURATION_S;
    turn(joint, DURATION_S, |time_s| Command {
        current_a: 0.8,
        theta_rad: 0.5 * rate * time_s * time_s,
        omega_rad_s: rate * time_s,
    })
}

/// Slope of the torque over the speed from 5 rpm, N·m/rpm.
fn slope(run: &Recorded) -> f64 {
    let pairs = run.omega_rad_s.iter().zip(&run.torque_nm);
    let rows: Vec<Row<2>> = pairs
        .map(|(omega, torque)| (rpm_from_rad_s(*omega), *torque))
        .filter(|(rpm, _)| *rpm > 5.0)
        .step_by(100)
        .map(|(rpm, value)| Row {
            terms: [rpm, 1.0],
            value,
            group: 0,
            spread: 1.0,
        })
        .collect();
    least_squares(&rows).map_or(f64::NAN, |fit| {
        let [slope, _] = fit.unknowns;
        slope.value
    })
}
