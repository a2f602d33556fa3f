//! This file begins a rig description from a recording: what a name or a unit suggests is called a guess, and what
//! nothing suggests is to be filled in, or `diagnose` refuses.

mod sweep;

use std::path::Path;

use rigproof_spec::units::{Dimension, Unit};
use rigproof_trace::csv::{Hints, TimeColumn};
use rigproof_trace::rig::{FILL_IN, SCHEMA_LINE};

use super::signal::SignalView;
use crate::text::number::significant;
pub use sweep::of_sweep;

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

/// Words in a name that say that its channel is computed or wanted, and not measured.
const DERIVED: [&str; 22] = [
    "calc",
    "calculated",
    "comp",
    "computed",
    "est",
    "estimated",
    "model",
    "sim",
    "simulated",
    "ideal",
    "pred",
    "predicted",
    "ref",
    "reference",
    "target",
    "goal",
    "des",
    "desired",
    "set",
    "setpoint",
    "soll",
    "planned",
];
/// Words in a name that say that its channel is what the plant is told.
const TOLD: [&str; 10] = [
    "cmd",
    "command",
    "commanded",
    "u",
    "set",
    "setpoint",
    "soll",
    "des",
    "desired",
    "drive",
];

/// What the plant may be, and why.
struct PlantGuess<'a> {
    plant: Option<&'static str>,
    why: String,
    effort: Vec<&'a SignalView>,
    command: Vec<&'a SignalView>,
}

/// A torque or force is measured unless its name says that it is told; then the plant is a driven joint, as it is where only
/// volts or a current are there.
fn plant<'a>(signals: &[&'a SignalView]) -> PlantGuess<'a> {
    let effort = EFFORT.guess(signals);
    let command = COMMAND.guess(signals);
    let name = |found: &[&SignalView]| {
        let names: Vec<&str> = found.iter().map(|s| s.name.as_str()).collect();
        plain(&names.join(", "))
    };
    let told: Vec<&SignalView> = effort
        .iter()
        .copied()
        .filter(|s| has_word(s, &TOLD))
        .collect();
    let measured = effort.len() > told.len();
    let current = CURRENT.guess(signals);
    let (plant, why, command) = match (
        measured,
        told.is_empty(),
        command.is_empty(),
        current.is_empty(),
    ) {
        (true, ..) => (
            "bench",
            format!(
                "`{}` is taken for measured. Is it what a motor is told? Then plant = \"axis\", and it is the `command`",
                name(&effort)
            ),
            Vec::new(),
        ),
        (false, false, ..) => (
            "axis",
            format!(
                "the name of `{}` says that it is told. Is it measured? Then plant = \"bench\", and it is the `force` or `torque`",
                name(&told)
            ),
            told,
        ),
        (_, _, false, _) => (
            "axis",
            format!(
                "`{}` drives it, and no force or torque is measured",
                name(&command)
            ),
            command,
        ),
        (_, _, _, false) => (
            "axis",
            format!(
                "the current `{}` drives it, and no force or torque is measured",
                name(&current)
            ),
            current,
        ),
        _ => {
            let why =
                "`axis`: a driven joint, command in; `bench`: a metered brake or damper".to_owned();
            return PlantGuess {
                plant: None,
                why,
                effort,
                command,
            };
        }
    };
    PlantGuess {
        plant: Some(plant),
        why,
        effort,
        command,
    }
}

/// Whether one of the words stands in a name.
fn has_word(signal: &SignalView, words: &[&str]) -> bool {
    let name = signal.name.to_lowercase();
    let mut parts = name.split(|c: char| !c.is_alphanumeric());
    parts.any(|part| words.contains(&part))
}

/// The description as TOML.
pub fn toml(
    recording: &Path,
    time: Option<&TimeColumn>,
    hints: &Hints,
    signals: &[&SignalView],
) -> String {
    let position = POSITION.guess(signals);
    let PlantGuess {
        plant,
        why,
        effort,
        command,
    } = plant(signals);
    let rotary = rotary(position.iter().chain(&effort).chain(&command));
    let motion = rotary.map(|rotary| if rotary { "rotary" } else { "linear" });
    let level = effort.iter().find_map(|signal| signal.size());
    let stem = recording.file_stem().unwrap_or_default().to_string_lossy();
    let mut lines = vec![
        SCHEMA_LINE.to_owned(),
        "# Begun by `rigproof inspect` from a recording. A `guess` comes from a name or a unit: check it. Complete what".to_owned(),
        format!("# says {FILL_IN:?}: until then `rigproof diagnose` refuses this file and names the place."),
        format!("name = {}", string(&stem)),
        entry("plant", plant, &why),
        entry("motion", motion, "`linear` or `rotary`"),
        "\n[channels]".to_owned(),
    ];
    lines.extend(time.map(|time| format!("time = {{ channel = {} }}", string(&time.name))));
    lines.push(POSITION.line(&position, rotary));
    let used = match plant {
        Some("bench") => {
            lines.push(EFFORT.line(&effort, rotary));
            let current = CURRENT.guess(signals);
            let volts = match current.is_empty() {
                true => COMMAND.guess(signals),
                false => Vec::new(),
            };
            lines.extend((!current.is_empty()).then(|| CURRENT.line(&current, rotary)));
            if !volts.is_empty() {
                lines.push(COMMAND.line(&volts, rotary));
                lines.extend(characteristic(&volts, rotary));
            }
            if !current.is_empty() && rotary == Some(true) {
                lines.push("# A brake's torque follows its current: `rigproof identify brake RECORDINGS --rig THIS_FILE` writes its table, `[brake]`.\n# Without one, all that the current does is left over, and no law of the library is it.".to_owned());
            }
            [position, effort, current, volts].concat()
        }
        _ => {
            lines.push(COMMAND.line(&command, rotary));
            [position, command.clone()].concat()
        }
    };
    lines.extend(not_used(signals, &used));
    if plant != Some("bench") {
        lines.extend(parameters(&command, rotary));
    }
    lines.extend(hinted(hints));
    lines.push(friction(plant, level, rotary));
    lines.join("\n") + "\n"
}

/// The friction that a bench begins with, so that its description diagnoses as it is; for another plant how to state one.
fn friction(plant: Option<&str>, level: Option<f64>, rotary: Option<bool>) -> String {
    let [effort, viscous] = match rotary {
        Some(true) => ["N·m", "N·m·s/rad"],
        _ => ["N", "N·s/m"],
    };
    match (plant, level) {
        (Some("bench"), Some(level)) => {
            let [dry, drag] = [0.3 * level, 0.03 * level].map(|x| significant(x, 2));
            format!(
                "\n# The physics that your model has already, one [[effect]] each: begun with dry and viscous friction, whose numbers are fitted.\n\
                 # Take out what your model does not have, and put in what it has.\n\
                 [[effect]]\nmechanism = \"dry_offset\"\nlevel = {{ value = {dry}, unit = {effort:?}, status = \"unknown\" }}\n\n\
                 [[effect]]\nmechanism = \"viscous\"\ncoefficient = {{ value = {drag}, unit = {viscous:?}, status = \"unknown\" }}"
            )
        }
        _ => format!(
            "\n# The physics that your model has already, one [[effect]] each; without any, all of it is to be found.\n\
             # [[effect]]\n# mechanism = \"viscous\"\n# coefficient = {{ value = 0.5, unit = {viscous:?}, status = \"unknown\" }}"
        ),
    }
}

/// The static characteristic of a brake under its command, which its data sheet tells or a measurement at a few commands.
fn characteristic(command: &[&SignalView], rotary: Option<bool>) -> [String; 4] {
    let unit = unit_of(command);
    let effort = if rotary == Some(true) { "N·m" } else { "N" };
    [
        "\n# The brake or damper by the effort at which it settles under its command, straight between the points. Does the command drive\n# the motor that moves it instead? Then take out this table and the channel.\n[characteristic]".to_owned(),
        format!("command = {{ points = {FILL_IN:?}, unit = {unit} }}   # such as [0, 2, 5]"),
        format!("effort = {{ points = {FILL_IN:?}, unit = {effort:?} }}"),
        "# rising = { value = 20, unit = \"ms\" }   # the time constants with which it follows; without them at once\n# falling = { value = 20, unit = \"ms\" }".to_owned(),
    ]
}

/// The unit of the only channel that was found, or that it is to be filled in.
fn unit_of(found: &[&SignalView]) -> String {
    match found {
        [signal] if !signal.unit.is_empty() => string(&signal.unit),
        _ => format!("{FILL_IN:?}"),
    }
}

/// A comment on the channels that no line names.
fn not_used(signals: &[&SignalView], used: &[&SignalView]) -> Option<String> {
    let unused = signals
        .iter()
        .filter(|s| !used.iter().any(|u| std::ptr::eq(*u, **s)));
    let unused: Vec<&str> = unused.map(|s| s.name.as_str()).collect();
    (!unused.is_empty()).then(|| format!("# not used: {}", plain(&unused.join(", "))))
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
    let told = |signal: &&SignalView| {
        let dimension = Unit::parse(&signal.unit).map(|unit| unit.dimension);
        dimension.is_some_and(|d| EFFORT.dimensions.contains(&d))
    };
    if let Some(signal) = command.first().filter(|signal| told(signal)) {
        return [
            "\n# The plant's own numbers; `status = \"unknown\"` makes a value the start of a fit.\n[parameters]".to_owned(),
            format!("inertia = {{ value = {FILL_IN:?}, unit = {mass:?} }}"),
            format!("command_gain = {{ value = 1.0, unit = {} }}   # a command in {} acts as it is", string("1"), signal.unit),
        ];
    }
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
        let found = guesses.find(|found| !found.is_empty()).unwrap_or_default();
        // What is measured comes before what is computed or wanted.
        let measured = found.iter().copied().filter(|s| !has_word(s, &DERIVED));
        let measured: Vec<&SignalView> = measured.collect();
        if measured.is_empty() { found } else { measured }
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
        // What samples scatter beyond the resolution is noise; what they scatter within it, the resolution says.
        let grid = signal
            .quantum
            .filter(|(_, on_grid)| *on_grid)
            .map(|(step, _)| step);
        let noise = signal
            .noise
            .filter(|noise| grid.is_none_or(|step| *noise > step));
        let quantum = grid.map_or(String::new(), |step| {
            format!(", quantum = {}", significant(step, 4))
        });
        let noise = noise.map_or(String::new(), |noise| {
            format!(", noise = {}", significant(noise, 3))
        });
        let resolution = quantum + &noise;
        let guess = match signal.unit_is_guessed {
            true => format!("guess; that it is in {} too, from its name", signal.unit),
            false => "guess".to_owned(),
        };
        format!(
            "{key} = {{ channel = {}, unit = {}{resolution} }}   # {guess}",
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
pub fn hinted(hints: &Hints) -> Vec<String> {
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

pub fn string(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A name in a comment, which ends with its line.
pub fn plain(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests;
