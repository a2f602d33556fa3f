//! This file reads what a verb is given: recordings, cut if asked, and what identifies a file.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use rigproof_diagnose::report::{InputFile, ReadAs};
use rigproof_diagnose::{Description, Measured};
use rigproof_trace::csv::{Dialect, LEAST_SAMPLES};
use rigproof_trace::mcap;
use rigproof_trace::rig::{Recording, Rig};
use rigproof_trace::{Place, TraceError};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::outcome::{self, Failure};
use crate::reading::{self, Reading};

/// Which part of a recording counts.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Cut {
    /// Leave out what was recorded before this time stamp
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    from_s: Option<f64>,
    /// Leave out what was recorded after this time stamp
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    to_s: Option<f64>,
}

impl Cut {
    /// Which samples count.
    fn kept(self, file: &Path, time_s: &[f64]) -> Result<Vec<bool>, Failure> {
        let first_s = self.from_s.unwrap_or(f64::NEG_INFINITY);
        let last_s = self.to_s.unwrap_or(f64::INFINITY);
        let inside = time_s.iter().map(|t| (first_s..=last_s).contains(t));
        let kept: Vec<bool> = inside.collect();
        let count = kept.iter().filter(|kept| **kept).count();
        if count < LEAST_SAMPLES {
            let problem = format!(
                "{count} samples lie between --from-s and --to-s, at least {LEAST_SAMPLES} are needed; the recording runs from {} s to {} s",
                time_s.first().unwrap_or(&f64::NAN),
                time_s.last().unwrap_or(&f64::NAN),
            );
            return Err(Failure::unusable(file, problem));
        }
        Ok(kept)
    }
}

/// The recordings that a path names: itself, or those in a folder, in the order of their names.
///
/// # Errors
/// The folder cannot be read or holds no recording.
pub fn recordings(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let unusable = |why: String| Failure::unusable(path, why);
    let entries = path
        .read_dir()
        .map_err(|error| unusable(error.to_string()))?;
    let mut found = Vec::new();
    for entry in entries {
        let file = entry.map_err(|error| unusable(error.to_string()))?.path();
        let extension = file.extension().and_then(|e| e.to_str());
        if file.is_file() && extension.is_some_and(|e| RECORDINGS.contains(&e)) {
            found.push(file);
        }
    }
    found.sort();
    match found.is_empty() {
        true => Err(unusable(format!(
            "no recording is in this folder: none ends in .{}",
            RECORDINGS.join(", .")
        ))),
        false => Ok(found),
    }
}

/// What the name of a recording in a folder ends in.
const RECORDINGS: [&str; 3] = ["csv", "txt", "mcap"];

/// A recording, the rig it is of, and the part that counts.
#[derive(Clone, Debug, clap::Args)]
pub struct Source {
    /// The recording: CSV in any dialect or MCAP, told apart by its content; for `diagnose` also a folder of a five-bar's recordings
    pub recording: PathBuf,
    /// The rig description: what the channels mean and which physics the nominal model has
    #[arg(long, value_name = "TOML")]
    pub rig: PathBuf,
    #[command(flatten)]
    pub cut: Cut,
    #[command(flatten)]
    pub reading: Reading,
}

/// How a recording was read.
#[derive(Clone, Debug)]
pub enum HowRead {
    /// As text in this dialect.
    Text(Dialect),
    /// As MCAP: check sums, what is missing, which times, what was resampled.
    Messages(Vec<String>),
}

impl HowRead {
    fn of_messages(lines: &[String]) -> HowRead {
        HowRead::Messages(lines.iter().map(|line| outcome::plain(line)).collect())
    }

    /// For a person, a line each; `file` is what they name.
    pub fn lines(&self, file: &Path) -> Vec<String> {
        match self {
            HowRead::Text(dialect) => vec![reading::in_words(file, dialect)],
            HowRead::Messages(lines) => {
                let lines = lines.iter();
                lines
                    .map(|line| format!("{}: {line}", file.display()))
                    .collect()
            }
        }
    }

    /// The dialect, or the lines of an MCAP file.
    pub fn json(&self) -> Value {
        match self {
            HowRead::Text(dialect) => reading::in_json(*dialect),
            HowRead::Messages(lines) => json!(lines),
        }
    }

    /// The dialect of a text.
    pub fn dialect(&self) -> Option<Dialect> {
        match self {
            HowRead::Text(dialect) => Some(*dialect),
            HowRead::Messages(_) => None,
        }
    }
}

/// Reads a recording of a rig, and says how it was read.
///
/// # Errors
/// The file is not usable.
pub fn whole(rig: &Rig, file: &Path, reading: &Reading) -> Result<(Recording, HowRead), Failure> {
    if mcap::is_mcap(file)? {
        let (recording, lines) = rig.read_mcap(file)?;
        return Ok((recording, HowRead::of_messages(&lines)));
    }
    let (recording, dialect) = rig.read_text(file, &reading.hints())?;
    Ok((recording, HowRead::Text(dialect)))
}

/// Reads a recording of any plant and cuts it, and says how it was read.
///
/// # Errors
/// The file is not usable, or the cut leaves too little.
pub fn measured(
    description: &Description,
    file: &Path,
    cut: Cut,
    reading: &Reading,
) -> Result<(Measured, HowRead), Failure> {
    let (whole, how) = if mcap::is_mcap(file)? {
        let (recording, lines) = description.read_mcap(file)?;
        (recording, HowRead::of_messages(&lines))
    } else {
        let (recording, dialect) = description.read_text(file, &reading.hints())?;
        (recording, HowRead::Text(dialect))
    };
    let kept = cut.kept(file, whole.time_s())?;
    Ok((whole.only(&kept), how))
}

/// A file's path as given, its SHA-256, and how it was read if it is a text recording.
///
/// # Errors
/// The file cannot be read, or is none that can be read twice.
pub fn identity(file: &Path, dialect: Option<Dialect>) -> Result<InputFile, Failure> {
    let refused = |source| TraceError::File {
        action: "read",
        path: file.to_path_buf(),
        source,
    };
    let mut open = File::open(file).map_err(refused)?;
    if !open.metadata().map_err(refused)?.is_file() {
        let error = TraceError::NotText {
            place: Place::file(file),
            problem: "it is no ordinary file",
        };
        return Err(error.into());
    }
    let mut hash = Sha256::new();
    let mut bytes = vec![0; 1 << 16];
    loop {
        let count = open.read(&mut bytes).map_err(refused)?;
        match bytes.get(..count) {
            Some(read) if count > 0 => hash.update(read),
            _ => break,
        }
    }
    Ok(InputFile {
        path: file.display().to_string(),
        sha256: hexadecimal(&hash.finalize()),
        read_as: dialect.map(ReadAs::from),
    })
}

/// The identity of bytes that are written under a name.
pub fn identity_of(name: &str, bytes: &[u8]) -> InputFile {
    InputFile {
        path: name.to_owned(),
        sha256: hexadecimal(&Sha256::digest(bytes)),
        read_as: None,
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_the_standard() {
        // FIPS 180-4, the example "abc".
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(identity_of("abc.txt", b"abc").sha256, expected);
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("abc.txt");
        std::fs::write(&file, "abc").unwrap();
        assert_eq!(identity(&file, None).unwrap().sha256, expected);
        assert!(identity(folder.path(), None).is_err());
    }
}
