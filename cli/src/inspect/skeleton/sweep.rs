//! This file begins the description of a static sweep: an effort over a command, a speed, or both.

use std::path::Path;

use rigproof_spec::units::Dimension;
use rigproof_trace::csv::Hints;
use rigproof_trace::rig::SCHEMA_LINE;

use super::{
    COMMAND, CURRENT, EFFORT, Role, entry, friction, hinted, not_used, rotary, string, unit_of,
};
use crate::inspect::signal::SignalView;
use crate::text::number::significant;

const SPEED: Role = Role {
    key: "speed",
    dimensions: &[
        Dimension::LENGTH.per(Dimension::TIME),
        Dimension::ANGLE.per(Dimension::TIME),
    ],
    names: &[
        "speed", "velocity", "vel", "v", "omega", "w", "rpm", "qd", "dq",
    ],
};

/// The share of the range of commands that is an end of it.
const AN_END: f64 = 0.02;

/// The description as TOML.
pub fn of_sweep(recording: &Path, hints: &Hints, signals: &[&SignalView]) -> String {
    let (effort, speed) = (EFFORT.guess(signals), SPEED.guess(signals));
    let current = CURRENT.guess(signals);
    let command = match current.is_empty() {
        true => COMMAND.guess(signals),
        false => Vec::new(),
    };
    let rotary = rotary(effort.iter().chain(&speed));
    let motion = rotary.map(|rotary| if rotary { "rotary" } else { "linear" });
    let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
    let mut lines = vec![
        SCHEMA_LINE.to_owned(),
        "# Begun by `rigproof inspect --sweep`. A `guess` comes from a name or a unit: check it."
            .to_owned(),
        format!("name = {}", string(&stem)),
        "plant = \"bench\"".to_owned(),
        entry("motion", motion, "`linear` or `rotary`"),
        "\n[channels]".to_owned(),
        EFFORT.line(&effort, rotary),
    ];
    for (role, found) in [(&SPEED, &speed), (&CURRENT, &current), (&COMMAND, &command)] {
        lines.extend((!found.is_empty()).then(|| role.line(found, rotary)));
    }
    let driving = [current, command].concat();
    if driving.is_empty() && speed.is_empty() {
        lines.push(
            "# A sweep is over something: name its `command`, `current` or `speed`.".to_owned(),
        );
    }
    lines.push(
        "\n# Each row was taken after everything had settled.\n[protocol]\ndrive = \"static\""
            .to_owned(),
    );
    match driving.is_empty() {
        true => lines.push(friction(Some("bench"), size(&effort), rotary)),
        false => lines.extend(characteristic(&driving, &effort, rotary)),
    }
    lines.extend(hinted(hints));
    let used = [effort, speed, driving].concat();
    lines.extend(not_used(signals, &used));
    lines.join("\n") + "\n"
}

/// About how large an effort is.
fn size(effort: &[&SignalView]) -> Option<f64> {
    effort.iter().find_map(|signal| signal.size())
}

/// The straight line between the efforts at both ends of the command: what the diagnosis then says is
/// how the law departs from it.
fn characteristic(
    driving: &[&SignalView],
    effort: &[&SignalView],
    rotary: Option<bool>,
) -> Vec<String> {
    let ([command], [effort]) = (driving, effort) else {
        return super::characteristic(driving, rotary).into();
    };
    let Some(points) = ends(command.samples(), effort.samples()) else {
        return super::characteristic(driving, rotary).into();
    };
    let [from, to] = points.map(|point| point.map(|x| significant(x, 4)));
    let unit = if rotary == Some(true) { "N·m" } else { "N" };
    vec![
        "\n# The effort at which it settles under its command, straight between the points. Begun with the line between the ends of\n# this sweep, so that `diagnose` says how the law departs from a line; put your data sheet's or your model's in its place.\n[characteristic]".to_owned(),
        format!("command = {{ points = [{}, {}], unit = {} }}", from[0], to[0], unit_of(driving)),
        format!("effort = {{ points = [{}, {}], unit = {unit:?} }}", from[1], to[1]),
    ]
}

/// The least and the greatest command, with the median size of the effort there.
fn ends(commands: &[f64], efforts: &[f64]) -> Option<[[f64; 2]; 2]> {
    let pairs = commands.iter().zip(efforts);
    let pairs = pairs.filter(|(command, effort)| command.is_finite() && effort.is_finite());
    let rows: Vec<[f64; 2]> = pairs
        .map(|(command, effort)| [*command, effort.abs()])
        .collect();
    let commands = || rows.iter().map(|row| row[0]);
    let (first, last) = (
        commands().fold(f64::INFINITY, f64::min),
        commands().fold(f64::NEG_INFINITY, f64::max),
    );
    let median_near = |end: f64| -> Option<f64> {
        let near = |row: &&[f64; 2]| (row[0] - end).abs() <= AN_END * (last - first);
        let mut efforts: Vec<f64> = rows.iter().filter(near).map(|row| row[1]).collect();
        efforts.sort_by(f64::total_cmp);
        efforts.get(efforts.len() / 2).copied()
    };
    let (low, high) = (median_near(first)?, median_near(last)?);
    (last > first).then_some([[first, low], [last, high]])
}
