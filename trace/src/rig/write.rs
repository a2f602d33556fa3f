//! This file writes a rig description as TOML that reads back bit for bit.

use std::collections::BTreeMap;
use std::fmt::Write;

use rigproof_spec::effect::{Motion, Quantity};
use rigproof_spec::units::Dimension;

use crate::csv::TimeColumn;

use super::{
    Brake, ChannelMap, RecordingEntry, Rig, RigEffect, SCHEMA_LINE, Servo, Status, Value,
    motion_name, text,
};

impl Rig {
    /// The description as TOML, every value in SI units.
    pub fn to_toml(&self) -> String {
        let mut lines = vec![
            SCHEMA_LINE.to_owned(),
            format!("name = {}", string(&self.name)),
            format!("plant = {}", string(self.plant.name())),
            format!("motion = {}", string(motion_name(self.motion))),
        ];
        lines.extend(
            self.source
                .as_ref()
                .map(|text| format!("source = {}", string(text))),
        );
        self.write_channels(&mut lines);
        lines.extend(text::lines(&self.text));
        if let (Some(parameters), Some(gain)) = (&self.parameters, self.command_gain_dimension()) {
            let inertia = Quantity::Inertia.dimension(self.motion);
            lines.push("\n[parameters]".into());
            lines.push(format!("inertia = {}", value(&parameters.inertia, inertia)));
            lines.push(format!(
                "command_gain = {}",
                value(&parameters.command_gain, gain)
            ));
        }
        lines.extend(self.brake.iter().flat_map(Brake::lines));
        let dimensions = [self.driving(), self.effort()];
        let characteristic = self.characteristic.iter();
        lines.extend(characteristic.flat_map(|own| own.lines(dimensions)));
        lines.extend(self.servo.iter().flat_map(Servo::lines));
        lines.extend(self.recordings.iter().flat_map(RecordingEntry::lines));
        for effect in &self.effects {
            lines.extend(effect_lines(effect, (self.motion, self.driving())));
        }
        lines.extend(self.protocol.lines());
        lines.extend(provenance_lines(&self.provenance));
        lines.join("\n") + "\n"
    }

    fn write_channels(&self, lines: &mut Vec<String>) {
        lines.push("\n[channels]".into());
        lines.extend(self.channels.time.as_ref().map(time_line));
        let effort = match self.motion {
            Motion::Linear => "force",
            Motion::Rotary => "torque",
        };
        let roles = [
            ("position", self.channels.position.as_ref()),
            ("speed", self.channels.speed.as_ref()),
            ("command", self.channels.command.as_ref()),
            ("enabled", self.channels.enabled.as_ref()),
            (effort, self.channels.force.as_ref()),
            ("current", self.channels.current.as_ref()),
            ("simulated", self.channels.simulated.as_ref()),
        ];
        for (role, map) in roles {
            lines.extend(map.map(|map| format!("{role} = {}", channel(map))));
        }
    }
}

pub(super) fn time_line(time: &TimeColumn) -> String {
    let unit = match time.unit.as_str() {
        "" => String::new(),
        unit => format!(", unit = {}", string(unit)),
    };
    format!("time = {{ channel = {}{unit} }}", string(&time.name))
}

pub(super) fn provenance_lines(provenance: &BTreeMap<String, String>) -> Vec<String> {
    let title = (!provenance.is_empty()).then(|| "\n[provenance]".to_owned());
    let entries = provenance.iter();
    let entries = entries.map(|(key, text)| format!("{} = {}", string(key), string(text)));
    title.into_iter().chain(entries).collect()
}

/// The title of the table, the mechanism, then its parameters.
pub(super) fn effect_lines(
    effect: &RigEffect,
    (motion, driving): (Motion, Dimension),
) -> Vec<String> {
    let mut lines = vec![
        "\n[[effect]]".to_owned(),
        format!("mechanism = {}", string(effect.mechanism.name())),
    ];
    lines.extend(effect.of_torque.then(|| "of = \"torque\"".to_owned()));
    for (parameter, number) in effect.mechanism.parameters().iter().zip(&effect.values) {
        let dimension = effect.driven(parameter, motion, driving);
        lines.push(format!("{} = {}", parameter.name, value(number, dimension)));
    }
    let onset = effect.onset.as_ref();
    lines.extend(onset.map(|onset| format!("onset = {}", value(onset, Dimension::TIME))));
    lines
}

pub(super) fn channel(map: &ChannelMap) -> String {
    let mut text = format!(
        "{{ channel = {}, unit = {}",
        string(&map.channel),
        string(&map.unit)
    );
    if let Some(unit) = &map.column_unit {
        text += &format!(", column_unit = {}", string(unit));
    }
    for (key, number, default) in [
        ("offset", map.offset, 0.0),
        ("scale", map.scale, 1.0),
        ("sign", map.sign, 1.0),
    ] {
        if number.to_bits() != f64::to_bits(default) {
            append(&mut text, key, Some(number));
        }
    }
    append(&mut text, "quantum", map.quantum);
    append(&mut text, "noise", map.noise);
    append(&mut text, "limit", map.limit);
    text + " }"
}

pub(super) fn value(number: &Value, dimension: Dimension) -> String {
    let unit = string(&dimension.to_string());
    let mut text = format!("{{ value = {:?}, unit = {unit}", number.value);
    if number.status != Status::Known {
        text += &format!(", status = {}", string(number.status.name()));
    }
    append(&mut text, "sd", number.sd);
    append(&mut text, "low95", number.low95);
    append(&mut text, "high95", number.high95);
    text + " }"
}

fn append(text: &mut String, key: &str, number: Option<f64>) {
    if let Some(number) = number {
        *text += &format!(", {key} = {number:?}");
    }
}

/// A basic string of TOML; control characters are escaped, so that it may be a key as well.
pub(super) fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            _ if character.is_control() => {
                // Writing to a string cannot fail.
                let _ = write!(quoted, "\\u{:04X}", u32::from(character));
            }
            _ => quoted.push(character),
        }
    }
    quoted + "\""
}
