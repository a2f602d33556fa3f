//! This file reads what a verb is given: recordings, cut if asked, and what identifies a file.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use rigproof_diagnose::report::{InputFile, ReadAs};
use rigproof_diagnose::{Description, Measured};
use rigproof_trace::csv::{Dialect, LEAST_SAMPLES};
use rigproof_trace::mcap;
use rigproof_trace::rig::{Recording, Rig};
use rigproof_trace::{Place, Trace, TraceError};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::outcome::{self, Failure};
use crate::reading::{self, RigReading};

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
    /// What lies between two time stamps, s.
    pub fn between(from_s: Option<f64>, to_s: Option<f64>) -> Cut {
        Cut { from_s, to_s }
    }

    /// Whether everything counts.
    fn is_whole(self) -> bool {
        self.from_s.is_none() && self.to_s.is_none()
    }

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
    if let Some(file) = bag(path)? {
        return Ok(vec![file]);
    }
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
        if file.is_file() && extension.is_some_and(is_recording) {
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

fn is_recording(extension: &str) -> bool {
    RECORDINGS
        .iter()
        .any(|own| extension.eq_ignore_ascii_case(own))
}

/// What the name of a recording in a folder ends in.
const RECORDINGS: [&str; 3] = ["csv", "txt", "mcap"];

/// A recording, the rig it is of, and the part that counts.
#[derive(Clone, Debug, clap::Args)]
pub struct Source {
    /// The recording: CSV in any dialect or MCAP, told apart by its content; for `diagnose` also a folder of recordings of one rig
    pub recording: PathBuf,
    /// The rig description: what the channels mean and which physics the nominal model has
    #[arg(long, value_name = "TOML")]
    pub rig: PathBuf,
    #[command(flatten)]
    pub cut: Cut,
    #[command(flatten)]
    pub reading: RigReading,
}

/// How a recording was read.
#[derive(Clone, Debug)]
pub enum HowRead {
    /// As text in this dialect; what was guessed, passed over or mended.
    Text(Dialect, Vec<String>),
    /// As MCAP: check sums, what is missing, which times, what was resampled.
    Messages(Vec<String>),
}

impl HowRead {
    /// As MCAP, with what was said of it.
    pub fn of_messages(lines: &[String]) -> HowRead {
        HowRead::Messages(plain_lines(lines))
    }

    /// As text, with what was guessed, passed over or mended.
    pub fn of_text(dialect: Dialect, remarks: &[String]) -> HowRead {
        HowRead::Text(dialect, plain_lines(remarks))
    }

    /// For a person, a line each; `file` is what they name.
    pub fn lines(&self, file: &Path) -> Vec<String> {
        let (first, lines) = match self {
            HowRead::Text(dialect, remarks) => (Some(reading::in_words(file, dialect)), remarks),
            HowRead::Messages(lines) => (None, lines),
        };
        let lines = lines
            .iter()
            .map(|line| format!("{}: {line}", file.display()));
        first.into_iter().chain(lines).collect()
    }

    /// The dialect, or the lines of an MCAP file.
    pub fn json(&self) -> Value {
        match self {
            HowRead::Text(dialect, _) => reading::in_json(*dialect),
            HowRead::Messages(lines) => json!(lines),
        }
    }

    /// The dialect of a text.
    pub fn dialect(&self) -> Option<Dialect> {
        match self {
            HowRead::Text(dialect, _) => Some(*dialect),
            HowRead::Messages(_) => None,
        }
    }
}

/// Lines that cannot steer the terminal, whatever the file calls things.
fn plain_lines(lines: &[String]) -> Vec<String> {
    lines.iter().map(|line| outcome::plain(line)).collect()
}

/// The file that a path names: itself, or the recording in a folder that rosbag2 wrote.
///
/// # Errors
/// It is a folder of rosbag2 that holds no MCAP file, or several.
pub fn file(path: &Path) -> Result<PathBuf, Failure> {
    Ok(bag(path)?.unwrap_or_else(|| path.to_path_buf()))
}

/// The MCAP file of a folder that rosbag2 wrote: `metadata.yaml` stands beside it.
fn bag(path: &Path) -> Result<Option<PathBuf>, Failure> {
    if !path.is_dir() || !path.join("metadata.yaml").is_file() {
        return Ok(None);
    }
    let unusable = |why: String| Failure::unusable(path, why);
    let entries = path
        .read_dir()
        .map_err(|error| unusable(error.to_string()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> = files.collect();
    files.sort();
    let of = |extension: &str| {
        let own = files
            .iter()
            .filter(|file| file.extension().is_some_and(|e| e == extension));
        own.collect::<Vec<_>>()
    };
    let folder = path.display();
    match (of("mcap").as_slice(), of("db3").first(), of("zstd").first()) {
        ([only], ..) => Ok(Some((*only).clone())),
        ([], Some(_), _) => Err(unusable(format!(
            "this folder of rosbag2 holds `.db3` files; turn it into MCAP, which is read: `ros2 bag convert -i {folder} -o convert.yaml` with `output_bags: [{{uri: run, storage_id: mcap, all: true}}]` in convert.yaml, or for each file `mcap convert FILE.db3 FILE.mcap`"
        ))),
        ([], None, Some(packed)) => Err(unusable(format!(
            "this folder of rosbag2 holds compressed files; unpack them first: `zstd -d {}`",
            packed.display()
        ))),
        ([], None, None) => Err(unusable(
            "this folder of rosbag2 holds no recording beside its metadata.yaml".to_owned(),
        )),
        (several, ..) => Err(unusable(format!(
            "this folder of rosbag2 holds {} MCAP files; name one of them, or put them together: `mcap merge {folder}/*.mcap -o run.mcap`",
            several.len()
        ))),
    }
}

/// Reads a recording of a rig, and says how it was read.
///
/// # Errors
/// The file is not usable.
pub fn whole(
    rig: &Rig,
    file: &Path,
    reading: &RigReading,
) -> Result<(Recording, HowRead), Failure> {
    let rig = rig.with_column_units(reading.units());
    let rig = rig.map_err(Failure::Usage)?;
    let file = &self::file(file)?;
    if mcap::is_mcap(file)? {
        let (recording, lines) = rig.read_mcap(file)?;
        return Ok((recording, HowRead::of_messages(&lines)));
    }
    let (recording, dialect, remarks) = rig.read_text(file, &reading.hints())?;
    Ok((recording, HowRead::of_text(dialect, &remarks)))
}

/// A recording that is given: a file, or channels in memory under a name.
pub enum Taken {
    /// A file.
    File(PathBuf),
    /// Channels in memory, what messages call them, and what was mended in their time stamps.
    Channels(PathBuf, Trace, Vec<String>),
}

impl Taken {
    /// What messages call it.
    pub fn name(&self) -> &Path {
        match self {
            Taken::File(name) | Taken::Channels(name, ..) => name,
        }
    }
}

/// What identifies channels in memory: the SHA-256 of names, units and numbers, those as 8 bytes each, the lowest first.
fn identity_of_channels(name: &Path, trace: &Trace) -> InputFile {
    let mut hash = Sha256::new();
    let mut all = |samples: &[f64]| {
        for part in samples.chunks(1 << 13) {
            let bytes: Vec<u8> = part.iter().flat_map(|x| x.to_le_bytes()).collect();
            hash.update(&bytes);
        }
    };
    all(&trace.time_s);
    trace.channels.iter().for_each(|own| all(&own.samples));
    for own in &trace.channels {
        hash.update(format!("{:?} {:?};", own.name, own.unit));
    }
    InputFile {
        path: name.display().to_string(),
        sha256: hexadecimal(&hash.finalize()),
        read_as: None,
    }
}

/// Reads a recording that is given, cuts it, and says how it was read and what identifies it. Channels in memory are turned into SI units where they stand.
///
/// # Errors
/// It is not usable, or the cut leaves too little.
pub fn taken(
    description: &Description,
    one: Taken,
    cut: Cut,
    reading: &RigReading,
) -> Result<(Measured, HowRead, InputFile), Failure> {
    let (name, trace, said) = match one {
        Taken::File(file) => {
            let (recording, how) = measured(description, &file, cut, reading)?;
            let identity = identity(&file, how.dialect())?;
            return Ok((recording, how, identity));
        }
        Taken::Channels(name, trace, said) => (name, trace, said),
    };
    let mut description = description.clone();
    // Units of channels in memory are said by whoever gives them: they count like those of the command line.
    let stated = trace.channels.iter().filter(|own| !own.unit.is_empty());
    for own in stated {
        let unit = [(own.name.clone(), own.unit.clone())];
        if let Ok(with) = description.with_column_units(&unit) {
            description = with;
        }
    }
    let identity = identity_of_channels(&name, &trace);
    let whole = description.taken(trace, &name)?;
    let how = HowRead::of_messages(&said);
    if cut.is_whole() {
        return Ok((whole, how, identity));
    }
    let kept = cut.kept(&name, whole.time_s())?;
    Ok((whole.only(&kept), how, identity))
}

/// Reads a recording of any plant and cuts it, and says how it was read.
///
/// # Errors
/// The file is not usable, or the cut leaves too little.
pub fn measured(
    description: &Description,
    file: &Path,
    cut: Cut,
    reading: &RigReading,
) -> Result<(Measured, HowRead), Failure> {
    let description = description.with_column_units(reading.units());
    let description = description.map_err(Failure::Usage)?;
    let file = &self::file(file)?;
    let (whole, how) = if mcap::is_mcap(file)? {
        let (recording, lines) = description.read_mcap(file)?;
        (recording, HowRead::of_messages(&lines))
    } else {
        let (recording, dialect, remarks) = description.read_text(file, &reading.hints())?;
        (recording, HowRead::of_text(dialect, &remarks))
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
    fn a_folder_of_rosbag2_is_the_recording_in_it() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str| std::fs::write(folder.path().join(name), "x").unwrap();
        put("run_0.mcap");
        assert_eq!(file(folder.path()).unwrap(), folder.path());
        put("metadata.yaml");
        assert_eq!(
            file(folder.path()).unwrap(),
            folder.path().join("run_0.mcap")
        );
        assert_eq!(
            recordings(folder.path()).unwrap(),
            [folder.path().join("run_0.mcap")]
        );
        put("run_1.mcap");
        let message = |path: &Path| format!("{:?}", file(path).unwrap_err());
        assert!(message(folder.path()).contains("mcap merge"));
        let other = tempfile::tempdir().unwrap();
        for name in ["metadata.yaml", "run_0.db3"] {
            std::fs::write(other.path().join(name), "x").unwrap();
        }
        assert!(message(other.path()).contains("ros2 bag convert"));
    }

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
