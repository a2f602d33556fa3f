//! This file shows one run of the closed loop: the tip's way, how far it strays, how hard it is pushed, what the brakes get.

use rigproof_model::control::path::{Line, Path};
use rigproof_model::trial::Record;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::outline::cm;
use crate::{Column, Curve, Panel, Table};

/// Times of the samples, s.
fn time_s(record: &Record) -> Vec<f64> {
    (0..record.tips_m.len())
        .map(|k| SAMPLE_STEP_S * k as f64)
        .collect()
}

/// Signed distances from a line, positive to its left, cm.
pub fn offsets_cm(record: &Record, line: &Line) -> Vec<f64> {
    let tips = record.tips_m.iter();
    tips.map(|tip_m| cm(line.nearest(*tip_m).offset_m))
        .collect()
}

fn currents_a(record: &Record, joint: Joint) -> Vec<f64> {
    let of = record.commands.iter().map(|command| {
        let current_a = command.currents_a.get(joint as usize);
        current_a.copied().unwrap_or(f64::NAN)
    });
    of.collect()
}

/// The run as a table.
pub fn table(name: &str, record: &Record, line: &Line, layout: Layout) -> Table {
    let pick = |pairs: &[[f64; 2]]| -> [Vec<f64>; 2] {
        [
            pairs.iter().map(|[x, _]| *x).collect(),
            pairs.iter().map(|[_, y]| *y).collect(),
        ]
    };
    let ([x, y], [f_x, f_y]) = (pick(&record.tips_m), pick(&record.forces_n));
    let offsets: Vec<f64> = record
        .tips_m
        .iter()
        .map(|tip_m| line.nearest(*tip_m).offset_m)
        .collect();
    let mut columns = vec![
        Column::numbers("tip x", "m", &x),
        Column::numbers("tip y", "m", &y),
        Column::numbers("offset", "m", &offsets),
        Column::numbers("force x", "N", &f_x),
        Column::numbers("force y", "N", &f_y),
    ];
    for joint in layout.brakes() {
        let name = format!("current {}", joint.letter());
        columns.push(Column::numbers(name, "A", &currents_a(record, *joint)));
    }
    Table::run(name, &time_s(record), columns)
}

/// The way of the tip, cm.
pub fn way(name: &str, record: &Record) -> Curve {
    let x: Vec<f64> = record.tips_m.iter().map(|[x, _]| cm(*x)).collect();
    let y: Vec<f64> = record.tips_m.iter().map(|[_, y]| cm(*y)).collect();
    Curve::line(name, &x, &y)
}

/// Distances from the path over time.
pub fn distances(runs: &[(&str, &Record)], line: &Line) -> Panel {
    let curves = runs
        .iter()
        .map(|(name, run)| Curve::line(*name, &time_s(run), &offsets_cm(run, line)));
    Panel::new(
        ("time", "s"),
        ("distance from the path", "cm"),
        curves.collect(),
    )
}

/// Magnitudes of the tip force over time.
pub fn forces(runs: &[(&str, &Record)]) -> Panel {
    let curves = runs.iter().map(|(name, run)| {
        let force = run.forces_n.iter().map(|[x, y]| libm::hypot(*x, *y));
        Curve::line(*name, &time_s(run), &force.collect::<Vec<f64>>())
    });
    Panel::new(("time", "s"), ("tip force", "N"), curves.collect())
}

/// What the brakes are given over time, each above the one before.
pub fn commands(record: &Record, layout: Layout) -> Panel {
    let joints = layout.brakes().iter().zip([0.0, 1.25, 2.5, 3.75]);
    let curves = joints.map(|(joint, raised)| {
        let current = currents_a(record, *joint);
        let current: Vec<f64> = current.iter().map(|i| i + raised).collect();
        let name = format!("brake {}", joint.letter());
        Curve::thin(name, &time_s(record), &current)
    });
    Panel::new(("time", "s"), ("current, shifted", "A"), curves.collect())
}
