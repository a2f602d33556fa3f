//! This file reads a recording from a text file, in whatever dialect its logger writes.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use encoding_rs_io::DecodeReaderBytesBuilder;

use super::columns::{Header, TimeColumn};
use super::dialect::{Decimal, Dialect, Encoding, Hints};
use super::layout::{Layout, TAG};
use super::lines::{Lines, Splitter};
use crate::error::{Place, TraceError};
use crate::series::Trace;

/// The fewest samples a recording may have: half of them would not carry any conclusion.
pub const LEAST_SAMPLES: usize = 16;
/// How much of a file is looked at to find out its dialect, bytes.
const PROBE: u64 = 1 << 20;

/// Reads a recording; the time column is the first one that is called like time (`t`, `time (ms)`, `t_s`, …).
///
/// Lines that start with `#` are comments, an empty cell is a missing sample (NaN), and steps may be irregular.
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
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    parse_as(file, path, time, hints)
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
    let refused = || TraceError::io("read", file);
    let (encoding, mut text) = decoded(source).map_err(refused())?;
    let mut start = Vec::new();
    text.by_ref()
        .take(PROBE)
        .read_to_end(&mut start)
        .map_err(refused())?;
    // A line that is cut says nothing about the file.
    let cut = start.len() as u64 == PROBE;
    let whole = start
        .iter()
        .rposition(|byte| *byte == b'\n')
        .filter(|_| cut);
    let probe = start.get(..=whole.unwrap_or(start.len())).unwrap_or(&start);
    let layout = Layout::find(probe, encoding, file, hints, time);
    let mut lines = Lines::new(Cursor::new(start).chain(text), file);
    let Some(layout) = layout else {
        return Err(no_layout(&mut lines, file, hints)?);
    };
    let dialect = layout.dialect;
    while lines.number() < layout.head_end && lines.next_line()?.is_some() {}
    let header = Header::new(layout, file, time)?;
    let mut splitter = Splitter::new(dialect.separator);
    let mut columns = header.columns();
    while let Some(line) = lines.next_line()? {
        let found = read_row(
            splitter.cells(line),
            dialect.decimal,
            header.kept(),
            &mut columns,
        )
        .map_err(|cell| header.no_number(lines.place(), cell))?;
        let expected = header.kept().len();
        if found != expected {
            return Err(TraceError::CellCount {
                place: lines.place(),
                found,
                expected,
            });
        }
        header.check_time(&mut columns, lines.place())?;
    }
    let trace = header.into_trace(columns);
    if trace.len() < LEAST_SAMPLES {
        return Err(TraceError::TooFewSamples {
            file: file.to_path_buf(),
            samples: trace.len(),
            least: LEAST_SAMPLES,
        });
    }
    Ok((trace, dialect))
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

/// A cell that holds no finite number.
pub(super) struct BadCell {
    pub(super) index: usize,
    pub(super) text: String,
}

/// Appends the cells of a line to the columns that are kept and returns how many cells there are.
fn read_row<'s>(
    cells: impl Iterator<Item = &'s str>,
    decimal: Decimal,
    kept: &[bool],
    columns: &mut [Vec<f64>],
) -> Result<usize, BadCell> {
    let mut columns = columns.iter_mut();
    let mut found = 0;
    for (index, cell) in cells.enumerate() {
        found += 1;
        let Some(kept) = kept.get(index) else {
            continue;
        };
        let cell = cell.trim();
        let value = match decimal.number(cell) {
            Some(value) if *kept => value,
            None if cell.is_empty() => f64::NAN,
            None if !kept && cell == TAG => f64::NAN,
            _ => {
                let text = cell.chars().take(40).collect();
                return Err(BadCell { index, text });
            }
        };
        if *kept && let Some(column) = columns.next() {
            column.push(value);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests;
