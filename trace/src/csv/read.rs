//! This file reads a recording from a comma-separated text file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use rigproof_spec::units::{Dimension, Unit};

use super::lines::{Lines, Splitter};
use crate::error::{Place, TraceError};
use crate::header::{name_and_unit, stem};
use crate::series::{Channel, Trace};
use crate::suggest::quoted;

/// The fewest samples a recording may have: half of them would not carry any conclusion.
pub const LEAST_SAMPLES: usize = 16;

/// Names of a time column, in lower case and without a unit.
const TIME_NAMES: [&str; 5] = ["t", "time", "timestamp", "time_stamp", "elapsed"];

/// Which column holds the time, where the header alone does not say.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeColumn {
    /// The name in the header.
    pub name: String,
    /// The unit as printed; empty leaves it to the header, and without one there to the second.
    pub unit: String,
}

/// Reads a recording; the time column is the first one that is called like time (`t`, `time (ms)`, `t_s`, …).
///
/// Lines that start with `#` are comments, an empty cell is a missing sample (NaN), and steps may be irregular.
///
/// # Errors
/// The file cannot be read, is no text, has no usable header, a cell that holds no finite number, a time stamp
/// that does not grow, or fewer than [`LEAST_SAMPLES`] samples.
pub fn read(path: &Path) -> Result<Trace, TraceError> {
    read_with_time(path, None)
}

/// Reads a recording whose time column is named by the caller; see [`read`].
///
/// # Errors
/// As [`read`].
pub fn read_with_time(path: &Path, time: Option<&TimeColumn>) -> Result<Trace, TraceError> {
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    parse(file, path, time)
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
    let mut lines = Lines::new(source, file);
    let mut splitter = Splitter::new();
    let Some(header) = lines.next_line()? else {
        return Err(TraceError::Empty {
            file: file.to_path_buf(),
            least: LEAST_SAMPLES,
        });
    };
    let cells: Vec<String> = splitter.cells(header).map(str::to_string).collect();
    let header = Header::new(&cells, lines.place(), time)?;
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); cells.len()];
    while let Some(line) = lines.next_line()? {
        let found = read_row(splitter.cells(line), &mut columns)
            .map_err(|cell| header.no_number(lines.place(), cell))?;
        if found != cells.len() {
            return Err(TraceError::CellCount {
                place: lines.place(),
                found,
                expected: cells.len(),
            });
        }
        header.check_time(&mut columns, lines.place())?;
    }
    header.into_trace(columns, file)
}

/// A cell that holds no finite number.
struct BadCell {
    index: usize,
    text: String,
}

/// Appends the cells of a line to the columns and returns how many cells there are.
fn read_row<'s>(
    cells: impl Iterator<Item = &'s str>,
    columns: &mut [Vec<f64>],
) -> Result<usize, BadCell> {
    let mut columns = columns.iter_mut();
    let mut found = 0;
    for (index, cell) in cells.enumerate() {
        found += 1;
        let Some(column) = columns.next() else {
            continue;
        };
        let cell = cell.trim();
        let value = match cell.parse::<f64>() {
            Ok(value) if value.is_finite() => value,
            _ if cell.is_empty() => f64::NAN,
            _ => {
                let text = cell.chars().take(40).collect();
                return Err(BadCell { index, text });
            }
        };
        column.push(value);
    }
    Ok(found)
}

/// The columns of a recording.
struct Header {
    names: Vec<(String, String)>,
    time: usize,
    time_to_s: f64,
}

impl Header {
    fn new(
        cells: &[String],
        place: Place,
        time: Option<&TimeColumn>,
    ) -> Result<Header, TraceError> {
        let mut names: Vec<(String, String)> = Vec::new();
        for (index, cell) in cells.iter().enumerate() {
            let (name, unit) = name_and_unit(cell);
            let problem = if name.is_empty() {
                Some("the column has no name; give it one".to_string())
            } else {
                let first = names.iter().position(|(other, _)| other == name);
                first.map(|first| {
                    format!(
                        "the name stands over column {} already; rename one",
                        first + 1
                    )
                })
            };
            if let Some(problem) = problem {
                let place = column_place(&place, index, name);
                return Err(TraceError::Header { place, problem });
            }
            names.push((name.to_string(), unit.to_string()));
        }
        let index = match time {
            Some(column) => names.iter().position(|(name, _)| *name == column.name),
            None => find_time(&names),
        };
        let Some((index, (name, printed))) = index.and_then(|i| Some((i, names.get(i)?))) else {
            let problem = no_time(&names, time);
            return Err(TraceError::Header { place, problem });
        };
        let unit = time
            .map(|column| column.unit.as_str())
            .filter(|unit| !unit.is_empty());
        let unit = unit.unwrap_or(printed);
        match time_to_s(unit) {
            Some(time_to_s) => Ok(Header {
                time: index,
                time_to_s,
                names,
            }),
            None => Err(TraceError::Header {
                place: column_place(&place, index, name),
                problem: format!("`{unit}` is no unit of time; use s, ms, us, ns, min or h"),
            }),
        }
    }

    fn no_number(&self, place: Place, cell: BadCell) -> TraceError {
        let name = self.names.get(cell.index).map_or("", |(name, _)| name);
        TraceError::NotANumber {
            place: column_place(&place, cell.index, name),
            text: cell.text,
        }
    }

    /// Converts the time stamp read last to seconds and compares it with the one before.
    fn check_time(&self, columns: &mut [Vec<f64>], place: Place) -> Result<(), TraceError> {
        let Some([before @ .., last]) = columns.get_mut(self.time).map(Vec::as_mut_slice) else {
            return Ok(());
        };
        let name = self.names.get(self.time).map_or("", |(name, _)| name);
        let place = || column_place(&place, self.time, name);
        *last *= self.time_to_s;
        let time_s = *last;
        if time_s.is_nan() {
            return Err(TraceError::TimeMissing { place: place() });
        }
        match before.last() {
            Some(&previous_s) if time_s <= previous_s => Err(TraceError::TimeOrder {
                place: place(),
                time_s,
                previous_s,
                motion: if time_s < previous_s {
                    "goes backward"
                } else {
                    "is repeated"
                },
            }),
            _ => Ok(()),
        }
    }

    fn into_trace(self, columns: Vec<Vec<f64>>, file: &Path) -> Result<Trace, TraceError> {
        let mut trace = Trace::default();
        for (index, ((name, unit), samples)) in self.names.into_iter().zip(columns).enumerate() {
            if index == self.time {
                trace.time_s = samples;
            } else {
                trace.channels.push(Channel {
                    name,
                    unit,
                    samples,
                });
            }
        }
        if trace.len() < LEAST_SAMPLES {
            return Err(TraceError::TooFewSamples {
                file: file.to_path_buf(),
                samples: trace.len(),
                least: LEAST_SAMPLES,
            });
        }
        Ok(trace)
    }
}

/// Seconds in a unit of time; a time without a unit is in seconds.
pub(crate) fn time_to_s(unit: &str) -> Option<f64> {
    if unit.is_empty() {
        return Some(1.0);
    }
    Unit::parse(unit)
        .filter(|unit| unit.dimension == Dimension::TIME)
        .map(|unit| unit.to_si)
}

/// The first column that is called like time, one with a unit of time before one with another.
fn find_time(names: &[(String, String)]) -> Option<usize> {
    let called_time = |(name, _): &(String, String)| TIME_NAMES.contains(&stem(name).as_str());
    let in_time = |column: &(String, String)| called_time(column) && time_to_s(&column.1).is_some();
    let first = names.iter().position(in_time);
    first.or_else(|| names.iter().position(called_time))
}

fn no_time(names: &[(String, String)], time: Option<&TimeColumn>) -> String {
    let listed = quoted(names.iter().map(|(name, _)| name.as_str()));
    if names.iter().all(|(name, _)| name.parse::<f64>().is_ok()) {
        return "the first line holds numbers, not the names of the columns; put a header over it"
            .into();
    }
    match time {
        Some(column) => format!(
            "there is no time column `{}`; the columns are {listed}",
            column.name
        ),
        None => format!(
            "there is no time column; call it `time (s)` or `t_s`; the columns are {listed}"
        ),
    }
}

fn column_place(line: &Place, index: usize, name: &str) -> Place {
    Place {
        column: index + 1,
        name: name.to_string(),
        ..line.clone()
    }
}

#[cfg(test)]
mod tests;
