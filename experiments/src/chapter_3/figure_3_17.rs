//! Figure 3.17: how the torque follows a sinusoidal current.

use core::f64::consts::PI;

use rigproof_spec::joint::Joint;
use rigproof_spec::units::rad_s_from_rpm;

use super::bench::{Command, Recorded, name, turn};
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "3.17",
    title: "Comparison of model to sinusoidal current data",
    what: "Each brake at 10 rpm, its current between 0 and 1 A at 1 Hz; the text gives neither. The loop of torque over current is measured at 0.01 Hz as well, where the lag no longer counts.",
    run,
};

fn sweep(joint: Joint, hertz: f64) -> Recorded {
    let omega_rad_s = rad_s_from_rpm(10.0);
    turn(joint, 2.0 / hertz, |time_s| Command {
        current_a: 0.5 - 0.5 * libm::cos(2.0 * PI * hertz * time_s),
        theta_rad: omega_rad_s * time_s,
        omega_rad_s,
    })
}

/// Greatest torque difference between falling and rising current at one current, N·m.
fn loop_width_nm(run: &Recorded) -> f64 {
    let half = run.time_s.len() / 2;
    let points = run.current_a.iter().zip(&run.torque_nm).skip(half);
    let mut levels = [[f64::NAN; 2]; 19];
    let mut before: Option<(f64, f64)> = None;
    for (current, torque) in points {
        if let Some((i_0, t_0)) = before {
            for (index, level) in levels.iter_mut().enumerate() {
                let at = 0.05 * (index + 1) as f64 + 0.0137;
                if (i_0 - at) * (current - at) <= 0.0 && current != &i_0 {
                    let torque = t_0 + (torque - t_0) * (at - i_0) / (current - i_0);
                    let [up, down] = level;
                    *(if *current > i_0 { up } else { down }) = torque;
                }
            }
        }
        before = Some((*current, *torque));
    }
    let widths = levels.iter().map(|[up, down]| down - up);
    widths.filter(|w| w.is_finite()).fold(0.0, f64::max)
}

fn run() -> Result<Outcome, Error> {
    let shown = Joint::ALL.map(|joint| (joint, sweep(joint, 1.0)));
    let curves = |x: fn(&Recorded) -> &Vec<f64>| -> Vec<Curve> {
        let curve =
            |(joint, run): &(Joint, Recorded)| Curve::line(name(*joint), x(run), &run.torque_nm);
        shown.iter().map(curve).collect()
    };
    let picture = Picture {
        name: "sinusoidal-current".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "model, all four brakes: no hysteresis, only lag".to_owned(),
        panels: vec![
            Panel::new(("time", "s"), ("torque", "N·m"), curves(|run| &run.time_s)),
            Panel::new(
                ("current", "A"),
                ("torque", "N·m"),
                curves(|run| &run.current_a),
            ),
        ],
    };
    let widest = |hertz: f64| {
        Joint::ALL
            .map(|j| loop_width_nm(&sweep(j, hertz)))
            .into_iter()
            .fold(0.0, f64::max)
    };
    let (fast, slow) = (widest(1.0), widest(0.01));
    Ok(Outcome {
        tables: shown
            .iter()
            .map(|(joint, run)| run.table(&name(*joint)))
            .collect(),
        pictures: vec![picture],
        findings: vec![
            Finding::claim(
                "§3.5",
                "hysteresis of the torque over the current is not considered in the model",
                "no hysteresis",
                (
                    format!("loop of {slow:.4} N·m at 0.01 Hz, {fast:.2} N·m at 1 Hz"),
                    slow < 0.02 && fast > 5.0 * slow,
                ),
                "what is left of the loop at 0.01 Hz is the step of (3.3) at 0.2 A, under 0.02 N·m; at 1 Hz it is lag",
            ),
            Finding::lost(
                "§3.5",
                "the hysteresis of the brake, and that the model captures the general effect",
                format!("loop of {fast:.2} N·m at 1 Hz from lag alone"),
                "the text gives no number beside the figure, nor frequency, speed and amplitude",
            ),
        ],
    })
}
