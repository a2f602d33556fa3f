//! This file reads a rig description from TOML and refuses what it does not know.

mod channels;

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_spec::effect::{Mechanism, Motion, Quantity, Range};
use rigproof_spec::units::{Dimension, Unit};

use super::PLANTS;
use super::table::{Source, Table};
use super::{
    Brake, ChannelMap, Channels, Characteristic, Drive, Parameters, Plant, Protocol,
    RecordingEntry, Rig, RigEffect, Servo, Status, Value, dimension, motion_name, text,
};
use crate::csv::TimeColumn;
use crate::error::TraceError;
use crate::suggest::{advice, quoted};

impl Rig {
    /// Reads a rig description; `origin` is the file that messages name. Every value becomes SI.
    ///
    /// # Errors
    /// The text is no TOML, a key is unknown or missing, a unit is not known or measures something else, or a
    /// number is out of its range; the message gives line and column.
    pub fn parse(text: &str, origin: &Path) -> Result<Rig, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&[
            "name",
            "plant",
            "motion",
            "source",
            "channels",
            "text",
            "parameters",
            "brake",
            "characteristic",
            "servo",
            "recording",
            "effect",
            "protocol",
            "provenance",
        ])?;
        let name = root.need("name", root.text("name")?)?.to_string();
        let plant = plant(&root)?;
        let motion = choice(
            &root,
            "motion",
            [Motion::Linear, Motion::Rotary],
            motion_name,
        )?;
        let protocol = Protocol::read(&root)?;
        let table = root.need("channels", root.table("channels")?)?;
        let channels = match protocol.drive {
            Drive::Static => channels::of_sweep(&table, plant, motion)?,
            _ => channels::read(&table, plant, motion)?,
        };
        let servo = Servo::read(&root)?;
        if servo.is_some() {
            check_servo(&root, &channels, motion)?;
        }
        let is_sweep = protocol.drive == Drive::Static;
        let characteristic = read_characteristic(&root, (plant, motion), &channels, is_sweep)?;
        if is_sweep && root.has("brake") {
            let problem = "a static sweep is compared with a `[characteristic]`: give the settled torques there, in place of `[brake]`";
            return Err(root.error_at("brake", problem));
        }
        let driving = channels.driving(plant);
        Ok(Rig {
            name,
            plant,
            motion,
            source: root.text("source")?.map(str::to_string),
            parameters: read_parameters(&root, (plant, motion), &channels, servo.is_some())?,
            characteristic,
            brake: Brake::read(&root, motion, channels.current.as_ref())?,
            recordings: RecordingEntry::read_all(&root, servo.is_some())?,
            servo,
            effects: root
                .tables("effect")?
                .iter()
                .map(|table| match plant {
                    Plant::Bench => read_effect(table, (motion, driving), &["of"]),
                    Plant::Axis => read_effect(table, (motion, driving), &[]),
                })
                .collect::<Result<_, _>>()?,
            protocol,
            text: text::read(&root)?,
            provenance: read_provenance(&root)?,
            channels,
        })
    }
}

/// A plant of one joint. Other plants are read elsewhere, but somebody who looks for a word is told of all of them.
fn plant(root: &Table<'_>) -> Result<Plant, TraceError> {
    let word = choice(root, "plant", PLANTS, |word| word)?;
    let own = [Plant::Axis, Plant::Bench].into_iter();
    let mut own = own.filter(|plant| plant.name() == word);
    own.next().ok_or_else(|| {
        root.error_at(
            "plant",
            format!("`{word}` is no plant of one joint; give `axis` or `bench` here"),
        )
    })
}

/// The characteristic of a brake. A command of a bench acts through one, as does what a static sweep
/// is over, and a brake has one description.
fn read_characteristic(
    root: &Table<'_>,
    (plant, motion): (Plant, Motion),
    channels: &Channels,
    is_sweep: bool,
) -> Result<Option<Characteristic>, TraceError> {
    let is_bench = plant == Plant::Bench;
    let drive = channels.drive().filter(|_| is_bench);
    let driving = drive.map(ChannelMap::dimension);
    let effort = is_bench.then(|| Quantity::Effort.dimension(motion));
    let own = Characteristic::read(root, [driving, effort])?;
    if own.is_some() && root.has("brake") {
        let problem = "`[characteristic]` and `[brake]` describe the same brake; give one";
        return Err(root.error_at("characteristic", problem));
    }
    let of_command = match is_sweep {
        true => drive,
        false => channels.command.as_ref(),
    };
    match is_bench && of_command.is_some() {
        true => root.need("characteristic", own).map(Some),
        false => Ok(own),
    }
}

/// A servo's goal is a position of an axis.
fn check_servo(root: &Table<'_>, channels: &Channels, motion: Motion) -> Result<(), TraceError> {
    let travel = Quantity::Travel.dimension(motion);
    match &channels.command {
        Some(goal) if goal.dimension() == travel => Ok(()),
        Some(goal) => Err(root.error_at(
            "servo",
            format!(
                "the command of a servo is a goal; `{}` is in `{}`, give a channel in `{travel}`",
                goal.channel, goal.unit
            ),
        )),
        None => Err(root.error_at("servo", "a bench has no servo; take `[servo]` out")),
    }
}

/// One of a few words.
pub(super) fn choice<T: Copy, const N: usize>(
    table: &Table<'_>,
    key: &str,
    choices: [T; N],
    name: fn(T) -> &'static str,
) -> Result<T, TraceError> {
    let Some(word) = table.text(key)? else {
        let names = choices.map(|choice| format!("`{key} = \"{}\"`", name(choice)));
        let problem = format!(
            "`{key}` is missing in {}; add it: {}",
            table.title(),
            names.join(" or ")
        );
        return Err(table.error(problem));
    };
    let chosen = choices.into_iter().find(|choice| name(*choice) == word);
    chosen.ok_or_else(|| {
        let names = choices.map(name);
        table.error_at(
            key,
            format!("`{word}` is no {key}; {}", advice(word, "words", &names)),
        )
    })
}

pub(super) fn read_provenance(root: &Table<'_>) -> Result<BTreeMap<String, String>, TraceError> {
    let Some(table) = root.table("provenance")? else {
        return Ok(BTreeMap::new());
    };
    table
        .keys()
        .map(|key| {
            let words = table.need(key, table.text(key)?)?;
            Ok((key.to_string(), words.to_string()))
        })
        .collect()
}

pub(super) fn read_time(table: &Table<'_>) -> Result<Option<TimeColumn>, TraceError> {
    let Some(table) = table.table("time")? else {
        return Ok(None);
    };
    table.only(&["channel", "unit"])?;
    if table.has("unit") {
        read_unit(&table, Some(Dimension::TIME), false)?;
    }
    Ok(Some(TimeColumn {
        name: table.need("channel", table.text("channel")?)?.to_string(),
        unit: table.text("unit")?.unwrap_or_default().to_string(),
    }))
}

pub(super) fn read_channel(
    table: &Table<'_>,
    role: &str,
    expected: Option<Dimension>,
) -> Result<Option<ChannelMap>, TraceError> {
    let Some(table) = table.table(role)? else {
        return Ok(None);
    };
    table.only(&[
        "channel",
        "unit",
        "column_unit",
        "offset",
        "scale",
        "sign",
        "quantum",
        "noise",
        "limit",
    ])?;
    let unit = read_unit(&table, expected, false)?;
    let scale = table.number("scale")?.unwrap_or(1.0);
    if scale == 0.0 {
        return Err(table.error_at("scale", "`scale` is 0, which would erase the channel"));
    }
    let sign = table.number("sign")?.unwrap_or(1.0);
    if sign.abs() != 1.0 {
        return Err(table.error_at("sign", format!("`sign` is {sign}; it must be 1 or -1")));
    }
    Ok(Some(ChannelMap {
        channel: table.need("channel", table.text("channel")?)?.to_string(),
        unit: table.text("unit")?.unwrap_or_default().to_string(),
        column_unit: read_column_unit(&table, unit)?,
        offset: table.number("offset")?.unwrap_or(0.0),
        scale,
        sign,
        quantum: table.positive("quantum")?,
        noise: table.positive("noise")?,
        limit: table.positive("limit")?,
    }))
}

/// The unit of a column where its header is not to be believed; it converts to the unit of the map.
fn read_column_unit(table: &Table<'_>, unit: Unit) -> Result<Option<String>, TraceError> {
    let Some(text) = table.text("column_unit")? else {
        return Ok(None);
    };
    let same = Unit::parse(text).filter(|own| own.dimension == unit.dimension);
    match same {
        Some(_) => Ok(Some(text.to_string())),
        None => Err(table.error_at(
            "column_unit",
            format!(
                "`{text}` does not convert to `{}`; give the unit that the column is in, of the same kind as `unit`",
                table.text("unit")?.unwrap_or_default()
            ),
        )),
    }
}

fn read_parameters(
    root: &Table<'_>,
    (plant, motion): (Plant, Motion),
    channels: &Channels,
    is_servo: bool,
) -> Result<Option<Parameters>, TraceError> {
    let table = root.table("parameters")?;
    let command = channels.command.as_ref();
    let Some(command) = command.filter(|_| plant == Plant::Axis) else {
        return match table {
            Some(table) => table.only(&[]).map(|()| None),
            None => Ok(None),
        };
    };
    let table = root.need("parameters", table)?;
    table.only(&["inertia", "command_gain"])?;
    let mass = Quantity::Inertia.dimension(motion);
    let gain = Quantity::Effort.dimension(motion).per(match is_servo {
        true => Dimension::VOLTAGE,
        false => command.dimension(),
    });
    let inertia = table.need("inertia", read_value(&table, "inertia", mass)?)?;
    let command_gain = table.need("command_gain", read_value(&table, "command_gain", gain)?)?;
    above_zero(&table, "inertia", &inertia, mass)?;
    if command_gain.value == 0.0 {
        return Err(table.error_at("command_gain", "the command gain is 0, so no command acts"));
    }
    Ok(Some(Parameters {
        inertia,
        command_gain,
    }))
}

/// A mechanism with its parameters, on a plant that slides or turns and whose brakes are driven by something;
/// `other_keys` are read by somebody else.
pub(super) fn read_effect(
    table: &Table<'_>,
    (motion, driving): (Motion, Dimension),
    other_keys: &[&str],
) -> Result<RigEffect, TraceError> {
    let word = table.need("mechanism", table.text("mechanism")?)?;
    let mechanism = Mechanism::from_name(word)
        .filter(|mechanism| !mechanism.parameters().is_empty())
        .ok_or_else(|| {
            let computed = Mechanism::ALL.iter().filter(|m| !m.parameters().is_empty());
            let names: Vec<&str> = computed.map(|mechanism| mechanism.name()).collect();
            let advice = other_word(word, &names)
                .unwrap_or_else(|| advice(word, "mechanisms that a model computes", &names));
            table.error_at("mechanism", format!("`{word}` cannot be used; {advice}"))
        })?;
    let parameters = mechanism.parameters();
    let mut known = vec!["mechanism", "onset"];
    known.extend(other_keys);
    known.extend(parameters.iter().map(|parameter| parameter.name));
    table.only(&known)?;
    let of_torque = table.has("of");
    if of_torque {
        choice(table, "of", ["torque"], |name| name)?;
    }
    let mut values = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let dimension = dimension(parameter, motion, of_torque, driving);
        let value = read_value(table, parameter.name, dimension)?;
        if parameter.is_optional && value.is_none() {
            break;
        }
        let value = table.need(parameter.name, value)?;
        match parameter.range {
            Range::AboveZero => above_zero(table, parameter.name, &value, dimension)?,
            Range::NotBelowZero if value.value < 0.0 => {
                let message = format!("`{}` is below 0: it is 0 or more", parameter.name);
                return Err(table.error_at(parameter.name, message));
            }
            Range::Part if !(0.0..=1.0).contains(&value.value) => {
                let message = format!("`{}` is from 0 to 1", parameter.name);
                return Err(table.error_at(parameter.name, message));
            }
            Range::NotBelowZero | Range::Part | Range::Any | Range::Sign => {}
        }
        values.push(value);
    }
    Ok(RigEffect {
        mechanism,
        values,
        of_torque,
        onset: read_value(table, "onset", Dimension::TIME)?,
    })
}

/// The most mechanisms that a word such as `friction` suggests.
const MOST_SUGGESTED: usize = 4;

/// What a word that is no name means here, or which of these names it may mean.
fn other_word(word: &str, names: &[&str]) -> Option<String> {
    let is_known = |own: &Mechanism| names.contains(&own.name());
    if let Some(own) = Mechanism::meant_by(word).filter(is_known) {
        return Some(format!("here it is called `{}`", own.name()));
    }
    let suggested = Mechanism::suggested_by(word).filter(is_known);
    let said = suggested.map(|own| format!("`{}` ({})", own.name(), own.called()));
    let said: Vec<String> = said.take(MOST_SUGGESTED).collect();
    match said.is_empty() {
        true => None,
        false => Some(format!("did you mean {}?", said.join(", or "))),
    }
}

/// A value with its unit, in SI.
pub(super) fn read_value(
    table: &Table<'_>,
    key: &str,
    dimension: Dimension,
) -> Result<Option<Value>, TraceError> {
    let Some(table) = table.table(key)? else {
        return Ok(None);
    };
    table.only(&["value", "unit", "status", "sd", "low95", "high95"])?;
    let to_si = read_unit(&table, Some(dimension), true)?.to_si;
    let in_si = |number: Option<f64>| number.map(|number| number * to_si);
    let status = match table.has("status") {
        true => choice(
            &table,
            "status",
            [Status::Known, Status::Uncertain, Status::Unknown],
            Status::name,
        )?,
        false => Status::Known,
    };
    let value = Value {
        value: table.need("value", table.number("value")?)? * to_si,
        status,
        sd: in_si(table.positive("sd")?),
        low95: in_si(table.number("low95")?),
        high95: in_si(table.number("high95")?),
    };
    if value.sd.is_some() != (status == Status::Uncertain) {
        return Err(table.error(format!(
            "the status is {}; a standard deviation `sd` goes with the status `uncertain`, and only with it",
            status.name()
        )));
    }
    match (value.low95, value.high95) {
        (Some(low), Some(high)) if low <= high => Ok(Some(value)),
        (None, None) => Ok(Some(value)),
        _ => Err(table.error("the 95 % interval needs `low95` and `high95`, the lower one first")),
    }
}

/// The unit of a table, checked against what it is to measure. A unit with mass in it may leave out the radian,
/// as the field does (`N·m·s`, `kg·m^2`).
fn read_unit(
    table: &Table<'_>,
    expected: Option<Dimension>,
    may_leave_out_radian: bool,
) -> Result<Unit, TraceError> {
    let text = table.need("unit", table.text("unit")?)?;
    let Some(unit) = Unit::parse(text) else {
        let wanted = expected.map_or("a unit such as `V`".to_string(), |d| format!("`{d}`"));
        return Err(table.error_at("unit", format!("`{text}` is no known unit; give {wanted}")));
    };
    let without_radian = |Dimension([m, kg, s, a, _]): Dimension| [m, kg, s, a];
    let Dimension([_, mass, _, _, radian]) = unit.dimension;
    let fits = expected.is_none_or(|expected| {
        unit.dimension == expected
            || may_leave_out_radian
                && mass != 0
                && radian == 0
                && without_radian(unit.dimension) == without_radian(expected)
    });
    match expected {
        Some(expected) if !fits => Err(table.error_at(
            "unit",
            format!("`{text}` does not convert to `{expected}`; give a unit of that kind"),
        )),
        _ => Ok(unit),
    }
}

pub(super) fn above_zero(
    table: &Table<'_>,
    key: &str,
    value: &Value,
    dimension: Dimension,
) -> Result<(), TraceError> {
    if value.value > 0.0 {
        return Ok(());
    }
    Err(table.error_at(
        key,
        format!(
            "{} is {} {dimension}; it must be above 0",
            quoted([key]),
            value.value
        ),
    ))
}

#[cfg(test)]
mod tests;
