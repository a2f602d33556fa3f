//! This file is how a rig's recordings are simulated: what the drive does between samples, where a run starts.

use super::table::Table;
use crate::error::TraceError;

/// What a drive does between two samples of its command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Drive {
    /// It holds the last value, as a digital controller's output does.
    Held,
    /// It goes straight from one to the next: the command was sampled, not produced, at these instants.
    Straight,
    /// It is band-limited and repeats after the recording.
    Periodic,
    /// Each row of a bench was taken after everything had settled: a sweep, without a time.
    Static,
}

impl Drive {
    /// All of them.
    pub const ALL: [Drive; 4] = [Drive::Held, Drive::Straight, Drive::Periodic, Drive::Static];

    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Drive::Held => "held",
            Drive::Straight => "straight",
            Drive::Periodic => "periodic",
            Drive::Static => "static",
        }
    }
}

/// How free runs of a rig are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol {
    /// What the drive does between samples.
    pub drive: Drive,
    /// Samples that give the start state, by a parabola; 0 starts at rest.
    pub start_samples: usize,
    /// Integration steps a sample.
    pub substeps: usize,
    /// Repetitions of a periodic recording before the one that counts.
    pub warm_up_periods: usize,
}

impl Default for Protocol {
    fn default() -> Protocol {
        Protocol {
            drive: Drive::Straight,
            start_samples: 20,
            substeps: 1,
            warm_up_periods: 0,
        }
    }
}

impl Protocol {
    /// Reads the table `[protocol]`; what it leaves out is as in [`Protocol::default`].
    pub(super) fn read(root: &Table<'_>) -> Result<Protocol, TraceError> {
        let default = Protocol::default();
        let Some(table) = root.table("protocol")? else {
            return Ok(default);
        };
        table.only(&["drive", "start_samples", "substeps", "warm_up_periods"])?;
        let drive = if table.has("drive") {
            super::read::choice(&table, "drive", Drive::ALL, Drive::name)?
        } else {
            default.drive
        };
        let count = |key: &str, default: usize, least: f64, most: f64| match table.number(key)? {
            None => Ok(default),
            Some(n) if n.fract() == 0.0 && (least..=most).contains(&n) => Ok(n as usize),
            Some(n) => Err(table.error_at(
                key,
                format!("`{key}` is {n}; give a whole number from {least} to {most}"),
            )),
        };
        Ok(Protocol {
            drive,
            start_samples: count("start_samples", default.start_samples, 0.0, 1000.0)?,
            substeps: count("substeps", default.substeps, 1.0, 100.0)?,
            warm_up_periods: count("warm_up_periods", default.warm_up_periods, 0.0, 10.0)?,
        })
    }

    /// The table as text; nothing when it holds the defaults.
    pub(super) fn lines(&self) -> Vec<String> {
        if *self == Protocol::default() {
            return Vec::new();
        }
        vec![
            "\n[protocol]".into(),
            format!("drive = \"{}\"", self.drive.name()),
            format!("start_samples = {}", self.start_samples),
            format!("substeps = {}", self.substeps),
            format!("warm_up_periods = {}", self.warm_up_periods),
        ]
    }
}
