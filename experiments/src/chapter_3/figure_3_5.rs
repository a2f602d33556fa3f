//! Figure 3.5: what backlash does to the torque when the motion turns back.

use core::f64::consts::PI;

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{backlash_width_deg, torque_gain_fit};
use rigproof_spec::units::{deg_from_rad, rad_s_from_rpm, rpm_from_rad_s};

use super::bench::{Command, Recorded, each, name, turn};
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "3.5",
    title: "Torque response to sinusoidal velocity at 1 Hz and 1.0 A",
    what: "Each brake at 0.5 and 1 A, its speed a sinusoid of 10 rpm at 0.25 and 1 Hz over four periods. The width is read as by inspection: from the turn to where the torque has half returned, averaged.",
    run,
};

/// One count of the encoder behind the gear, degrees (§3.2).
const COUNT_DEG: f64 = 360.0 / 102_400.0;

/// Turns a brake with a sinusoidal speed of 10 rpm.
pub fn sinusoid(joint: Joint, current_a: f64, hertz: f64) -> Recorded {
    let (rate, amplitude) = (2.0 * PI * hertz, rad_s_from_rpm(10.0));
    turn(joint, 4.0 / hertz, |time_s| Command {
        current_a,
        theta_rad: amplitude / rate * (1.0 - libm::cos(rate * time_s)),
        omega_rad_s: amplitude * libm::sin(rate * time_s),
    })
}

/// Mean travel from a turn to where the torque is half way back, degrees.
pub fn inspected_width_deg(joint: Joint, run: &Recorded) -> f64 {
    let full_nm = run.torque_nm.iter().copied().fold(0.0, f64::max);
    let half_nm = 0.5 * (full_nm + torque_gain_fit(joint).off_state_nm());
    let mut widths = Vec::new();
    let (mut turn_rad, mut sense, mut free) = (None, 0.0, false);
    let columns = run
        .omega_rad_s
        .iter()
        .zip(&run.theta_rad)
        .zip(&run.torque_nm);
    for ((omega, theta), torque) in columns {
        if omega.signum() != sense {
            turn_rad = (sense != 0.0).then_some(*theta);
            (sense, free) = (omega.signum(), false);
        }
        free |= torque.abs() < half_nm;
        if let Some(from) = turn_rad
            && torque.abs() >= half_nm
            && free
        {
            widths.push(deg_from_rad((theta - from).abs()));
            turn_rad = None;
        }
    }
    match widths.len() {
        0 => 0.0,
        count => widths.iter().sum::<f64>() / count as f64,
    }
}

fn run() -> Result<Outcome, Error> {
    let shown = Joint::ALL.map(|joint| (joint, sinusoid(joint, 1.0, 1.0)));
    let conditions = [(0.5, 0.25), (1.0, 0.25), (0.5, 1.0), (1.0, 1.0)];
    let mut rows: Vec<(Joint, f64, f64, f64)> = Vec::new();
    for joint in Joint::ALL {
        for (current_a, hertz) in conditions {
            let width = inspected_width_deg(joint, &sinusoid(joint, current_a, hertz));
            rows.push((joint, current_a, hertz, width));
        }
    }
    let mut tables: Vec<Table> = shown.iter().map(|(j, run)| run.table(&name(*j))).collect();
    let column =
        |pick: fn(&(Joint, f64, f64, f64)) -> f64| -> Vec<f64> { rows.iter().map(pick).collect() };
    let letters: Vec<&str> = rows.iter().map(|row| row.0.letter()).collect();
    tables.push(Table::new(
        "widths",
        vec![
            Column::words("brake", &letters),
            Column::numbers("current", "A", &column(|row| row.1)),
            Column::numbers("frequency", "Hz", &column(|row| row.2)),
            Column::numbers("width", "deg", &column(|row| row.3)),
        ],
    ));
    Ok(Outcome {
        tables,
        pictures: vec![picture(&shown)],
        findings: findings(&shown, &rows),
    })
}

fn picture(shown: &[(Joint, Recorded)]) -> Picture {
    let curves = |x: fn(&Recorded) -> Vec<f64>, y: fn(&Recorded) -> Vec<f64>| -> Vec<Curve> {
        let curve = |(joint, run): &(Joint, Recorded)| Curve::line(name(*joint), &x(run), &y(run));
        shown.iter().map(curve).collect()
    };
    let rpm = |run: &Recorded| run.omega_rad_s.iter().map(|w| rpm_from_rad_s(*w)).collect();
    let deg = |run: &Recorded| run.theta_rad.iter().map(|t| deg_from_rad(*t)).collect();
    let (time, torque) = (
        |run: &Recorded| run.time_s.clone(),
        |run: &Recorded| run.torque_nm.clone(),
    );
    Picture {
        name: "sinusoidal-speed".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "model, all four brakes".to_owned(),
        panels: vec![
            Panel::new(("time", "s"), ("speed", "rpm"), curves(time, rpm)),
            Panel::new(("time", "s"), ("torque", "N·m"), curves(time, torque)),
            Panel::new(("position", "°"), ("torque", "N·m"), curves(deg, torque)),
        ],
    }
}

fn findings(shown: &[(Joint, Recorded)], rows: &[(Joint, f64, f64, f64)]) -> Vec<Finding> {
    let width = |joint: Joint, current_a: f64, hertz: f64| {
        let row = rows
            .iter()
            .find(|row| (row.0, row.1, row.2) == (joint, current_a, hertz));
        row.map_or(f64::NAN, |row| row.3)
    };
    let widest = Joint::ALL.map(|joint| width(joint, 1.0, 1.0));
    let nearest = widest
        .into_iter()
        .min_by(|a, b| (a - 1.9).abs().total_cmp(&(b - 1.9).abs()));
    let spread = |joint: Joint| {
        let of = rows.iter().filter(|row| row.0 == joint).map(|row| row.3);
        let (low, high) = of.fold((f64::INFINITY, 0.0_f64), |(l, h), w| (l.min(w), h.max(w)));
        high - low
    };
    let greatest = Joint::ALL.map(spread).into_iter().fold(0.0, f64::max);
    let stalled = shown
        .iter()
        .filter(|(joint, _)| backlash_width_deg(*joint) > 0.0)
        .all(|(joint, run)| {
            let least = run
                .torque_nm
                .iter()
                .skip(400)
                .map(|t| t.abs())
                .fold(f64::INFINITY, f64::min);
            (least - torque_gain_fit(*joint).off_state_nm()).abs() < 0.01
        });
    vec![
        Finding::number(
            "§3.3.3",
            "the backlash in the third graph of figure 3.5, as inspected",
            (1.9, nearest.unwrap_or(f64::NAN), "°"),
            0.05,
            format!(
                "half the last printed digit, for the nearest brake; inspected at 1 Hz and 1 A: {}; the response lag adds to table 3.1",
                each(|joint| format!("{:.2}°", width(joint, 1.0, 1.0)))
            ),
        ),
        Finding::claim(
            "§3.3.3",
            "the width does not vary with frequency or current, but by quantization",
            format!("at most {COUNT_DEG:.4}° of quantization"),
            (format!("inspected widths spread over {greatest:.2}°"), greatest <= 2.0 * COUNT_DEG),
            "two counts of the encoder; what is inspected is later by the lag, and the lag is travel: more of it where the shaft is faster",
        )
        .accounted("backlash-inspection"),
        Finding::claim(
            "§3.3.3",
            "brake A has no detectable backlash",
            "none",
            (format!("{}°", width(Joint::A, 1.0, 1.0)), width(Joint::A, 1.0, 1.0) == 0.0),
            "its torque never falls to half on a turn",
        ),
        Finding::claim(
            "§3.3.3",
            "the torque stalls at its off-state value as the velocity switches sign",
            "off-state",
            (each(|j| format!("{} N·m", torque_gain_fit(j).off_state_nm())), stalled),
            "the least torque lies within 0.01 N·m of table 3.2 on the brakes with backlash",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inspected_width_exceeds_the_backlash_by_the_lag() {
        // At 1 Hz brake E crosses its 1.7° in (1/2π)·acos(1 − 1.7/9.549) = 96.5 ms, moving then at 34.2°/s; half the
        // torque is back 7.0 ms·ln 2 = 4.9 ms later, after 0.166° more.
        let width = |hertz: f64| inspected_width_deg(Joint::E, &sinusoid(Joint::E, 1.0, hertz));
        assert!((width(1.0) - 1.866).abs() < 0.02, "{}", width(1.0));
        // At 0.25 Hz the shaft is slower there: 17.7°/s, 0.09°.
        assert!((width(0.25) - 1.79).abs() < 0.02, "{}", width(0.25));
        assert_eq!(
            inspected_width_deg(Joint::A, &sinusoid(Joint::A, 1.0, 1.0)),
            0.0
        );
    }
}
