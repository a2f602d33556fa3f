//! This file is the description of a serial arm: the URDF or MJCF that it is modelled by, and what the channels of its recordings mean, joint by joint.

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_spec::effect::Motion;
use rigproof_spec::units::Dimension;

use super::apply::{Signal, read_applied, those};
use super::read::{choice, read_channel, read_effect, read_provenance, read_time};
use super::signals::Recorded;
use super::table::{Source, Table};
use super::transmission::{KEYS, Transmission, part};
use super::write::{channel, effect_lines, provenance_lines, string, time_line};
use super::{ChannelMap, RigEffect, SCHEMA_LINE, state_units, text};
use crate::csv::{Dialect, Hints, Known, TimeColumn};
use crate::error::TraceError;
use crate::series::Trace;
use crate::store;

/// The format of the model of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFormat {
    /// URDF.
    Urdf,
    /// MJCF, MuJoCo's own.
    Mjcf,
}

impl ModelFormat {
    /// The key of the file in a description.
    pub const fn key(self) -> &'static str {
        match self {
            ModelFormat::Urdf => "urdf",
            ModelFormat::Mjcf => "mjcf",
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            ModelFormat::Urdf => "URDF",
            ModelFormat::Mjcf => "MJCF",
        }
    }
}

/// A serial arm, and how its recordings are to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainRig {
    /// What people call it.
    pub name: String,
    /// The format of its model.
    pub format: ModelFormat,
    /// The file of its model; words for the description itself where the model stands in it.
    pub file: String,
    /// Whether the model stands in the description itself.
    pub is_inside: bool,
    /// The text of that file.
    pub model: String,
    /// The link, or the body or site of MJCF, beyond which nothing is attached; without one the only end.
    pub tip: Option<String>,
    /// Where its recordings come from, in free words.
    pub source: Option<String>,
    /// The time, where the header of a recording does not say it.
    pub time: Option<TimeColumn>,
    /// Its joints, in the order of the file.
    pub joints: Vec<ChainJoint>,
    /// How its recordings are written down, where that cannot be seen in them.
    pub text: Hints,
    /// The physics that the nominal model has beyond the model's.
    pub effects: Vec<AtJoint>,
    /// Where a calibration came from: words of the program that wrote it, by topic.
    pub provenance: BTreeMap<String, String>,
}

/// What is recorded of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainJoint {
    /// Its name in the model.
    pub name: String,
    /// Whether it slides or turns.
    pub motion: Motion,
    /// Its position.
    pub position: ChannelMap,
    /// The effort of its motor, N·m or N.
    pub effort: ChannelMap,
    /// What is recorded and known between its motor and its link.
    pub transmission: Transmission,
}

/// A mechanism at a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct AtJoint {
    /// The name of the joint or of a part of it; of a link that of the joint that moves it.
    pub joint: String,
    /// The mechanism with its numbers.
    pub effect: RigEffect,
}

/// A recording of a serial arm in SI units, a signal a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainRecording {
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// Positions, rad or m.
    pub position: Vec<Signal>,
    /// Efforts, N·m or N.
    pub effort: Vec<Signal>,
    /// Positions of motors, where they are recorded.
    pub motor: Vec<Option<Signal>>,
    /// Efforts that pass transmissions, where sensors show them.
    pub torque: Vec<Option<Signal>>,
}

impl ChainRecording {
    /// The recording at the samples that are kept.
    pub fn only(&self, kept: &[bool]) -> ChainRecording {
        let each = |signals: &[Signal]| signals.iter().map(|s| s.only(kept)).collect();
        let some = |signals: &[Option<Signal>]| {
            let each = signals.iter();
            each.map(|s| s.as_ref().map(|s| s.only(kept))).collect()
        };
        ChainRecording {
            time_s: those(&self.time_s, kept),
            position: each(&self.position),
            effort: each(&self.effort),
            motor: some(&self.motor),
            torque: some(&self.torque),
        }
    }
}

const fn motion_word(motion: Motion) -> &'static str {
    match motion {
        Motion::Rotary => "rotary",
        Motion::Linear => "linear",
    }
}

impl ChainRig {
    /// Whether a description is one of a serial arm, `plant = "chain"`.
    ///
    /// # Errors
    /// The text is no TOML, or its plant is no text.
    pub fn describes(text: &str, origin: &Path) -> Result<bool, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        Ok(Table::root(source, &document).text("plant")? == Some("chain"))
    }

    /// Reads a description and its model, which lies where `urdf` or `mjcf` says from the folder of `origin`, or is the text that stands there. Every value
    /// becomes SI.
    ///
    /// # Errors
    /// The text is no such description, or the model cannot be read.
    pub fn parse(text: &str, origin: &Path) -> Result<ChainRig, TraceError> {
        let source = Source { text, file: origin };
        let document = source.document()?;
        let root = Table::root(source, &document);
        root.only(&[
            "name",
            "plant",
            "urdf",
            "mjcf",
            "tip",
            "source",
            "channels",
            "joint",
            "text",
            "effect",
            "provenance",
        ])?;
        choice(&root, "plant", ["chain"], |name| name)?;
        let (format, written) = match (root.text("urdf")?, root.text("mjcf")?) {
            (Some(urdf), None) => (ModelFormat::Urdf, urdf),
            (None, Some(mjcf)) => (ModelFormat::Mjcf, mjcf),
            (None, None) => {
                let said = "no `urdf` and no `mjcf`: name the file of the arm's model";
                return Err(root.error(said));
            }
            (Some(_), Some(_)) => {
                let said = "both `urdf` and `mjcf`: an arm has one model, keep one";
                return Err(root.error_at("mjcf", said));
            }
        };
        let (file, model) = read_model(written, origin)?;
        let joints = root.tables("joint")?;
        let joints: Vec<ChainJoint> = joints.iter().map(read_joint).collect::<Result<_, _>>()?;
        if joints.is_empty() {
            return Err(root.error("no `[[joint]]`: name each joint with its position and effort"));
        }
        let effects = root.tables("effect")?;
        let effects = effects.iter().map(|table| {
            let joint = table.need("joint", table.text("joint")?)?;
            let (own, _) = part(joint, &joints).ok_or_else(|| {
                table.error_at("joint", format!("`{joint}` is no joint of this arm"))
            })?;
            Ok(AtJoint {
                joint: joint.to_owned(),
                effect: read_effect(table, (own.motion, Dimension::CURRENT), &["joint"])?,
            })
        });
        let channels = root.table("channels")?;
        Ok(ChainRig {
            name: root.need("name", root.text("name")?)?.to_owned(),
            format,
            is_inside: file.is_none(),
            file: file.unwrap_or_else(|| format!("the {}", format.name())),
            model,
            tip: root.text("tip")?.map(str::to_owned),
            source: root.text("source")?.map(str::to_owned),
            time: match &channels {
                Some(table) => table.only(&["time"]).and_then(|()| read_time(table))?,
                None => None,
            },
            effects: effects.collect::<Result<_, TraceError>>()?,
            joints,
            text: text::read(&root)?,
            provenance: read_provenance(&root)?,
        })
    }

    /// The joint of this name.
    pub fn joint(&self, name: &str) -> Option<&ChainJoint> {
        self.joints.iter().find(|joint| joint.name == name)
    }

    /// Whether the joint to which a place belongs slides or turns; of an unknown place that it turns.
    pub fn motion_at(&self, place: &str) -> Motion {
        part(place, &self.joints).map_or(Motion::Rotary, |(joint, _)| joint.motion)
    }

    /// Every channel that is named.
    pub fn maps(&self) -> Vec<&ChannelMap> {
        let each = self.joints.iter();
        each.flat_map(|joint| {
            let own = [&joint.position, &joint.effort].into_iter();
            own.chain(joint.transmission.maps())
        })
        .collect()
    }

    /// Reads a text recording whose dialect is partly known, and says in which it was, and what was guessed, passed over or mended.
    ///
    /// # Errors
    /// As [`crate::csv::read_text`](crate::csv::read) and [`ChainRig::apply`].
    pub fn read_text(
        &self,
        path: &Path,
        hints: &Hints,
    ) -> Result<(ChainRecording, Dialect, Vec<String>), TraceError> {
        let known = Known {
            time: self.time.as_ref(),
            hints: hints.or(self.text),
            ..Known::default()
        };
        read_applied(path, known, &self.maps(), |t| self.taken(t, path))
    }

    /// The description with the units that some columns are said to be in, whatever their headers say.
    ///
    /// # Errors
    /// Names a channel that the rig does not have, and those it has.
    pub fn with_column_units(&self, units: &[(String, String)]) -> Result<ChainRig, String> {
        let mut rig = self.clone();
        let joints = rig.joints.iter_mut();
        let maps = joints.flat_map(|joint| {
            let own = [&mut joint.position, &mut joint.effort].into_iter();
            own.chain(joint.transmission.maps_mut())
        });
        state_units(maps, &self.name, units)?;
        Ok(rig)
    }

    /// Turns a recording into SI quantities; `origin` is the file that messages name.
    ///
    /// # Errors
    /// A channel of the rig is missing, or its unit in the header does not convert to the rig's.
    pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<ChainRecording, TraceError> {
        self.taken(trace.clone(), origin)
    }

    /// The same of a recording that nobody needs afterwards: its numbers are turned where they stand.
    ///
    /// # Errors
    /// As [`ChainRig::apply`].
    pub fn taken(&self, trace: Trace, origin: &Path) -> Result<ChainRecording, TraceError> {
        let (time_s, mut recorded) = Recorded::of(trace, &self.maps(), &self.name, origin);
        let joints = || self.joints.iter();
        Ok(ChainRecording {
            time_s,
            position: joints()
                .map(|j| recorded.signal(&j.position))
                .collect::<Result<_, _>>()?,
            effort: joints()
                .map(|j| recorded.signal(&j.effort))
                .collect::<Result<_, _>>()?,
            motor: joints()
                .map(|j| j.transmission.motor.as_ref())
                .map(|map| map.map(|map| recorded.signal(map)).transpose())
                .collect::<Result<_, _>>()?,
            torque: joints()
                .map(|j| j.transmission.torque.as_ref())
                .map(|map| map.map(|map| recorded.signal(map)).transpose())
                .collect::<Result<_, _>>()?,
        })
    }

    /// The description as TOML, every value in SI units.
    pub fn to_toml(&self) -> String {
        let mut lines = vec![
            SCHEMA_LINE.to_owned(),
            format!("name = {}", string(&self.name)),
            "plant = \"chain\"".to_owned(),
            match self.is_inside {
                true => format!("{} = '''\n{}'''", self.format.key(), self.model),
                false => format!("{} = {}", self.format.key(), string(&self.file)),
            },
        ];
        let tip = self.tip.iter();
        lines.extend(tip.map(|tip| format!("tip = {}", string(tip))));
        let source = self.source.iter();
        lines.extend(source.map(|text| format!("source = {}", string(text))));
        if let Some(time) = &self.time {
            lines.extend(["\n[channels]".to_owned(), time_line(time)]);
        }
        lines.extend(text::lines(&self.text));
        for joint in &self.joints {
            lines.push("\n[[joint]]".to_owned());
            lines.push(format!("name = {}", string(&joint.name)));
            lines.push(format!("motion = {}", string(motion_word(joint.motion))));
            lines.push(format!("position = {}", channel(&joint.position)));
            lines.push(format!("effort = {}", channel(&joint.effort)));
            lines.extend(joint.transmission.lines(joint.motion));
        }
        for own in &self.effects {
            let motion = self.motion_at(&own.joint);
            let mut effect = effect_lines(&own.effect, (motion, Dimension::CURRENT)).into_iter();
            lines.extend(effect.by_ref().take(2));
            lines.push(format!("joint = {}", string(&own.joint)));
            lines.extend(effect);
        }
        lines.extend(provenance_lines(&self.provenance));
        lines.join("\n") + "\n"
    }
}

/// The file of a model, unless its text stands in the description, and the text.
fn read_model(written: &str, origin: &Path) -> Result<(Option<String>, String), TraceError> {
    if written.trim_start().starts_with('<') {
        return Ok((None, written.to_owned()));
    }
    let file = origin.parent().unwrap_or(Path::new("")).join(written);
    let file = std::path::absolute(&file).unwrap_or(file);
    let text = store::read_text(&file)?;
    Ok((Some(file.display().to_string()), text))
}

fn read_joint(table: &Table<'_>) -> Result<ChainJoint, TraceError> {
    let own = ["name", "motion", "position", "effort"];
    table.only(&own.into_iter().chain(KEYS).collect::<Vec<_>>())?;
    let motion = match table.has("motion") {
        true => choice(
            table,
            "motion",
            [Motion::Rotary, Motion::Linear],
            motion_word,
        )?,
        false => Motion::Rotary,
    };
    let (travel, effort) = match motion {
        Motion::Rotary => (Dimension::ANGLE, Dimension::TORQUE),
        Motion::Linear => (Dimension::LENGTH, Dimension::FORCE),
    };
    let need = |role: &str, own| table.need(role, read_channel(table, role, Some(own))?);
    Ok(ChainJoint {
        name: table.need("name", table.text("name")?)?.to_owned(),
        motion,
        position: need("position", travel)?,
        effort: need("effort", effort)?,
        transmission: Transmission::read(table, motion)?,
    })
}
