//! This file reads which channels of a recording are which signals of a plant of one joint.

use super::{read_channel, read_time};
use crate::error::TraceError;
use crate::rig::table::Table;
use crate::rig::{Channels, Plant};
use rigproof_spec::effect::{Motion, Quantity};
use rigproof_spec::units::Dimension;

/// The channels of a plant that is recorded over time.
pub(super) fn read(
    table: &Table<'_>,
    plant: Plant,
    motion: Motion,
) -> Result<Channels, TraceError> {
    table.only(match plant {
        Plant::Axis => &["time", "position", "command", "enabled"],
        Plant::Bench => &[
            "time",
            "position",
            "force",
            "torque",
            "command",
            "current",
            "simulated",
        ],
    })?;
    let travel = Quantity::Travel.dimension(motion);
    let position = read_channel(table, "position", Some(travel))?;
    let position = table.need("position", position)?;
    let channels = Channels {
        position: Some(position),
        ..read_roles(table, motion)?
    };
    match plant {
        Plant::Axis => table.need("command", channels.command.as_ref()).map(drop)?,
        Plant::Bench => need_effort(table, &channels)?,
    }
    Ok(channels)
}

/// The channels of a static sweep: an effort over a command, over a speed, or over both.
pub(super) fn of_sweep(
    table: &Table<'_>,
    plant: Plant,
    motion: Motion,
) -> Result<Channels, TraceError> {
    if plant == Plant::Axis {
        let problem = "an axis has no static sweep; it is `plant = \"bench\"` if its torque or force was metered, row by row";
        return Err(table.error(problem));
    }
    table.only(&["speed", "force", "torque", "command", "current"])?;
    let rate = Quantity::Speed.dimension(motion);
    let channels = Channels {
        speed: read_channel(table, "speed", Some(rate))?,
        ..read_roles(table, motion)?
    };
    need_effort(table, &channels)?;
    if channels.speed.is_none() && channels.drive().is_none() {
        let problem = "a static sweep is over something: add `command`, `current` or `speed`";
        return Err(table.error(problem));
    }
    Ok(channels)
}

/// The channels that are neither time nor motion.
fn read_roles(table: &Table<'_>, motion: Motion) -> Result<Channels, TraceError> {
    let effort = Quantity::Effort.dimension(motion);
    if table.has("torque") && table.has("force") {
        return Err(table.error_at("torque", "`force` and `torque` are the same role; give one"));
    }
    if table.has("command") && table.has("current") {
        let problem =
            "`command` and `current` are the same role; give what the characteristic is over";
        return Err(table.error_at("command", problem));
    }
    Ok(Channels {
        time: read_time(table)?,
        position: None,
        speed: None,
        command: read_channel(table, "command", None)?,
        enabled: read_channel(table, "enabled", Some(Dimension::NUMBER))?,
        force: read_channel(table, effort_key(table), Some(effort))?,
        current: read_channel(table, "current", Some(Dimension::CURRENT))?,
        simulated: read_channel(table, "simulated", Some(effort))?,
    })
}

/// The word for a force or torque.
fn effort_key(table: &Table<'_>) -> &'static str {
    match table.has("torque") {
        true => "torque",
        false => "force",
    }
}

/// A bench meters its effort.
fn need_effort(table: &Table<'_>, channels: &Channels) -> Result<(), TraceError> {
    table
        .need(effort_key(table), channels.force.as_ref())
        .map(drop)
}
