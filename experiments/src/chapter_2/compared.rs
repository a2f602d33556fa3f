//! This file sets the four displays of chapter 2 and the thesis's two layouts side by side: three tasks, five measures.

use super::freedom::freedom;
use super::shown::{ALL, DISSIPATIVE, Shown};
use super::statements::{judged, said};
use super::tasks::{TASKS, Task};
use super::trials::{Measured, Tried, all, of};
use crate::finding::with_unit;
use crate::outline::cm;
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

pub const EXPERIMENT: Experiment = Experiment {
    id: "displays",
    title: "The passive displays of chapters 1 and 2 beside the two layouts",
    what: "Six displays on three tasks, nine runs each of one simulated operator (decisions 0240 to 0244), medians; arms, masses and \
           actuators that the text does not give are assumed, so that classes can be compared and sizes cannot.",
    run,
};

/// A measure: its name, its unit, and how a run gives it.
type Measure = (&'static str, &'static str, fn(&Measured) -> f64);

/// The five measures.
const MEASURES: [Measure; 5] = [
    ("greatest depth or distance", "mm", |m| 1e3 * m.greatest_m),
    ("mean depth or distance", "mm", |m| 1e3 * m.error_m),
    ("average force", "N", |m| m.force_n),
    ("energy taken", "J", |m| m.energy_j),
    ("DFT sum of acceleration", "m/s³", |m| m.roughness_m_s3),
];

fn run() -> Result<Outcome, Error> {
    let mut findings = Vec::new();
    for shown in ALL {
        if let Shown::Reed(_) = shown {
            for task in TASKS {
                findings.push(judged(shown, task)?);
            }
        }
    }
    findings.push(classes_at_walls()?);
    findings.push(steered_around()?);
    findings.push(classes_on_lines()?);
    findings.push(classes_in_freedom()?);
    Ok(Outcome {
        tables: vec![table(all()?)?],
        pictures: vec![paths("displays", "six displays", &ALL)?],
        findings,
    })
}

/// The table: a row a display and a task.
pub fn table(tried: &[Tried]) -> Result<Table, Error> {
    let mut verdicts = Vec::new();
    for tried in tried {
        verdicts.push(judged(tried.shown, tried.task)?);
    }
    let mut columns = vec![
        Column::words("display", &of_each(tried, |t| t.shown.name())),
        Column::words("task", &of_each(tried, |t| t.task.name())),
        Column::numbers("arrived", "", &of_each(tried, |t| t.arrived as f64)),
    ];
    for (name, unit, measure) in MEASURES {
        columns.push(Column::numbers(
            name,
            unit,
            &of_each(tried, |t| t.median(measure)),
        ));
    }
    let words = of_each(tried, |t| said(t.shown, t.task).words);
    let places: Vec<&str> = verdicts.iter().map(|f| f.place).collect();
    let agree: Vec<&str> = verdicts.iter().map(|f| f.verdict.name()).collect();
    let ours: Vec<&str> = verdicts.iter().map(|f| f.ours.as_str()).collect();
    columns.extend([
        Column::words("where", &places),
        Column::words("the text says", &words),
        Column::words("here", &ours),
        Column::words("verdict", &agree),
    ]);
    Ok(Table::new("displays", columns))
}

fn of_each<T>(tried: &[Tried], of: impl Fn(&Tried) -> T) -> Vec<T> {
    tried.iter().map(of).collect()
}

/// The first runs of some displays, a panel a task.
pub fn paths(name: &str, of_what: &str, shown: &[Shown]) -> Result<Picture, Error> {
    let mut panels = Vec::new();
    for task in TASKS {
        let mut curves = Vec::new();
        for shown in shown {
            let first = &of(*shown, task)?.first;
            let x: Vec<f64> = first.tips_m.iter().map(|[x, _]| cm(*x)).collect();
            let y: Vec<f64> = first.tips_m.iter().map(|[_, y]| cm(*y)).collect();
            curves.push(Curve::thin(shown.name(), &x, &y));
        }
        let x = format!("x, {}", task.name());
        panels.push(Panel::new((&x, "cm"), ("y", "cm"), curves).map());
    }
    Ok(Picture {
        name: name.to_owned(),
        title: format!("The tip of {of_what} on three tasks"),
        subtitle:
            "the first of nine runs of the simulated operator; the wall is solid above y = 37 cm"
                .to_owned(),
        panels,
    })
}

/// §1.1 on both classes at a wall.
fn classes_at_walls() -> Result<Finding, Error> {
    classes(
        Task::Wall,
        "greatest depth",
        |m| m.greatest_m,
        |steered, worst| steered > worst,
    )
}

/// "The device must essentially steer the user around it": what the displays take of the hand's work at a wall.
fn steered_around() -> Result<Finding, Error> {
    let taken_j = |shown| Ok::<f64, Error>(of(shown, Task::Wall)?.median(|m| m.energy_j));
    let steered_j = taken_j(Shown::Scooter)?;
    let mut all = true;
    let mut texts = vec![format!("Scooter {}", with_unit(1e3 * steered_j, "mJ"))];
    for shown in DISSIPATIVE {
        let other_j = taken_j(shown)?;
        all &= steered_j < 0.1 * other_j;
        texts.push(format!(
            "{} {}",
            shown.name(),
            with_unit(1e3 * other_j, "mJ")
        ));
    }
    let ours = format!("energy taken: {}", texts.join(", "));
    let because = "less than a tenth of what any dissipative display takes: it turns the motion and does not stop it";
    let statement = "what a steerable display does at a wall";
    let stated = "it steers the user around it";
    let finding = Finding::claim("§1.1", statement, stated, (ours, all), because);
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("displays-tasks"),
        false => finding,
    })
}

/// §1.1 on both classes on a line.
fn classes_on_lines() -> Result<Finding, Error> {
    classes(
        Task::Line,
        "mean distance",
        |m| m.error_m,
        |steered, worst| steered < worst,
    )
}

fn classes(
    task: Task,
    measure: &str,
    of_run: fn(&Measured) -> f64,
    holds: fn(f64, f64) -> bool,
) -> Result<Finding, Error> {
    let steered = of(Shown::Scooter, task)?.median(of_run);
    let mut all = true;
    let mut texts = vec![format!("Scooter {}", with_unit(1e3 * steered, "mm"))];
    for shown in DISSIPATIVE {
        let other = of(shown, task)?.median(of_run);
        all &= holds(steered, other);
        texts.push(format!("{} {}", shown.name(), with_unit(1e3 * other, "mm")));
    }
    let (statement, stated) = match task {
        Task::Wall => (
            "the two classes at a wall",
            "steerable poor, dissipative excel",
        ),
        _ => (
            "the two classes on a line",
            "steerable near perfect, dissipative challenged",
        ),
    };
    let ours = format!("{measure}: {}", texts.join(", "));
    let because =
        "the steerable display beside each of the four dissipative ones, medians of nine runs";
    let finding = Finding::claim("§1.1", statement, stated, (ours, all), because);
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("displays-tasks"),
        false => finding,
    })
}

/// §1.1 on free motion.
fn classes_in_freedom() -> Result<Finding, Error> {
    let [steered, _] = freedom(Shown::Scooter)?;
    let mut all = true;
    let mut texts = vec![format!("Scooter {:.0} %", 100.0 * steered)];
    for shown in DISSIPATIVE {
        let [least, _] = freedom(shown)?;
        all &= steered < least;
        texts.push(format!("{} {:.0} %", shown.name(), 100.0 * least));
    }
    let ours = format!("least share of a push followed: {}", texts.join(", "));
    let because =
        "a push of 6 N for 0.1 s in 24 directions, beside the same body with nothing that resists";
    let stated = "steerable incapable, dissipative able";
    let finding = Finding::claim(
        "§1.1",
        "the two classes in free motion",
        stated,
        (ours, all),
        because,
    );
    Ok(match finding.is_unaccounted() {
        true => finding.accounted("displays-tasks"),
        false => finding,
    })
}
