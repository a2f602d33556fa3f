//! This file begins a rig description from a recording: what a name or a unit suggests is called a guess, and what
//! nothing suggests is to be filled in, or `diagnose` refuses.

use std::path::Path;

use rigproof_spec::units::{Dimension, Unit};
use rigproof_trace::csv::{Hints, TimeColumn};
use rigproof_trace::rig::FILL_IN;

use super::signal::SignalView;
use crate::text::number::significant;

/// A role, what its channel is measured in, and what people call it.
struct Role {
    key: &'static str,
    dimensions: &'static [Dimension],
    names: &'static [&'static str],
}

const POSITION: Role = Role {
    key: "position",
    dimensions: &[Dimension::LENGTH, Dimension::ANGLE],
    names: &[
        "position",
        "pos",
        "x",
        "q",
        "qm",
        "theta",
        "angle",
        "dist",
        "displacement",
        "travel",
    ],
};
const EFFORT: Role = Role {
    key: "force",
    dimensions: &[Dimension::FORCE, Dimension::TORQUE],
    names: &["force", "forc", "f", "torque", "tau", "moment"],
};
const COMMAND: Role = Role {
    key: "command",
    dimensions: &[Dimension::VOLTAGE],
    names: &["command", "cmd", "u", "vir", "voltage", "drive"],
};
const CURRENT: Role = Role {
    key: "current",
    dimensions: &[Dimension::CURRENT],
    names: &["current", "cur", "i"],
};

/// The description as TOML.
pub fn toml(
    recording: &Path,
    time: Option<&TimeColumn>,
    hints: &Hints,
    signals: &[&SignalView],
) -> String {
    let position = POSITION.guess(signals);
    let effort = EFFORT.guess(signals);
    let command = COMMAND.guess(signals);
    let plant = match (effort.is_empty(), command.is_empty()) {
        (false, _) => Some("bench"),
        (true, false) => Some("axis"),
        (true, true) => None,
    };
    let rotary = rotary(position.iter().chain(&effort));
    let motion = rotary.map(|rotary| if rotary { "rotary" } else { "linear" });
    let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
    let mut lines = vec![
        "# Begun by `rigproof inspect` from a recording. A `guess` comes from a name or a unit: check it. Complete what".to_owned(),
        format!("# says {FILL_IN:?}: until then `rigproof diagnose` refuses this file and names the place."),
        format!("name = {}", string(&stem)),
        entry("plant", plant, "`axis`: a driven joint, command in; `bench`: a metered brake or damper"),
        entry("motion", motion, "`linear` or `rotary`"),
        "\n[channels]".to_owned(),
    ];
    lines.extend(time.map(|time| format!("time = {{ channel = {} }}", string(&time.name))));
    lines.push(POSITION.line(&position, rotary));
    let used = match plant {
        Some("bench") => {
            lines.push(EFFORT.line(&effort, rotary));
            let current = CURRENT.guess(signals);
            lines.extend((!current.is_empty()).then(|| CURRENT.line(&current, rotary)));
            [position, effort, current].concat()
        }
        _ => {
            lines.push(COMMAND.line(&command, rotary));
            [position, command.clone()].concat()
        }
    };
    let unused = signals
        .iter()
        .filter(|s| !used.iter().any(|u| std::ptr::eq(*u, **s)));
    let unused: Vec<&str> = unused.map(|s| s.name.as_str()).collect();
    lines
        .extend((!unused.is_empty()).then(|| format!("# not used: {}", plain(&unused.join(", ")))));
    if plant != Some("bench") {
        lines.extend(parameters(&command, rotary));
    }
    lines.extend(hinted(hints));
    let viscous = match rotary {
        Some(true) => "N·m·s/rad",
        _ => "N·s/m",
    };
    lines.push(format!(
        "\n# The physics that your model has already, one [[effect]] each; without any, all of it is to be found.\n\
         # [[effect]]\n# mechanism = \"viscous\"\n# coefficient = {{ value = 0.5, unit = {viscous:?}, status = \"unknown\" }}"
    ));
    lines.join("\n") + "\n"
}

/// Whether the plant turns, as the first unit that tells says.
fn rotary<'a>(signals: impl Iterator<Item = &'a &'a SignalView>) -> Option<bool> {
    let mut dimensions = signals.filter_map(|signal| Some(Unit::parse(&signal.unit)?.dimension));
    let dimension = dimensions.next()?;
    let Dimension([.., radian]) = dimension;
    Some(radian != 0 || dimension == Dimension::TORQUE)
}

/// The numbers of an axis, which no recording tells.
fn parameters(command: &[&SignalView], rotary: Option<bool>) -> [String; 3] {
    let [mass, effort] = match rotary {
        Some(true) => ["kg·m^2/rad", "N·m"],
        _ => ["kg", "N"],
    };
    let gain = match command {
        [signal] if !signal.unit.is_empty() => format!("{effort}/{}", signal.unit),
        _ => FILL_IN.to_owned(),
    };
    [
        "\n# The plant's own numbers; `status = \"unknown\"` makes a value the start of a fit.\n[parameters]".to_owned(),
        format!("inertia = {{ value = {FILL_IN:?}, unit = {mass:?} }}"),
        format!("command_gain = {{ value = {FILL_IN:?}, unit = {} }}", string(&gain)),
    ]
}

impl Role {
    /// The channels that may have this role: by unit and name, else by unit, else by name where there is no unit.
    fn guess<'a>(&self, signals: &[&'a SignalView]) -> Vec<&'a SignalView> {
        let unit = |s: &SignalView| Unit::parse(&s.unit).map(|unit| unit.dimension);
        let by_unit = |s: &&SignalView| unit(s).is_some_and(|d| self.dimensions.contains(&d));
        let by_name = |s: &&SignalView| {
            // Of an address, the field at its end.
            let name = s.name.to_lowercase();
            let name = name.split('[').next().unwrap_or_default();
            let field = name.rsplit('.').next().unwrap_or_default();
            let mut words = [name, field].into_iter();
            words.any(|name| {
                let word = name.split(['_', ' ', '.']).next().unwrap_or_default();
                self.names.contains(&word)
            })
        };
        let no_unit = |s: &&SignalView| unit(s).is_none() && by_name(s);
        let filters: [&dyn Fn(&&SignalView) -> bool; 3] =
            [&|s| by_unit(s) && by_name(s), &by_unit, &no_unit];
        let guesses = filters.into_iter();
        let mut guesses =
            guesses.map(|filter| signals.iter().copied().filter(filter).collect::<Vec<_>>());
        guesses.find(|found| !found.is_empty()).unwrap_or_default()
    }

    fn line(&self, found: &[&SignalView], rotary: Option<bool>) -> String {
        let key = match (self.key, rotary) {
            ("force", Some(true)) => "torque",
            (key, _) => key,
        };
        let [signal] = found else {
            let names: Vec<&str> = found.iter().map(|s| s.name.as_str()).collect();
            let why = match names.as_slice() {
                [] => "no name or unit suggests a channel".to_owned(),
                names => format!("which of {}?", plain(&names.join(", "))),
            };
            return format!("{key} = {{ channel = {FILL_IN:?}, unit = {FILL_IN:?} }}   # {why}");
        };
        let unit = &signal.unit;
        let unit = Unit::parse(unit).map_or(FILL_IN, |_| unit);
        let resolution = match (signal.quantum, signal.noise) {
            (Some((step, true)), _) => format!(", quantum = {}", significant(step, 4)),
            (_, Some(noise)) => format!(", noise = {}", significant(noise, 3)),
            _ => String::new(),
        };
        format!(
            "{key} = {{ channel = {}, unit = {}{resolution} }}   # guess",
            string(&signal.name),
            string(unit)
        )
    }
}

fn entry(key: &str, guess: Option<&str>, choices: &str) -> String {
    match guess {
        Some(word) => format!("{key} = {word:?}   # guess; {choices}"),
        None => format!("{key} = {FILL_IN:?}   # {choices}"),
    }
}

/// What the caller said of the text, which the next reader needs as well.
fn hinted(hints: &Hints) -> Vec<String> {
    let separator = hints
        .separator
        .map(|s| format!("separator = {:?}", s.name()));
    let decimal = hints.decimal.map(|d| format!("decimal = {:?}", d.name()));
    let header_lines = hints.header_lines.map(|n| format!("header_lines = {n}"));
    let mut lines: Vec<String> = [separator, decimal, header_lines]
        .into_iter()
        .flatten()
        .collect();
    if !lines.is_empty() {
        lines.insert(0, "\n[text]".to_owned());
    }
    lines
}

fn string(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A name in a comment, which ends with its line.
fn plain(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}
