//! Figures 6.5 to 6.8: the two velocity controllers in simulation, on both configurations.

use rigproof_model::control::GainUnit;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::Method;

use super::proof::{Proof, line, proof};
use super::sample;
use crate::outline;
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// SDOF, 3-brake.
pub const SDOF_THREE: Experiment = Experiment {
    id: "6.5",
    title: "SDOF velocity control simulation for 3-brake configuration",
    what: "Line y = 38 cm, start 4 cm below it, a constant push of 7 N along and 3 N towards it, with and without control; from x = -15 to 15 cm, which is chosen.",
    run: || sdof(Layout::ThreeBrake),
};
/// SDOF, 4-brake.
pub const SDOF_FOUR: Experiment = Experiment {
    id: "6.6",
    title: "SDOF velocity control simulation for 4-brake configuration",
    what: "As figure 6.5 on the 4-brake configuration.",
    run: || sdof(Layout::FourBrake),
};
/// Proportional, 3-brake.
pub const PROPORTIONAL_THREE: Experiment = Experiment {
    id: "6.7",
    title: "Proportional velocity control simulation for 3-brake configuration",
    what: "As figure 6.5 with proportional control: the gain of the figure is not said, so both gains of table 6.1, and the low one also in its printed unit.",
    run: || proportional(Layout::ThreeBrake),
};
/// Proportional, 4-brake.
pub const PROPORTIONAL_FOUR: Experiment = Experiment {
    id: "6.8",
    title: "Proportional velocity control simulation for 4-brake configuration",
    what: "As figure 6.7 on the 4-brake configuration.",
    run: || proportional(Layout::FourBrake),
};

/// The gain unit where there is no gain, and of the gains as they are read here (erratum `gain-unit`).
const UNIT: GainUnit = GainUnit::PerCentimetre;

fn sdof(layout: Layout) -> Result<Outcome, Error> {
    let none = proof(layout, Method::Uncontrolled, UNIT)?;
    let sdof = proof(layout, Method::Sdof, UNIT)?;
    let other = proof(other(layout), Method::Sdof, UNIT)?;
    let runs = [("no control", &none), ("SDOF", &sdof)];
    let title = match layout {
        Layout::ThreeBrake => SDOF_THREE.title,
        Layout::FourBrake => SDOF_FOUR.title,
    };
    Ok(Outcome {
        findings: vec![
            fewer_errors(layout, "SDOF", &sdof, &other),
            curves_are_lost(&runs),
        ],
        ..outcome(layout, title, &runs, 1)?
    })
}

fn proportional(layout: Layout) -> Result<Outcome, Error> {
    let none = proof(layout, Method::Uncontrolled, UNIT)?;
    let sdof = proof(layout, Method::Sdof, UNIT)?;
    let high = proof(layout, Method::ProportionalHigh, UNIT)?;
    let low = proof(layout, Method::ProportionalLow, UNIT)?;
    let metre = GainUnit::PerMetre;
    let printed = proof(layout, Method::ProportionalLow, metre)?;
    let high_printed = proof(layout, Method::ProportionalHigh, metre)?;
    let other = proof(other(layout), Method::ProportionalHigh, UNIT)?;
    let runs = [
        ("no control", &none),
        ("high gain", &high),
        ("low gain", &low),
        ("low gain as printed", &printed),
    ];
    let title = match layout {
        Layout::ThreeBrake => PROPORTIONAL_THREE.title,
        Layout::FourBrake => PROPORTIONAL_FOUR.title,
    };
    Ok(Outcome {
        findings: vec![
            fewer_errors(layout, "proportional, high gain", &high, &other),
            more_accurate(&high, &sdof),
            switches(&high, &sdof),
            full_force(&high, &high_printed),
            gains(&[
                ("10 000 N·s/cm", &high),
                ("10 000 N·s/m", &high_printed),
                ("5 N·s/cm", &low),
                ("5 N·s/m", &printed),
            ]),
            curves_are_lost(&runs),
        ],
        ..outcome(layout, title, &runs, 1)?
    })
}

const fn other(layout: Layout) -> Layout {
    match layout {
        Layout::ThreeBrake => Layout::FourBrake,
        Layout::FourBrake => Layout::ThreeBrake,
    }
}

/// "In both cases, the 4-brake configuration exhibits slightly less path error than the 3-brake configuration."
fn fewer_errors(layout: Layout, name: &str, ours: &Proof, other: &Proof) -> Finding {
    let [three, four] = match layout {
        Layout::ThreeBrake => [ours, other],
        Layout::FourBrake => [other, ours],
    };
    let ratio = four.error_cm / three.error_cm;
    Finding::claim(
        "§6.4",
        format!("{name}: the 4-brake configuration has slightly less path error"),
        "slightly less",
        (
            format!(
                "{:.3} cm against {:.3} cm; once on the path {:.4} against {:.4} cm",
                four.error_cm, three.error_cm, four.late_cm, three.late_cm
            ),
            (0.5..1.0).contains(&ratio),
        ),
        "(6.14) over the whole run, less than on the 3-brake configuration and more than half of it",
    )
}

fn more_accurate(high: &Proof, sdof: &Proof) -> Finding {
    Finding::claim(
        "§6.4",
        "proportional control: much greater accuracy than SDOF control",
        "much greater",
        (
            format!(
                "{:.4} cm from the path against {:.4} cm",
                high.late_cm, sdof.late_cm
            ),
            high.late_cm < 0.5 * sdof.late_cm,
        ),
        "high gain; average distance from x = 5 cm on, where the path has been reached: less than half",
    )
}

fn switches(high: &Proof, sdof: &Proof) -> Finding {
    Finding::claim(
        "§6.4",
        "proportional control: switches more rapidly between brakes than SDOF control",
        "more rapidly",
        (
            format!(
                "{:.0} changes a second against {:.0}",
                high.switches_hz, sdof.switches_hz
            ),
            high.switches_hz > sdof.switches_hz,
        ),
        "high gain; changes of the chosen brake, none and all included",
    )
}

/// "The high gain ensures maximum normalized force is commanded to each actuated brake."
fn full_force(high: &Proof, printed: &Proof) -> Finding {
    let [share, as_printed] = [high, printed].map(|run| 100.0 * run.full);
    Finding::claim(
        "§6.5.1",
        "the high gain ensures that the greatest force is commanded to each actuated brake",
        "ensures",
        (
            format!(
                "in {share:.1} % of the commands to a brake; with 10 000 N·s/m in {as_printed:.1} %"
            ),
            share > 95.0,
        ),
        "10 000 N·s/cm, in 95 % of the commands: across the path slower than 0.02 mm/s even that gain asks for less",
    )
}

/// What each gain does; the text does not say which the figure shows.
fn gains(runs: &[(&str, &Proof)]) -> Finding {
    let each = runs.iter().map(|(name, run)| {
        format!(
            "{name} {:.4} cm, {:.0} changes a second",
            run.late_cm, run.switches_hz
        )
    });
    Finding {
        stated: "not stated".to_owned(),
        ..Finding::lost(
            "§6.4",
            "the gain of the figure",
            each.collect::<Vec<String>>().join("; "),
            "distance once on the path and changes with each gain of table 6.1 in both units (erratum gain-unit); only the high gain is much more accurate than SDOF control on both configurations",
        )
    }
}

fn curves_are_lost(runs: &[(&str, &Proof)]) -> Finding {
    let each = runs.iter().map(|(name, run)| {
        let end_s = run.record.tips_m.len() as f64 * 1e-3;
        format!("{name} {:.2} cm in {end_s:.2} s", run.error_cm)
    });
    Finding::lost(
        "§6.4",
        "tip trajectory and actuator commands, controlled and uncontrolled",
        each.collect::<Vec<String>>().join("; "),
        "the figure is lost, and so are where along the line it starts and how long it runs (gap proof-of-concept-start)",
    )
}

/// Tables and picture; the commands are those of one of the runs.
fn outcome(
    layout: Layout,
    title: &str,
    runs: &[(&str, &Proof)],
    commanded: usize,
) -> Result<Outcome, Error> {
    let line = line()?;
    let (names, records): (Vec<&str>, Vec<_>) =
        runs.iter().map(|(name, run)| (*name, &run.record)).unzip();
    let mut tables: Vec<Table> = names
        .iter()
        .zip(&records)
        .map(|(name, record)| sample::table(&file(name), record, &line, layout))
        .collect();
    let column =
        |pick: fn(&Proof) -> f64| -> Vec<f64> { runs.iter().map(|(_, run)| pick(run)).collect() };
    tables.push(Table::new(
        "judged",
        vec![
            Column::words("controller", &names),
            Column::numbers("path error", "cm", &column(|run| run.error_cm)),
            Column::numbers(
                "distance once on the path",
                "cm",
                &column(|run| run.late_cm),
            ),
            Column::numbers("switches", "1/s", &column(|run| run.switches_hz)),
        ],
    ));
    let named: Vec<_> = names.iter().copied().zip(records.iter().copied()).collect();
    let ways = named.iter().map(|(name, record)| sample::way(name, record));
    let mut map: Vec<Curve> = ways.collect();
    map.push(Curve::thin("desired path", &[-15.0, 15.0], &[38.0, 38.0]));
    let mut panels = vec![
        Panel::new(("x", "cm"), ("y", "cm"), map).map(),
        sample::distances(&named, &line),
    ];
    if let Some((_, record)) = named.get(commanded) {
        panels.push(sample::commands(record, layout));
    }
    let shown = names.get(commanded).copied().unwrap_or_default();
    let picture = Picture {
        name: "simulation".to_owned(),
        title: title.to_owned(),
        subtitle: format!(
            "{} configuration, push of 7 N along the line and 3 N towards it; currents: {shown}, each brake 1.25 A above the one before",
            outline::name(layout)
        ),
        panels,
    };
    Ok(Outcome {
        tables,
        pictures: vec![picture],
        findings: Vec::new(),
    })
}

/// A file's name for a curve's.
fn file(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("-").to_lowercase()
}
