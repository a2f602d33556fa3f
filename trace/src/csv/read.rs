//! This file reads a recording from a text file, in whatever dialect its logger writes.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use encoding_rs_io::DecodeReaderBytesBuilder;
use flate2::read::MultiGzDecoder;

use super::columns::{Header, Role, TimeColumn};
use super::dialect::{Decimal, Dialect, Encoding, Hints, is_missing};
use super::layout::Layout;
use super::lines::{Lines, Splitter};
use super::logger::TimeBase;
use crate::budget;
use crate::clock::{self, Settled};
use crate::error::{Place, TraceError};
use crate::foreign;
use crate::series::{Channel, Trace};

/// The fewest samples a recording may have: half of them would not carry any conclusion.
pub const LEAST_SAMPLES: usize = 16;
/// How much of a file is looked at to find out its dialect, bytes.
const PROBE: u64 = 1 << 20;
/// What a file compressed with gzip begins with.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// A recording out of a text file, and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The recording.
    pub trace: Trace,
    /// How the file is written down.
    pub dialect: Dialect,
    /// What was guessed, passed over or mended, a line each.
    pub remarks: Vec<String>,
}

/// What the caller knows of a text file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known<'a> {
    /// Which column holds the time.
    pub time: Option<&'a TimeColumn>,
    /// How it is written down.
    pub hints: Hints,
    /// The channels that are needed; all that hold numbers, if that is not known.
    pub wanted: Option<&'a [&'a str]>,
    /// Whether the rows are those of a sweep, which has no time: they are counted, one a second.
    pub is_sweep: bool,
}

/// Reads a recording; the time column is the first one that is called like time (`t`, `time (ms)`, `t_s`, …).
///
/// Lines that start with `#` or `%` are comments, an empty cell or `nan` is a missing sample (NaN), and steps may be irregular.
///
/// # Errors
/// The file cannot be read, is no text, has no usable header, a cell that holds no finite number, a time stamp
/// that does not grow, or fewer than [`LEAST_SAMPLES`] samples.
pub fn read(path: &Path) -> Result<Trace, TraceError> {
    read_as(path, None, &Hints::default()).map(|(trace, _)| trace)
}

/// Reads a recording whose time column or dialect the caller knows, and says in which dialect it was; see [`read`].
///
/// # Errors
/// As [`read`].
pub fn read_as(
    path: &Path,
    time: Option<&TimeColumn>,
    hints: &Hints,
) -> Result<(Trace, Dialect), TraceError> {
    let known = Known {
        time,
        hints: *hints,
        ..Known::default()
    };
    read_text(path, &known).map(|text| (text.trace, text.dialect))
}

/// Reads a recording of which the caller knows something, and says how it was read; see [`read`].
///
/// # Errors
/// As [`read`], and for a file of another kind, which is named with the way in.
pub fn read_text(path: &Path, known: &Known<'_>) -> Result<Text, TraceError> {
    foreign::check(path)?;
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    parse_text(file, path, known)
}

/// Reads a recording from text that stands in `file`; see [`read`].
///
/// # Errors
/// As [`read`].
pub fn parse(
    source: impl Read,
    file: &Path,
    time: Option<&TimeColumn>,
) -> Result<Trace, TraceError> {
    parse_as(source, file, time, &Hints::default()).map(|(trace, _)| trace)
}

/// Reads a recording from text that stands in `file`; see [`read_as`].
///
/// # Errors
/// As [`read`].
pub fn parse_as(
    source: impl Read,
    file: &Path,
    time: Option<&TimeColumn>,
    hints: &Hints,
) -> Result<(Trace, Dialect), TraceError> {
    let known = Known {
        time,
        hints: *hints,
        ..Known::default()
    };
    parse_text(source, file, &known).map(|text| (text.trace, text.dialect))
}

/// Reads a recording from text that stands in `file`, which may be compressed with gzip; see [`read_text`].
///
/// # Errors
/// As [`read`].
pub fn parse_text(
    mut source: impl Read,
    file: &Path,
    known: &Known<'_>,
) -> Result<Text, TraceError> {
    let mut start = Vec::new();
    let refused = TraceError::io("read", file);
    source
        .by_ref()
        .take(2)
        .read_to_end(&mut start)
        .map_err(refused)?;
    let is_gzip = start == GZIP;
    let source = Cursor::new(start).chain(source);
    match is_gzip {
        true => parse_plain(MultiGzDecoder::new(source), file, known),
        false => parse_plain(source, file, known),
    }
}

fn parse_plain(source: impl Read, file: &Path, known: &Known<'_>) -> Result<Text, TraceError> {
    let (encoding, mut text) = decoded(source).map_err(TraceError::io("read", file))?;
    let mut start = Vec::new();
    text.by_ref()
        .take(PROBE)
        .read_to_end(&mut start)
        .map_err(TraceError::io("read", file))?;
    let cut = u64::try_from(start.len()).is_ok_and(|length| length == PROBE);
    let whole = start
        .iter()
        .rposition(|byte| *byte == b'\n')
        .filter(|_| cut);
    let probe = start.get(..=whole.unwrap_or(start.len())).unwrap_or(&start);
    let layout = Layout::find(probe, encoding, file, &known.hints, known.time);
    let mut lines = Lines::new(Cursor::new(start).chain(text), file);
    let Some(mut layout) = layout else {
        return Err(no_layout(&mut lines, file, &known.hints)?);
    };
    if known.is_sweep {
        layout.time_base = Some(TimeBase::COUNTED);
    }
    let header = Header::new(&layout, file, known.time, known.wanted)?;
    Rows::new(header, &layout).read(&mut lines, file)
}

/// The samples as they come.
struct Rows<'a> {
    header: Header,
    layout: &'a Layout,
    columns: Vec<Vec<f64>>,
    /// The fewest characters in the last cell of a line.
    shortest: usize,
}

/// Why a line holds no row of samples.
enum Bad {
    /// It has so many cells.
    Count(usize),
    /// A cell holds no finite number.
    Cell(usize, String),
}

impl<'a> Rows<'a> {
    fn new(header: Header, layout: &'a Layout) -> Rows<'a> {
        Rows {
            columns: vec![Vec::new(); header.channels.len()],
            header,
            layout,
            shortest: usize::MAX,
        }
    }

    fn read<R: Read>(mut self, lines: &mut Lines<'_, R>, file: &Path) -> Result<Text, TraceError> {
        let dialect = self.layout.dialect;
        let mut splitter = Splitter::new(dialect.separator);
        let mut values: Vec<f64> = Vec::new();
        let mut is_between = false;
        let most = usize::try_from(budget::held() / 8).unwrap_or(usize::MAX);
        while let Some(line) = lines.next_line()? {
            let first = line.split('\t').next().map_or("", str::trim);
            // A LabVIEW measurement has a head before each of its parts.
            let is_names = self.layout.is_labview && first == "X_Value";
            is_between = self.layout.is_labview && (first == "Channels" || is_between && !is_names);
            let cells = splitter.cells(line);
            let (row, time, last) = self.row(cells, dialect.decimal, &mut values);
            if lines.number() <= self.layout.head_end {
                is_between = false;
                continue;
            }
            if is_between || is_names {
                continue;
            }
            let place = || lines.place();
            let time_s = self.header.clock.read(time, &place);
            let is_faulty = row.is_err() || time_s.is_err();
            let is_cut = lines.is_open() && (is_faulty || last.len() < self.shortest);
            if is_cut && self.header.clock.time_s.len() >= LEAST_SAMPLES {
                self.header.remarks.push(format!(
                    "line {} is cut off by the end of the file, and left out",
                    lines.number()
                ));
                break;
            }
            let time_s = time_s?;
            row.map_err(|bad| self.refusal(bad, place()))?;
            self.header.clock.push(time_s, &place)?;
            self.shortest = self.shortest.min(last.len());
            for (column, value) in self.columns.iter_mut().zip(&values) {
                column.push(*value);
            }
            let numbers = self.header.clock.time_s.len() * (self.columns.len() + 1);
            if numbers > most {
                budget::check(file, "what its columns hold", 8 * numbers as u64)?;
            }
        }
        self.finish(file)
    }

    /// The samples of a line into `values`, its time stamp and its last cell.
    fn row<'s>(
        &self,
        cells: impl Iterator<Item = &'s str>,
        decimal: Decimal,
        values: &mut Vec<f64>,
    ) -> (Result<(), Bad>, Option<&'s str>, &'s str) {
        values.clear();
        values.resize(self.columns.len(), f64::NAN);
        let (mut time, mut last, mut found, mut bad) = (None, "", 0, None);
        for (index, cell) in cells.enumerate() {
            found += 1;
            let cell = cell.trim();
            last = cell;
            match self.header.roles.get(index) {
                Some(Role::Time) => time = Some(cell),
                Some(Role::Channel(channel)) => {
                    let number = decimal.number(cell);
                    let value = number.or_else(|| is_missing(cell).then_some(f64::NAN));
                    match (value, values.get_mut(*channel)) {
                        (Some(value), Some(place)) => *place = value,
                        _ => {
                            bad.get_or_insert((index, cell));
                        }
                    }
                }
                Some(Role::Skip) | None => {}
            }
        }
        let row = match bad {
            Some((index, cell)) => Err(Bad::Cell(index, cell.chars().take(40).collect())),
            None if found != self.header.roles.len() => Err(Bad::Count(found)),
            None => Ok(()),
        };
        (row, time, last)
    }

    fn refusal(&self, bad: Bad, line: Place) -> TraceError {
        match bad {
            Bad::Count(found) => TraceError::CellCount {
                place: line,
                found,
                expected: self.header.roles.len(),
            },
            Bad::Cell(index, text) => TraceError::NotANumber {
                place: self.header.place(line, index),
                text,
            },
        }
    }

    /// The recording, its time stamps settled.
    fn finish(mut self, file: &Path) -> Result<Text, TraceError> {
        let clock = self.header.clock;
        let mut remarks = self.header.remarks;
        remarks.extend(clock.remarks);
        let mut time_s = clock.time_s;
        match clock::settle(&time_s, clock.resolution_s) {
            Settled::AsTheyAre => {}
            Settled::Even(even_s, remark) => {
                time_s = even_s;
                remarks.push(remark);
            }
            Settled::Once(places, remark) => {
                let only = |values: &[f64]| -> Vec<f64> {
                    let kept = places.iter().filter_map(|place| values.get(*place));
                    kept.copied().collect()
                };
                time_s = only(&time_s);
                self.columns = self.columns.iter().map(|column| only(column)).collect();
                remarks.push(remark);
            }
            Settled::Refused => {
                let place = clock.repeated.unwrap_or_else(|| Place::file(file));
                return Err(TraceError::TimeRepeated { place });
            }
        }
        if time_s.len() < LEAST_SAMPLES {
            return Err(TraceError::TooFewSamples {
                file: file.to_path_buf(),
                samples: time_s.len(),
                least: LEAST_SAMPLES,
            });
        }
        let channels = self.header.channels.into_iter().zip(self.columns);
        let channels = channels.map(|(column, samples)| Channel {
            name: column.name,
            unit: column.unit,
            samples,
        });
        Ok(Text {
            trace: Trace {
                time_s,
                channels: channels.collect(),
            },
            dialect: self.layout.dialect,
            remarks,
        })
    }
}

/// The text as UTF-8, and what its byte-order mark says it was.
fn decoded<R: Read>(mut source: R) -> std::io::Result<(Encoding, impl Read)> {
    let mut mark = Vec::new();
    source.by_ref().take(3).read_to_end(&mut mark)?;
    let encoding = match mark.as_slice() {
        [0xff, 0xfe, ..] => Encoding::Utf16Le,
        [0xfe, 0xff, ..] => Encoding::Utf16Be,
        _ => Encoding::Utf8,
    };
    let mut decoder = DecodeReaderBytesBuilder::new();
    decoder
        .bom_override(true)
        .utf8_passthru(true)
        .strip_bom(true);
    Ok((encoding, decoder.build(Cursor::new(mark).chain(source))))
}

/// Why no layout was found: there is no text, none at all, or less than the caller said.
fn no_layout<R: Read>(
    lines: &mut Lines<'_, R>,
    file: &Path,
    hints: &Hints,
) -> Result<TraceError, TraceError> {
    let empty = lines.next_line()?.is_none();
    Ok(match hints.header_lines {
        Some(count) if !empty => TraceError::Header {
            place: Place::file(file),
            problem: format!(
                "no line with names stands behind {count} header lines; correct their number or leave it out"
            ),
        },
        _ => TraceError::Empty {
            file: file.to_path_buf(),
            least: LEAST_SAMPLES,
        },
    })
}

#[cfg(test)]
mod tests;
