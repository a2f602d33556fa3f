//! This file says what can be wrong with a recording or a rig description, where, and what to do about it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Where in a file something was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, as the caller named it.
    pub file: PathBuf,
    /// Line, counted from 1; 0 for the file as a whole.
    pub line: usize,
    /// Column, counted from 1: a cell of a CSV line, a character of any other; 0 for the whole line.
    pub column: usize,
    /// The name that stands over the column, or nothing.
    pub name: String,
}

impl Place {
    /// The file as a whole.
    pub fn file(file: &Path) -> Place {
        Place::line(file, 0)
    }

    /// A whole line of a file.
    pub fn line(file: &Path, line: usize) -> Place {
        Place {
            file: file.to_path_buf(),
            line,
            column: 0,
            name: String::new(),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if self.line > 0 {
            write!(f, ", line {}", self.line)?;
        }
        if self.column > 0 {
            write!(f, ", column {}", self.column)?;
        }
        if !self.name.is_empty() {
            write!(f, " `{}`", self.name)?;
        }
        Ok(())
    }
}

/// What is wrong with a recording, a rig description, or the place where one is to be written.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// The operating system refused.
    #[error("cannot {action} {}: {}", path.display(), reason(source))]
    File {
        /// What was tried: `read`, `write`, …
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
    /// The file is no text.
    #[error("{place}: {problem}; give a text file, MCAP, HDF5 or MATLAB")]
    NotText {
        /// Where.
        place: Place,
        /// What was found.
        problem: &'static str,
    },
    /// Nothing is in the file.
    #[error("{}: the file is empty; a recording is a header line and at least {least} samples", file.display())]
    Empty {
        /// The file.
        file: PathBuf,
        /// The fewest samples.
        least: usize,
    },
    /// There are not enough samples.
    #[error("{}: the recording has {samples} samples, at least {least} are needed; record for longer", file.display())]
    TooFewSamples {
        /// The file.
        file: PathBuf,
        /// How many there are.
        samples: usize,
        /// The fewest samples.
        least: usize,
    },
    /// The header is not usable.
    #[error("{place}: {problem}")]
    Header {
        /// Where.
        place: Place,
        /// What was found and what to do.
        problem: String,
    },
    /// A line has another number of cells than the header.
    #[error(
        "{place}: the line has {found} cells, the header has {expected}; the line is cut off, or its decimal commas look like separators: export it with another separator or with decimal points"
    )]
    CellCount {
        /// Where.
        place: Place,
        /// Cells of the line.
        found: usize,
        /// Cells of the header.
        expected: usize,
    },
    /// A cell holds no finite number.
    #[error(
        "{place}: `{text}` is no finite number; leave the cell empty, or write `nan`, where a sample is missing"
    )]
    NotANumber {
        /// Where.
        place: Place,
        /// What the cell holds, shortened.
        text: String,
    },
    /// A time stamp is missing.
    #[error("{place}: the time stamp is missing; every line needs one")]
    TimeMissing {
        /// Where.
        place: Place,
    },
    /// A time stamp is neither a number nor a date.
    #[error(
        "{place}: the time stamp `{text}` is no finite number and no date with a time of day (`2024-05-06 10:11:12.125`, `10:11:12.125`); correct it, or name another column as the time"
    )]
    NoStamp {
        /// Where.
        place: Place,
        /// What the cell holds, shortened.
        text: String,
    },
    /// Time goes backward.
    #[error(
        "{place}: the time stamp {time_s} s goes backward after {previous_s} s: the clock was set, a second recording begins here, or lines were exchanged; cut the file there, or sort its lines"
    )]
    TimeOrder {
        /// Where.
        place: Place,
        /// The time stamp, s.
        time_s: f64,
        /// The one before it, s.
        previous_s: f64,
    },
    /// Time stamps are repeated, and not as rounding or transfers in bursts would do it.
    #[error(
        "{place}: the time stamp is repeated, and the lines that share a stamp come in no regular pattern, so when they were sampled is not told; record stamps with more digits, or name another column as the time"
    )]
    TimeRepeated {
        /// The first place.
        place: Place,
    },
    /// The file is of a kind that is not read here.
    #[error("{}: this is {kind}; {way}", file.display())]
    OtherKind {
        /// The file.
        file: PathBuf,
        /// What it is.
        kind: &'static str,
        /// How to bring it in.
        way: String,
    },
    /// A rig description is not usable.
    #[error("{place}: {problem}")]
    Rig {
        /// Where.
        place: Place,
        /// What was found, what is allowed and what to do.
        problem: String,
    },
    /// A recording does not suit the rig or what was asked of it.
    #[error("{}: {problem}", file.display())]
    Recording {
        /// The recording.
        file: PathBuf,
        /// What was found, what is allowed and what to do.
        problem: String,
    },
    /// Two series that are to be compared do not match.
    #[error("cannot compare {measured} measured with {simulated} simulated samples; {advice}")]
    Comparison {
        /// Samples of the first series.
        measured: usize,
        /// Samples of the second series.
        simulated: usize,
        /// What to do.
        advice: &'static str,
    },
}

impl TraceError {
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> TraceError {
        let path = path.to_path_buf();
        move |source| TraceError::File {
            action,
            path,
            source,
        }
    }

    /// A recording or its rig that does not serve.
    pub fn recording(file: &Path, problem: impl Into<String>) -> TraceError {
        TraceError::Recording {
            file: file.to_path_buf(),
            problem: problem.into(),
        }
    }
}

/// The system's reason in plain words, with what to do.
fn reason(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => "there is no such file or folder; check the path".into(),
        io::ErrorKind::PermissionDenied => {
            "permission is denied; check who owns it and its mode".into()
        }
        io::ErrorKind::IsADirectory => "it is a folder; name a file".into(),
        io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder".into(),
        _ => source.to_string(),
    }
}
