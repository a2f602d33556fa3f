//! This file is the description of a five-bar rig: its layout, what the channels of its recordings mean, and the physics
//! its nominal model has at each joint.

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_spec::effect::Motion;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::Dimension;

use super::apply::{Signal, read_applied, those};
use super::read::{choice, read_channel, read_effect, read_provenance, read_time};
use super::signals::{Recorded, printed};
use super::table::{Source, Table};
use super::write::{channel, effect_lines, string, time_line};
use super::{ChannelMap, Protocol, RigEffect, SCHEMA_LINE, state_units, text};
use crate::csv::{Dialect, Hints, Known, TimeColumn};
use crate::error::TraceError;
use crate::series::Trace;
use crate::store;

/// A five-bar rig with the thesis's lengths, masses and brakes of a layout, and how its recordings are to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct FiveBar {
    /// What people call it.
    pub name: String,
    /// Which joints carry a brake.
    pub layout: Layout,
    /// Where its recordings come from, in free words.
    pub source: Option<String>,
    /// What the channels of its recordings mean.
    pub channels: FiveBarChannels,
    /// How its recordings are written down, where that cannot be seen in them.
    pub text: Hints,
    /// The physics that the nominal model has beyond the thesis's.
    pub effects: Vec<JointEffect>,
    /// How free runs are made.
    pub protocol: Protocol,
    /// Where a calibration came from: words of the program that wrote it, by topic.
    pub provenance: BTreeMap<String, String>,
}

/// The channels of a five-bar's recordings.
#[derive(Clone, Debug, PartialEq)]
pub struct FiveBarChannels {
    /// The time, where the header of a recording does not say it.
    pub time: Option<TimeColumn>,
    /// θA and θB, rad.
    pub theta: [ChannelMap; 2],
    /// Force of the hand on the tip, x and y, N.
    pub force: [ChannelMap; 2],
    /// Commanded currents in the order A, E, B, C, A; one for each braked joint.
    pub currents: [Option<ChannelMap>; 4],
}

/// A mechanism at a joint, or of the whole rig.
#[derive(Clone, Debug, PartialEq)]
pub struct JointEffect {
    /// Where it acts; `None` where it has no joint.
    pub joint: Option<Joint>,
    /// The axis of the force sensor that it is of alone, 0 for x, 1 for y.
    pub axis: Option<usize>,
    /// The mechanism with its parameters.
    pub effect: RigEffect,
}

/// A recording of a five-bar, in SI units; every signal is as long as `time_s`, NaN where a sample is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct FiveBarRecording {
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// θA and θB, rad.
    pub theta: [Signal; 2],
    /// Force of the hand on the tip, x and y, N.
    pub force: [Signal; 2],
    /// Commanded currents in the order A, E, B, C, A.
    pub currents: [Option<Signal>; 4],
}

impl FiveBarRecording {
    /// The recording at the samples that are kept.
    pub fn only(&self, kept: &[bool]) -> FiveBarRecording {
        let pair = |pair: &[Signal; 2]| pair.each_ref().map(|s| s.only(kept));
        let currents = self.currents.each_ref();
        FiveBarRecording {
            time_s: those(&self.time_s, kept),
            theta: pair(&self.theta),
            force: pair(&self.force),
            currents: currents.map(|current| current.as_ref().map(|s| s.only(kept))),
        }
    }
}

const THETA: [&str; 2] = ["theta_a", "theta_b"];
const FORCE: [&str; 2] = ["force_x", "force_y"];
/// Its joints turn, and currents drive its brakes.
const ON_THE_RIG: (Motion, Dimension) = (Motion::Rotary, Dimension::CURRENT);
const CURRENT: [&str; 4] = ["current_a", "current_e", "current_b", "current_c"];

/// The name of a layout in files.
pub const fn layout_name(layout: Layout) -> &'static str {
    match layout {
        Layout::ThreeBrake => "three_brake",
        Layout::FourBrake => "four_brake",
    }
}

/// The name of an axis of the force sensor in files.
const fn axis_name(axis: usize) -> &'static str {
    match axis {
        0 => "x",
        _ => "y",
    }
}

impl FiveBar {
    /// Whether a description is one of a five-bar, `plant = "rig"`.
    ///
    /// # Errors
    /// The text is no TOML, or its plant is no text.
    pub fn describes(text: &str, origin: &Path) -> Result<bool, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        Ok(Table::root(source, &document).text("plant")? == Some("rig"))
    }

    /// Reads a description from a TOML file.
    ///
    /// # Errors
    /// The file cannot be read, or as [`FiveBar::parse`].
    pub fn read(path: &Path) -> Result<FiveBar, TraceError> {
        FiveBar::parse(&store::read_text(path)?, path)
    }

    /// Reads a description; `origin` is the file that messages name. Every value becomes SI.
    ///
    /// # Errors
    /// The text is no TOML, a key is unknown or missing, a unit is not known or measures something else, or a number is out
    /// of its range; the message gives line and column.
    pub fn parse(text: &str, origin: &Path) -> Result<FiveBar, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&[
            "name",
            "plant",
            "layout",
            "source",
            "channels",
            "text",
            "effect",
            "protocol",
            "provenance",
        ])?;
        choice(&root, "plant", ["rig"], |name| name)?;
        let layouts = [Layout::ThreeBrake, Layout::FourBrake];
        let layout = choice(&root, "layout", layouts, layout_name)?;
        let effects = root.tables("effect")?;
        let effects = effects.iter().map(|table| {
            let joint = match table.has("joint") {
                true => Some(choice(table, "joint", Joint::ALL, Joint::letter)?),
                false => None,
            };
            let axis = match table.has("axis") {
                true => Some(choice(table, "axis", [0, 1], axis_name)?),
                false => None,
            };
            let effect = read_effect(table, ON_THE_RIG, &["joint", "axis", "of"])?;
            Ok(JointEffect {
                joint,
                axis,
                effect,
            })
        });
        Ok(FiveBar {
            name: root.need("name", root.text("name")?)?.to_string(),
            layout,
            source: root.text("source")?.map(str::to_string),
            channels: read_channels(&root.need("channels", root.table("channels")?)?, layout)?,
            text: text::read(&root)?,
            effects: effects.collect::<Result<_, TraceError>>()?,
            protocol: Protocol::read(&root)?,
            provenance: read_provenance(&root)?,
        })
    }

    /// Reads a text recording of this rig.
    ///
    /// # Errors
    /// As [`crate::csv::read_text`] and [`FiveBar::apply`].
    pub fn read_recording(&self, path: &Path) -> Result<FiveBarRecording, TraceError> {
        let (recording, ..) = self.read_text(path, &Hints::default())?;
        Ok(recording)
    }

    /// Reads a text recording of this rig whose dialect is partly known, and says in which it was, and what was guessed,
    /// passed over or mended. Columns that the rig does not name are not looked at.
    ///
    /// # Errors
    /// As [`crate::csv::read_text`](crate::csv::read) and [`FiveBar::apply`].
    pub fn read_text(
        &self,
        path: &Path,
        hints: &Hints,
    ) -> Result<(FiveBarRecording, Dialect, Vec<String>), TraceError> {
        let known = Known {
            time: self.channels.time.as_ref(),
            hints: hints.or(self.text),
            ..Known::default()
        };
        read_applied(path, known, &self.maps(), |t| self.taken(t, path))
    }

    /// Every channel that is named.
    fn maps(&self) -> Vec<&ChannelMap> {
        let channels = &self.channels;
        let measured = channels.theta.iter().chain(&channels.force);
        measured.chain(channels.currents.iter().flatten()).collect()
    }

    /// The description with the units that some columns are said to be in, whatever their headers say.
    ///
    /// # Errors
    /// Names a channel that the rig does not have, and those it has.
    pub fn with_column_units(&self, units: &[(String, String)]) -> Result<FiveBar, String> {
        let mut rig = self.clone();
        let channels = &mut rig.channels;
        let measured = channels.theta.iter_mut().chain(&mut channels.force);
        let maps = measured.chain(channels.currents.iter_mut().flatten());
        state_units(maps, &self.name, units)?;
        Ok(rig)
    }

    /// Turns a recording into SI quantities; `origin` is the file that messages name.
    ///
    /// # Errors
    /// A channel of the rig is missing, or its unit in the header does not convert to the rig's.
    pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<FiveBarRecording, TraceError> {
        self.taken(trace.clone(), origin)
    }

    /// The same of a recording that nobody needs afterwards: its numbers are turned where they stand.
    ///
    /// # Errors
    /// As [`FiveBar::apply`].
    pub fn taken(&self, trace: Trace, origin: &Path) -> Result<FiveBarRecording, TraceError> {
        let FiveBarChannels {
            theta,
            force,
            currents: [a, e, b, c],
            ..
        } = &self.channels;
        let (time_s, mut recorded) = Recorded::of(trace, &self.maps(), &self.name, origin);
        let mut pair = |[first, second]: &[ChannelMap; 2]| {
            Ok::<_, TraceError>([recorded.signal(first)?, recorded.signal(second)?])
        };
        let (theta, force) = (pair(theta)?, pair(force)?);
        let mut current =
            |map: &Option<ChannelMap>| map.as_ref().map(|own| recorded.signal(own)).transpose();
        Ok(FiveBarRecording {
            time_s,
            theta,
            force,
            currents: [current(a)?, current(e)?, current(b)?, current(c)?],
        })
    }

    /// A recording as its file has it: channels, units, scales and offsets as this description says. `origin` is the file that
    /// messages name.
    ///
    /// # Errors
    /// A unit of the description is not known.
    pub fn trace(&self, recording: &FiveBarRecording, origin: &Path) -> Result<Trace, TraceError> {
        let FiveBarChannels {
            theta,
            force,
            currents,
            ..
        } = &self.channels;
        let pairs = theta.iter().zip(&recording.theta);
        let pairs = pairs.chain(force.iter().zip(&recording.force));
        let currents = currents.iter().zip(&recording.currents);
        let pairs =
            pairs.chain(currents.filter_map(|(map, own)| Some((map.as_ref()?, own.as_ref()?))));
        let channels = pairs.map(|(map, own)| printed(map, &own.samples, origin));
        Ok(Trace {
            time_s: recording.time_s.clone(),
            channels: channels.collect::<Result<_, TraceError>>()?,
        })
    }

    /// The description as TOML, every value in SI units; reads back bit for bit.
    pub fn to_toml(&self) -> String {
        let mut lines = vec![
            SCHEMA_LINE.to_owned(),
            format!("name = {}", string(&self.name)),
            "plant = \"rig\"".to_owned(),
            format!("layout = {}", string(layout_name(self.layout))),
        ];
        let source = self.source.iter();
        lines.extend(source.map(|text| format!("source = {}", string(text))));
        lines.push("\n[channels]".to_owned());
        lines.extend(self.channels.time.as_ref().map(time_line));
        let pairs = THETA.iter().zip(&self.channels.theta);
        let pairs = pairs.chain(FORCE.iter().zip(&self.channels.force));
        lines.extend(pairs.map(|(role, map)| format!("{role} = {}", channel(map))));
        for (role, map) in CURRENT.iter().zip(&self.channels.currents) {
            lines.extend(map.iter().map(|map| format!("{role} = {}", channel(map))));
        }
        lines.extend(text::lines(&self.text));
        for own in &self.effects {
            let JointEffect { joint, axis, .. } = own;
            let mut effect = effect_lines(&own.effect, ON_THE_RIG).into_iter();
            lines.extend(effect.by_ref().take(2));
            lines.extend(joint.map(|joint| format!("joint = {}", string(joint.letter()))));
            lines.extend(axis.map(|axis| format!("axis = {}", string(axis_name(axis)))));
            lines.extend(effect);
        }
        lines.extend(self.protocol.lines());
        lines.extend(super::write::provenance_lines(&self.provenance));
        lines.join("\n") + "\n"
    }

    /// Writes the description as a TOML file, whole or not at all.
    ///
    /// # Errors
    /// The system refuses.
    pub fn write(&self, path: &Path) -> Result<(), TraceError> {
        store::write_aside(path, self.to_toml().as_bytes())
    }
}

fn read_channels(table: &Table<'_>, layout: Layout) -> Result<FiveBarChannels, TraceError> {
    let braked = |joint: &Joint| layout.brakes().contains(joint);
    let current_roles = CURRENT.iter().zip(Joint::ALL);
    let mut known = vec!["time"];
    known.extend(THETA.iter().chain(&FORCE));
    known.extend(
        current_roles
            .filter(|(_, joint)| braked(joint))
            .map(|(role, _)| role),
    );
    table.only(&known)?;
    let need =
        |role: &str, dimension| table.need(role, read_channel(table, role, Some(dimension))?);
    let current = |role: &str, joint: Joint| match braked(&joint) {
        true => need(role, Dimension::CURRENT).map(Some),
        false => Ok(None),
    };
    let [theta_a, theta_b] = THETA;
    let [force_x, force_y] = FORCE;
    let [a, e, b, c] = CURRENT;
    Ok(FiveBarChannels {
        time: read_time(table)?,
        theta: [
            need(theta_a, Dimension::ANGLE)?,
            need(theta_b, Dimension::ANGLE)?,
        ],
        force: [
            need(force_x, Dimension::FORCE)?,
            need(force_y, Dimension::FORCE)?,
        ],
        currents: [
            current(a, Joint::A)?,
            current(e, Joint::E)?,
            current(b, Joint::B)?,
            current(c, Joint::C)?,
        ],
    })
}

#[cfg(test)]
mod tests;
