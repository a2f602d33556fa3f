//! Figures 3.10 to 3.13: the time constants over current and speed, and their surfaces.

use rigproof_model::brake::identify::surface_fit;
use rigproof_model::brake::time_constant;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{Edge, time_constant_fit};
use rigproof_spec::units::rad_s_from_rpm;

use super::bench::{each, name};
use super::matrix::{CURRENTS_A, Cell, SPEEDS_RPM, matrix, table};
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// Rising time constants.
pub const RISING: Experiment = Experiment {
    id: "3.10",
    title: "Rising time constant over current and speed",
    what: "The matrix of §3.4 on the model of each brake, each time constant read off its transient by (3.4).",
    run: || measured(Edge::Rising),
};
/// Falling time constants.
pub const FALLING: Experiment = Experiment {
    id: "3.11",
    title: "Falling time constant over current and speed",
    what: "As figure 3.10, for the steps back to no current.",
    run: || measured(Edge::Falling),
};
/// The rising surface.
pub const RISING_FIT: Experiment = Experiment {
    id: "3.12",
    title: "Rising time constant surface fit",
    what: "(3.5) fitted by least squares to the time constants of figure 3.10 below 4 rpm.",
    run: || fitted(Edge::Rising),
};
/// The falling surface.
pub const FALLING_FIT: Experiment = Experiment {
    id: "3.13",
    title: "Falling time constant surface fit",
    what: "(3.6) fitted by least squares to the time constants of figure 3.11 up to 2 rpm, the threshold included: two speeds do not tell a square.",
    run: || fitted(Edge::Falling),
};

fn of(edge: Edge) -> fn(&Cell) -> f64 {
    match edge {
        Edge::Rising => |cell| cell.rising_s,
        Edge::Falling => |cell| cell.falling_s,
    }
}

fn measured(edge: Edge) -> Result<Outcome, Error> {
    let title = match edge {
        Edge::Rising => RISING.title,
        Edge::Falling => FALLING.title,
    };
    let mut outcome = Outcome::default();
    let mut all: Vec<(Joint, Vec<Cell>)> = Vec::new();
    for joint in Joint::ALL {
        let cells = matrix(joint)?;
        let curves = CURRENTS_A.map(|current_a| {
            let row = cells.iter().filter(|c| c.current_a == current_a);
            let milli: Vec<f64> = row.map(|c| 1e3 * of(edge)(c)).collect();
            Curve::line(
                format!("{current_a} A"),
                &SPEEDS_RPM.map(libm::log2),
                &milli,
            )
        });
        outcome.pictures.push(Picture {
            name: name(joint),
            title: format!("{title}, brake {}", joint.letter()),
            subtitle: "read off the model's transients by (3.4)".to_owned(),
            panels: vec![Panel::new(
                ("log2 of the speed in rpm", ""),
                ("time constant", "ms"),
                curves.into(),
            )],
        });
        outcome.tables.push(table(&name(joint), &cells));
        all.push((joint, cells));
    }
    let steps: Vec<&Cell> = all
        .iter()
        .flat_map(|(_, cells)| cells)
        .filter(|c| c.current_a > 0.0)
        .collect();
    outcome.findings.push(match edge {
        Edge::Rising => slower_below_threshold(&steps),
        Edge::Falling => falling_is_smaller(&steps),
    });
    outcome.findings.push(constant_above(&all, edge));
    Ok(outcome)
}

fn slower_below_threshold(steps: &[&Cell]) -> Finding {
    let at = |cell: &Cell, rpm: f64| {
        let same = |c: &&&Cell| c.current_a == cell.current_a && c.speed_rpm == rpm;
        steps
            .iter()
            .filter(same)
            .map(|c| c.rising_s)
            .fold(f64::NAN, f64::max)
    };
    let slow = steps.iter().filter(|c| c.speed_rpm == 0.5);
    let ratios: Vec<f64> = slow.map(|c| c.rising_s / at(c, 4.0)).collect();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let most = ratios.iter().copied().fold(0.0, f64::max);
    Finding::claim(
        "§3.4.2",
        "below the threshold the time constant increases with decreasing speed",
        "increases",
        (
            format!("{least:.1} to {most:.1} times from 4 to 0.5 rpm"),
            least > 1.0,
        ),
        "every current of every brake has to be slower at 0.5 than at 4 rpm",
    )
}

fn falling_is_smaller(steps: &[&Cell]) -> Finding {
    let smaller = steps.iter().filter(|c| c.falling_s < c.rising_s).count();
    Finding::claim(
        "§3.4.2",
        "the falling time constant is generally smaller",
        "generally",
        (
            format!("in {smaller} of {} cells", steps.len()),
            10 * smaller > 9 * steps.len(),
        ),
        "in nine cells of ten",
    )
}

fn constant_above(all: &[(Joint, Vec<Cell>)], edge: Edge) -> Finding {
    let mean_ms = |joint: Joint| {
        let cells = all
            .iter()
            .filter(|(j, _)| *j == joint)
            .flat_map(|(_, cells)| cells);
        let fast = cells.filter(|c| c.speed_rpm >= edge.threshold_rpm() && c.current_a > 0.0);
        let (sum, count) = fast.fold((0.0, 0.0), |(s, n), c| (s + of(edge)(c), n + 1.0));
        1e3 * sum / count
    };
    let off = |joint: Joint| (mean_ms(joint) - 1e3 * time_constant_fit(joint, edge).a_avg_s).abs();
    let worst = Joint::ALL.map(off).into_iter().fold(0.0, f64::max);
    let threshold_rpm = edge.threshold_rpm();
    Finding::claim(
        "table 3.3",
        format!(
            "the mean {} time constant from {threshold_rpm} rpm",
            edge.name()
        ),
        each(|joint| format!("{:.1} ms", 1e3 * time_constant_fit(joint, edge).a_avg_s)),
        (
            each(|joint| format!("{:.2} ms", mean_ms(joint))),
            worst < 0.05,
        ),
        "half the last printed digit; read off transients sampled at 1 kHz",
    )
}

fn fitted(edge: Edge) -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let (mut worst, mut names, mut values) = (0.0_f64, Vec::new(), Vec::new());
    for joint in Joint::ALL {
        let cells = matrix(joint)?;
        let steps = cells.iter().filter(|c| c.current_a > 0.0);
        let measured: Vec<(f64, f64, f64)> = steps
            .map(|c| (c.current_a, c.speed_rpm, of(edge)(c)))
            .collect();
        let fit = surface_fit(&measured, edge)
            .ok_or_else(|| Error::model("the surface fit", "too few speeds"))?;
        let t = time_constant_fit(joint, edge);
        let printed = [t.a_1, t.a_2, t.a_3, t.a_4, t.a_5, t.a_6];
        let found = fit.coefficients.map(|a| a.value);
        let off = found
            .iter()
            .zip(printed)
            .map(|(found, printed)| (found - printed).abs());
        worst = off.fold(worst, f64::max);
        names.push(joint.letter());
        values.push(found);
        outcome.pictures.push(picture(joint, edge));
    }
    let mut columns = vec![Column::words("brake", &names)];
    for index in 0..6 {
        let column: Vec<f64> = values
            .iter()
            .map(|row| row.get(index).copied().unwrap_or(f64::NAN))
            .collect();
        let unit = if index % 2 == 0 { "s/A" } else { "s" };
        columns.push(Column::numbers(format!("a_{}", index + 1), unit, &column));
    }
    outcome.tables.push(Table::new("coefficients", columns));
    outcome.findings.push(Finding::claim(
        "table 3.3",
        format!("the {} surface coefficients, found again from steps of the model", edge.name()),
        "24 coefficients of four digits behind the point",
        (format!("{:.3} ms off at most", 1e3 * worst), worst < 2e-4),
        "twice the last printed digit: the model joins a_avg at the threshold, where brake B's surface lies 0.1 ms below",
    ));
    outcome.findings.push(at_threshold(edge));
    Ok(outcome)
}

/// How far the surface and the constant lie apart where they meet.
fn at_threshold(edge: Edge) -> Finding {
    let below = rad_s_from_rpm(edge.threshold_rpm() * (1.0 - 1e-12));
    let gap = |joint: Joint| {
        let average = time_constant_fit(joint, edge).a_avg_s;
        let gaps =
            CURRENTS_A.map(|i| 100.0 * (time_constant(joint, i, below, edge) / average - 1.0));
        gaps.into_iter().fold(
            0.0,
            |worst: f64, g| if g.abs() > worst.abs() { g } else { worst },
        )
    };
    Finding::lost(
        "§3.4.2",
        "that surface and constant meet at the threshold",
        each(|joint| format!("{:+.1} %", gap(joint))),
        "the text is silent; the step is kept as printed (gap time-constant-step)",
    )
}

fn picture(joint: Joint, edge: Edge) -> Picture {
    let speeds: Vec<f64> = (0..=140).map(|k| 0.05 * f64::from(k) - 1.0).collect();
    let curves = CURRENTS_A.map(|current_a| {
        let milli = speeds.iter().map(|l| {
            let omega = rad_s_from_rpm(libm::exp2(*l));
            1e3 * time_constant(joint, current_a, omega, edge)
        });
        Curve::line(
            format!("{current_a} A"),
            &speeds,
            &milli.collect::<Vec<f64>>(),
        )
    });
    Picture {
        name: name(joint),
        title: format!(
            "{} time constant surface, brake {}",
            edge.name(),
            joint.letter()
        ),
        subtitle: "table 3.3".to_owned(),
        panels: vec![Panel::new(
            ("log2 of the speed in rpm", ""),
            ("time constant", "ms"),
            curves.into(),
        )],
    }
}
