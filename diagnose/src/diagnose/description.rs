//! This file is what is diagnosed, whichever plant it is: a rig's description and a recording of it.

use super::{Diagnosis, Options, diagnose};
use crate::plants::five_bar;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};
use rigproof_trace::rig::{Recording, Rig};
use rigproof_trace::{Trace, TraceError, store};
use std::path::Path;

/// What a rig file describes.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "few are ever made")]
pub enum Description {
    /// A plant of one joint.
    Joint(Rig),
    /// The five-bar.
    FiveBar(FiveBar),
}

impl Description {
    /// The plant's name in reports.
    pub const fn plant_name(&self) -> &'static str {
        match self {
            Description::Joint(rig) => rig.plant.name(),
            Description::FiveBar(_) => "rig",
        }
    }

    /// What people call the rig.
    pub fn name(&self) -> &str {
        match self {
            Description::Joint(rig) => &rig.name,
            Description::FiveBar(rig) => &rig.name,
        }
    }

    /// Reads a description of either kind; `origin` is the file that messages name.
    ///
    /// # Errors
    /// As [`Rig::parse`] and [`FiveBar::parse`].
    pub fn parse(text: &str, origin: &Path) -> Result<Description, TraceError> {
        match FiveBar::describes(text, origin)? {
            true => FiveBar::parse(text, origin).map(Description::FiveBar),
            false => Rig::parse(text, origin).map(Description::Joint),
        }
    }

    /// Reads a description of either kind from a TOML file.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Description::parse`].
    pub fn read(path: &Path) -> Result<Description, TraceError> {
        Description::parse(&store::read_text(path)?, path)
    }

    /// Turns a recording into SI quantities; `origin` is the file that messages name.
    ///
    /// # Errors
    /// A channel of the rig is missing, or its unit in the header does not convert to the rig's.
    pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<Measured, TraceError> {
        match self {
            Description::Joint(rig) => rig.apply(trace, origin).map(Measured::Joint),
            Description::FiveBar(rig) => rig.apply(trace, origin).map(Measured::FiveBar),
        }
    }

    /// Diagnoses recordings that were applied by this description, several of them together on the five-bar only; `held_out` is another
    /// recording of the same rig.
    ///
    /// `None` where a recording is of another plant, and for several of a plant of one joint.
    pub fn diagnose(
        &self,
        recordings: &[Measured],
        held_out: Option<&Measured>,
        options: &Options,
    ) -> Option<Diagnosis> {
        match (self, recordings) {
            (Description::Joint(rig), [Measured::Joint(recording)]) => {
                let held_out = match held_out {
                    Some(held_out) => Some(held_out.joint()?),
                    None => None,
                };
                Some(diagnose(rig, recording, held_out, options))
            }
            (Description::FiveBar(rig), recordings) => {
                let own = recordings.iter().map(Measured::five_bar);
                let own: Vec<&FiveBarRecording> = own.collect::<Option<_>>()?;
                let held_out = match held_out {
                    Some(held_out) => Some(held_out.five_bar()?),
                    None => None,
                };
                Some(five_bar::diagnose::diagnose(rig, &own, held_out, options))
            }
            _ => None,
        }
    }

    /// As TOML.
    pub fn to_toml(&self) -> String {
        match self {
            Description::Joint(rig) => rig.to_toml(),
            Description::FiveBar(rig) => rig.to_toml(),
        }
    }
}

/// A recording in SI units.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "few are ever made")]
pub enum Measured {
    /// Of a plant of one joint.
    Joint(Recording),
    /// Of the five-bar.
    FiveBar(FiveBarRecording),
}

impl Measured {
    /// The time stamps, s.
    pub fn time_s(&self) -> &[f64] {
        match self {
            Measured::Joint(recording) => &recording.time_s,
            Measured::FiveBar(recording) => &recording.time_s,
        }
    }

    const fn joint(&self) -> Option<&Recording> {
        match self {
            Measured::Joint(recording) => Some(recording),
            Measured::FiveBar(_) => None,
        }
    }

    const fn five_bar(&self) -> Option<&FiveBarRecording> {
        match self {
            Measured::FiveBar(recording) => Some(recording),
            Measured::Joint(_) => None,
        }
    }
}
