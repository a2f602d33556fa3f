//! This file is a position servo as the drive of an axis: its command is a goal, its voltage follows the error, and its numbers may differ from
//! recording to recording.

use std::path::Path;

use super::table::Table;
use super::write::string;
use crate::error::TraceError;

/// A position servo: voltage = gain·(goal − position), nothing within the dead band, cut at the supply. The effort is the command gain (the
/// torque constant over the resistance) times the voltage less the back-EMF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Voltage for an error, V/rad or V/m.
    pub gain: f64,
    /// The supply, at which the voltage saturates, V.
    pub supply_v: f64,
    /// Error within which no voltage is given, rad or m.
    pub dead_band: f64,
    /// Voltage that motion induces, V·s/rad or V·s/m: 0 where viscous drag is to hold it.
    pub back_emf: f64,
}

/// What one recording of several states of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingEntry {
    /// The file's name, without folders.
    pub file: String,
    /// The servo's gain in it, V/rad or V/m.
    pub gain: f64,
}

impl Servo {
    /// The voltage for an error, V.
    pub fn voltage(&self, error: f64) -> f64 {
        match error.abs() <= self.dead_band {
            true => 0.0,
            false => (self.gain * error).clamp(-self.supply_v, self.supply_v),
        }
    }

    /// Reads `[servo]`, whose numbers are in SI units.
    pub(super) fn read(root: &Table<'_>) -> Result<Option<Servo>, TraceError> {
        let Some(table) = root.table("servo")? else {
            return Ok(None);
        };
        table.only(&["gain", "supply_v", "dead_band", "back_emf"])?;
        let not_negative = |key: &str| match table.number(key)? {
            Some(n) if n < 0.0 => {
                Err(table.error_at(key, format!("`{key}` is {n}; give 0 or more, in SI units")))
            }
            other => Ok(other.unwrap_or(0.0)),
        };
        Ok(Some(Servo {
            gain: table.need("gain", table.positive("gain")?)?,
            supply_v: table.need("supply_v", table.positive("supply_v")?)?,
            dead_band: not_negative("dead_band")?,
            back_emf: not_negative("back_emf")?,
        }))
    }

    pub(super) fn lines(&self) -> Vec<String> {
        let Servo {
            gain,
            supply_v,
            dead_band,
            back_emf,
        } = self;
        vec![
            "\n[servo]".to_owned(),
            format!("gain = {gain:?}"),
            format!("supply_v = {supply_v:?}"),
            format!("dead_band = {dead_band:?}"),
            format!("back_emf = {back_emf:?}"),
        ]
    }

    /// The servo of the recording in a file: with the gain that its entry states.
    pub(super) fn of(self, entries: &[RecordingEntry], file: &Path) -> Servo {
        let name = file.file_name().and_then(|name| name.to_str());
        let own = entries.iter().find(|entry| Some(&*entry.file) == name);
        Servo {
            gain: own.map_or(self.gain, |entry| entry.gain),
            ..self
        }
    }
}

impl RecordingEntry {
    /// Reads every `[[recording]]`; they state the gain of a servo.
    pub(super) fn read_all(root: &Table<'_>, has_servo: bool) -> Result<Vec<Self>, TraceError> {
        let mut entries: Vec<RecordingEntry> = Vec::new();
        for table in &root.tables("recording")? {
            table.only(&["file", "gain"])?;
            if !has_servo {
                let problem = "`[[recording]]` states the gain of a servo; add `[servo]`, or take the entry out";
                return Err(table.error(problem));
            }
            let file = table.need("file", table.text("file")?)?.to_owned();
            if file.contains(['/', '\\']) || entries.iter().any(|entry| entry.file == file) {
                let problem = format!(
                    "`{file}` is no name of a file without folders that stands here once; give each recording one entry"
                );
                return Err(table.error_at("file", problem));
            }
            let gain = table.need("gain", table.positive("gain")?)?;
            entries.push(RecordingEntry { file, gain });
        }
        Ok(entries)
    }

    pub(super) fn lines(&self) -> Vec<String> {
        vec![
            "\n[[recording]]".to_owned(),
            format!("file = {}", string(&self.file)),
            format!("gain = {:?}", self.gain),
        ]
    }
}
