//! Figures 3.7 to 3.9: the settled torque over current and speed, its fit, and its scatter.

use rigproof_model::brake::identify::{GainFit, Row, gain_fit, least_squares};
use rigproof_model::brake::torque_gain;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::torque_gain_fit;

use super::bench::{each, name};
use super::matrix::{CURRENTS_A, Cell, SPEEDS_RPM, matrix, table};
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The settled torque over current and speed.
pub const SURFACE: Experiment = Experiment {
    id: "3.7",
    title: "Torque gain over current and speed",
    what: "The matrix of §3.4 on the model of each brake: three steps to each current at each speed, the settled torque with the scatter that §3.4.1 reports (0.4 N·m at 1 A, in proportion to the current).",
    run: surface,
};

/// The fit of the torque gain.
pub const FIT: Experiment = Experiment {
    id: "3.8",
    title: "Torque gain fit applied to data",
    what: "(3.3) fitted by least squares to the means of three settled torques of figure 3.7.",
    run: fit,
};

/// The scatter of the settled torque.
pub const SCATTER: Experiment = Experiment {
    id: "3.9",
    title: "Standard deviation of torque over current",
    what: "The scatter that the R² of table 3.2 implies, beside the one that the text states.",
    run: scatter,
};

fn surface() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut slopes = Vec::new();
    for joint in Joint::ALL {
        let cells = matrix(joint)?;
        let curves = [0.0].into_iter().chain(CURRENTS_A).map(|current_a| {
            let torques: Vec<f64> = cells
                .iter()
                .filter(|c| c.current_a == current_a)
                .map(mean_nm)
                .collect();
            Curve::line(
                format!("{current_a} A"),
                &SPEEDS_RPM.map(libm::log2),
                &torques,
            )
        });
        let panel = Panel::new(
            ("log2 of the speed in rpm", ""),
            ("settled torque", "N·m"),
            curves.collect(),
        );
        outcome.pictures.push(Picture {
            name: name(joint),
            title: format!("{}, brake {}", SURFACE.title, joint.letter()),
            subtitle: "mean of three steps, with the scatter of §3.4.1".to_owned(),
            panels: vec![panel],
        });
        slopes.push((joint, speed_slope(&cells)));
        outcome.tables.push(table(&name(joint), &cells));
    }
    let told = slopes.iter().filter(|(_, t)| t.abs() > 2.0).count();
    let words: Vec<String> = slopes
        .iter()
        .map(|(j, t)| format!("{} {t:.1}", j.letter()))
        .collect();
    outcome.findings.push(Finding::claim(
        "§3.4.1",
        "speed has no detectable influence on the torque",
        "none",
        (format!("slope over its standard error: {}", words.join(", ")), told == 0),
        "a slope over log2 of the speed, at each current's own level, is detectable beyond two standard errors",
    ));
    outcome.findings.push(quadratic());
    Ok(outcome)
}

fn quadratic() -> Finding {
    let shares = Joint::ALL.map(|joint| {
        let t = |i: f64| torque_gain(joint, i);
        // Curvature over the rise of the quadratic piece.
        (t(0.6) - 0.5 * (t(0.2) + t(1.0))) / (t(1.0) - t(0.2))
    });
    let least = shares.into_iter().fold(f64::INFINITY, f64::min);
    Finding::claim(
        "§2.1.2",
        "the yield stress is proportional to the square of the current, by (2.2)",
        "bent upwards",
        (
            format!(
                "bent downwards by {:.0} % of its rise at least",
                100.0 * least
            ),
            least < 0.0,
        ),
        "between 0.2 and 1 A, table 3.2 against its own chord; the brakes saturate",
    )
    .accounted("laminae-square")
}

fn fit() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut rows: Vec<(Joint, GainFit)> = Vec::new();
    for joint in Joint::ALL {
        let cells = matrix(joint)?;
        let level = |c: &Cell| (5.0 * c.current_a).round() as usize;
        let steady: Vec<(f64, f64, usize)> = cells
            .iter()
            .map(|c| (c.current_a, mean_nm(c), level(c)))
            .collect();
        let fit = gain_fit(&steady)
            .ok_or_else(|| Error::model("the torque gain fit", "too few currents"))?;
        let currents: Vec<f64> = (0..=200).map(|k| 0.005 * f64::from(k)).collect();
        let printed: Vec<f64> = currents.iter().map(|i| torque_gain(joint, *i)).collect();
        let (x, y): (Vec<f64>, Vec<f64>) = steady.iter().map(|s| (s.0, s.1)).unzip();
        outcome.pictures.push(Picture {
            name: name(joint),
            title: format!("{}, brake {}", FIT.title, joint.letter()),
            subtitle: "table 3.2, and the settled torques with the scatter of §3.4.1".to_owned(),
            panels: vec![Panel::new(
                ("current", "A"),
                ("torque", "N·m"),
                vec![
                    Curve::line("table 3.2", &currents, &printed),
                    Curve::dots("means of three steps", &x, &y),
                ],
            )],
        });
        outcome.findings.push(Finding::number(
            "table 3.2",
            format!("R² of the torque gain, brake {}", joint.letter()),
            (torque_gain_fit(joint).r_squared, fit.r_squared, ""),
            0.0175,
            "the spread of the four printed values; one law of scatter is drawn for all four, and the text does not say over which points it is taken",
        ));
        rows.push((joint, fit));
    }
    outcome.findings.push(coefficients(&rows));
    outcome.findings.push(rated());
    let letters: Vec<&str> = rows.iter().map(|row| row.0.letter()).collect();
    let mut columns = vec![Column::words("brake", &letters)];
    let units = ["N·m/A", "N·m", "N·m/A^2", "N·m/A", "N·m"];
    for (index, unit) in units.into_iter().enumerate() {
        let of = |fit: &GainFit| {
            [fit.linear.as_slice(), &fit.quadratic]
                .concat()
                .get(index)
                .map_or(f64::NAN, |k| k.value)
        };
        let values: Vec<f64> = rows.iter().map(|(_, fit)| of(fit)).collect();
        columns.push(Column::numbers(format!("k_{}", index + 1), unit, &values));
    }
    outcome.tables.push(Table::new("coefficients", columns));
    Ok(outcome)
}

fn rated() -> Finding {
    let least = Joint::ALL.map(|joint| torque_gain_fit(joint).greatest_nm());
    let least = least.into_iter().fold(f64::INFINITY, f64::min);
    let all = each(|joint| format!("{:.2} N·m", torque_gain_fit(joint).greatest_nm()));
    Finding::claim(
        "§3.1",
        "the rated torque output at 1 A",
        "5.6 N·m",
        (all, least >= 5.6),
        "a rating is what every brake gives at least; by table 3.2 they give 5 to 34 % more",
    )
}

/// Whether the coefficients of table 3.2 come out within their own standard errors.
fn coefficients(rows: &[(Joint, GainFit)]) -> Finding {
    let mut worst = 0.0_f64;
    for (joint, fit) in rows {
        let t = torque_gain_fit(*joint);
        let printed = [t.k_1, t.k_2, t.k_3, t.k_4, t.k_5];
        let found = fit.linear.iter().chain(&fit.quadratic);
        for (found, printed) in found.zip(printed) {
            if found.standard_error > 0.0 {
                worst = worst.max((found.value - printed).abs() / found.standard_error);
            }
        }
    }
    Finding::claim(
        "table 3.2",
        "the torque gain coefficients, found again from steps of the model",
        "20 coefficients",
        (
            format!("{worst:.1} standard errors off at most"),
            worst < 3.5,
        ),
        "3.5 standard errors: what the largest of 20 stays under in 99 of 100 cases",
    )
}

fn scatter() -> Result<Outcome, Error> {
    let implied = Joint::ALL.map(|joint| {
        let torques: Vec<f64> = [0.0]
            .into_iter()
            .chain(CURRENTS_A)
            .map(|i| torque_gain(joint, i))
            .collect();
        let mean = torques.iter().sum::<f64>() / torques.len() as f64;
        let about =
            torques.iter().map(|t| (t - mean) * (t - mean)).sum::<f64>() / torques.len() as f64;
        let r_squared = torque_gain_fit(joint).r_squared;
        (joint, libm::sqrt(about * (1.0 - r_squared) / r_squared))
    });
    // In proportion to the current, the root mean square over the six currents is 0.606 of the greatest.
    let greatest = implied.map(|(joint, rms)| (joint, rms / libm::sqrt(2.2 / 6.0)));
    let most = greatest.iter().map(|g| g.1).fold(0.0, f64::max);
    let lines = greatest.iter().map(|(joint, at_1_a)| {
        let currents: Vec<f64> = [0.0].into_iter().chain(CURRENTS_A).collect();
        let scatter: Vec<f64> = currents.iter().map(|i| i * at_1_a).collect();
        Curve::line(name(*joint), &currents, &scatter)
    });
    let letters: Vec<&str> = greatest.iter().map(|g| g.0.letter()).collect();
    Ok(Outcome {
        tables: vec![Table::new(
            "implied-scatter",
            vec![
                Column::words("brake", &letters),
                Column::numbers("mean", "N·m", &implied.map(|g| g.1)),
                Column::numbers("at one ampere", "N·m", &greatest.map(|g| g.1)),
            ],
        )],
        pictures: vec![Picture {
            name: "implied-scatter".to_owned(),
            title: SCATTER.title.to_owned(),
            subtitle: "as the R² of table 3.2 implies it, in proportion to the current".to_owned(),
            panels: vec![Panel::new(
                ("current", "A"),
                ("standard deviation", "N·m"),
                lines.collect(),
            )],
        }],
        findings: vec![Finding::number(
            "§3.4.1",
            "the greatest standard deviation of the settled torque",
            (0.4, most, "N·m"),
            0.1,
            format!(
                "\"about .4\"; implied by the R² of table 3.2, if it is of single steps: {}",
                each(|joint| {
                    let of = greatest.iter().find(|g| g.0 == joint);
                    of.map_or_else(String::new, |g| format!("{:.2}", g.1))
                })
            ),
        )],
    })
}

fn mean_nm(cell: &Cell) -> f64 {
    cell.torques_nm.iter().sum::<f64>() / 3.0
}

/// Slope of the torque over log2 of the speed, over its standard error, with a level for each current.
fn speed_slope(cells: &[Cell]) -> f64 {
    let rows: Vec<Row<6>> = cells
        .iter()
        .filter(|cell| cell.current_a > 0.0)
        .map(|cell| {
            let level = (5.0 * cell.current_a).round() as usize;
            let mut terms = [0.0; 6];
            if let Some(term) = terms.get_mut(level) {
                *term = 1.0;
            }
            let [slope, ..] = &mut terms;
            *slope = libm::log2(cell.speed_rpm);
            Row {
                terms,
                value: mean_nm(cell),
                group: level,
                spread: 1.0,
            }
        })
        .collect();
    least_squares(&rows).map_or(f64::NAN, |fit| {
        let [slope, ..] = fit.unknowns;
        slope.value / slope.standard_error
    })
}
