//! This file keeps what was done of a campaign, a line a chunk, so that a campaign that was killed goes on where it was.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use rigproof_trace::store::write_aside;
use serde::{Deserialize, Serialize};

use crate::digest;
use crate::error::Error;
use crate::plan::Plan;
use crate::record::Record;
use crate::tool::Tool;

/// The journal's name in its folder.
pub const FILE: &str = "journal.jsonl";

/// A part of a campaign: `[i, n]` is the i-th of n, counted from 0.
pub type Shard = [u64; 2];

/// The first line of a journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// What is run.
    pub plan: Plan,
    /// Which part of it.
    pub shard: Shard,
    /// What runs it.
    pub tool: Tool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    chunk: u64,
    records: Vec<Record>,
    /// [`seal`].
    sha256: String,
}

/// The SHA-256 of a line: of the first line's, the chunk's number and its records, so that a line that was changed, or that stood in another journal, shows.
fn seal(header: &str, chunk: u64, records: &[Record]) -> Result<String, Error> {
    digest::of_value(&(header, chunk, records))
}

/// Chunks of records by their number.
pub type Chunks = BTreeMap<u64, Vec<Record>>;

/// A journal that is written to.
pub struct Journal {
    path: PathBuf,
    /// The SHA-256 of its first line.
    header: String,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal of a folder, and gives what was done before; a last line that was cut off is taken away.
    ///
    /// # Errors
    /// The system refuses, or the journal there is of another campaign.
    pub fn open(folder: &Path, header: &Header) -> Result<(Journal, Chunks), Error> {
        let path = folder.join(FILE);
        let refused = |error: std::io::Error| Error::refused(&path, &error);
        std::fs::create_dir_all(folder).map_err(refused)?;
        let mut file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(&path)
            .map_err(refused)?;
        file.try_lock().map_err(|_| {
            let advice = "wait for it, or give another folder with --out";
            Error::unusable(&path, format!("another process writes here; {advice}"))
        })?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(refused)?;
        let whole = bytes.iter().rposition(|byte| *byte == b'\n');
        let whole = whole.map_or(0, |last| last + 1);
        bytes.truncate(whole);
        file.set_len(whole as u64).map_err(refused)?;
        let chunks = if bytes.is_empty() {
            let mut line = serde_json::to_vec(header)?;
            line.push(b'\n');
            file.write_all(&line).map_err(refused)?;
            Chunks::new()
        } else {
            let (there, chunks) = parse(&path, &bytes)?;
            if let Some(differs) = differs(&there, header) {
                let problem = format!(
                    "another campaign was begun here: {differs}; give another folder with --out"
                );
                return Err(Error::unusable(&path, problem));
            }
            chunks
        };
        let journal = Journal {
            path,
            header: digest::of_value(header)?,
            file: Mutex::new(file),
        };
        Ok((journal, chunks))
    }

    /// Writes down a chunk.
    ///
    /// # Errors
    /// The system refuses.
    pub fn add(&self, chunk: u64, records: &[Record]) -> Result<(), Error> {
        let line = Line {
            chunk,
            records: records.to_vec(),
            sha256: seal(&self.header, chunk, records)?,
        };
        let mut line = serde_json::to_vec(&line)?;
        line.push(b'\n');
        // A thread that panicked here has ended the campaign already.
        let mut file = self
            .file
            .lock()
            .unwrap_or_else(|broken| broken.into_inner());
        file.write_all(&line)
            .map_err(|error| Error::refused(&self.path, &error))
    }
}

/// Writes a whole journal at once, as if its campaign had been run in one piece; nothing may be writing to the one that is there.
///
/// # Errors
/// The system refuses.
pub fn write(folder: &Path, header: &Header, chunks: &Chunks) -> Result<(), Error> {
    let path = folder.join(FILE);
    if let Ok(there) = File::open(&path) {
        there.try_lock().map_err(|_| {
            let advice = "wait for it, or give another folder with --out";
            Error::unusable(&path, format!("another process writes here; {advice}"))
        })?;
    }
    let mut text = serde_json::to_vec(header)?;
    text.push(b'\n');
    let of_header = digest::of_value(header)?;
    for (chunk, records) in chunks {
        let line = Line {
            chunk: *chunk,
            records: records.clone(),
            sha256: seal(&of_header, *chunk, records)?,
        };
        serde_json::to_writer(&mut text, &line)?;
        text.push(b'\n');
    }
    Ok(write_aside(&path, &text)?)
}

/// In what one campaign differs from another.
fn differs(there: &Header, here: &Header) -> Option<&'static str> {
    if there.plan != here.plan {
        Some("its plan differs")
    } else if there.shard != here.shard {
        Some("its shard differs")
    } else if there.tool != here.tool {
        Some("another build of this program ran it")
    } else {
        None
    }
}

/// Reads the journal of a folder.
///
/// # Errors
/// There is none, or it is not as it was written.
pub fn read(folder: &Path) -> Result<(Header, Chunks), Error> {
    let path = folder.join(FILE);
    let bytes = std::fs::read(&path).map_err(|error| Error::refused(&path, &error))?;
    parse(&path, &bytes)
}

fn parse(path: &Path, bytes: &[u8]) -> Result<(Header, Chunks), Error> {
    let mut lines = bytes.split_inclusive(|byte| *byte == b'\n');
    let lines = lines.by_ref().filter(|line| line.ends_with(b"\n"));
    let mut lines = (1..).zip(lines);
    let refused = |number: usize, why: &str| {
        let advice = "begin the campaign anew in another folder";
        Error::unusable(
            path,
            format!("line {number} is not as it was written: {why}; {advice}"),
        )
    };
    let wrong = |number: usize, error: serde_json::Error| refused(number, &error.to_string());
    let (_, first) = lines
        .next()
        .ok_or_else(|| Error::unusable(path, "the journal is empty; run the campaign first"))?;
    let header: Header = serde_json::from_slice(first).map_err(|error| wrong(1, error))?;
    let of_header = digest::of_value(&header)?;
    let mut chunks = Chunks::new();
    for (number, line) in lines {
        let line: Line = serde_json::from_slice(line).map_err(|error| wrong(number, error))?;
        if seal(&of_header, line.chunk, &line.records)? != line.sha256 {
            return Err(refused(
                number,
                "its SHA-256 is another, or the first line's",
            ));
        }
        if chunks.insert(line.chunk, line.records).is_some() {
            return Err(refused(number, "its chunk stands in an earlier line"));
        }
    }
    Ok((header, chunks))
}
