//! This file says what the columns of a text file are: names, units, and which one is the time.

use std::path::Path;

use rigproof_spec::units::{Dimension, Unit};

use super::layout::{Layout, Name};
use super::read::BadCell;
use crate::error::{Place, TraceError};
use crate::header::{guessed_unit, name_and_unit, stem};
use crate::series::{Channel, Trace};
use crate::suggest::quoted;

/// Names of a time column, in lower case and without a unit; LabVIEW calls it the last.
const TIME_NAMES: [&str; 6] = ["t", "time", "timestamp", "time_stamp", "elapsed", "x_value"];

/// Which column holds the time, where the header alone does not say.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeColumn {
    /// The name in the header.
    pub name: String,
    /// The unit as printed; empty leaves it to the header, and without one there to the second.
    pub unit: String,
}

/// The columns of a recording.
pub(super) struct Header {
    columns: Vec<Column>,
    /// For each cell of a line, whether it holds a sample.
    kept: Vec<bool>,
    /// The column of the time.
    time: usize,
    time_to_s: f64,
    /// Start and step, s, of a time that counts samples.
    sequence: Option<(f64, f64)>,
}

struct Column {
    name: String,
    unit: String,
    /// The cell of a line, counted from 0.
    cell: usize,
}

impl Column {
    /// The unit that the header states, or else the one that the name suggests.
    fn likely_unit(&self) -> &str {
        match self.unit.as_str() {
            "" => guessed_unit(&self.name),
            stated => stated,
        }
    }
}

impl Header {
    pub(super) fn new(
        layout: Layout,
        file: &Path,
        time: Option<&TimeColumn>,
    ) -> Result<Header, TraceError> {
        let place = Place::line(file, layout.names_line);
        let columns = columns(&layout.names, &place)?;
        let index = match time {
            Some(time) => columns.iter().position(|column| column.name == time.name),
            None => find_time(&columns, layout.dialect.units_row),
        };
        let Some((index, column)) = index.and_then(|i| Some((i, columns.get(i)?))) else {
            let problem = no_time(&columns, time);
            return Err(TraceError::Header { place, problem });
        };
        let unit = time
            .map(|column| column.unit.as_str())
            .filter(|unit| !unit.is_empty());
        let unit = unit.unwrap_or(column.likely_unit());
        let Some(time_to_s) = time_to_s(unit) else {
            return Err(TraceError::Header {
                place: column_place(&place, column.cell, &column.name),
                problem: format!("`{unit}` is no unit of time; use s, ms, us, ns, min or h"),
            });
        };
        Ok(Header {
            kept: layout.names.iter().map(|name| name.kept).collect(),
            time: index,
            time_to_s,
            sequence: layout.sequence.filter(|_| index == 0),
            columns,
        })
    }

    /// An empty column for each that is kept.
    pub(super) fn columns(&self) -> Vec<Vec<f64>> {
        vec![Vec::new(); self.columns.len()]
    }

    /// For each cell of a line, whether it holds a sample.
    pub(super) fn kept(&self) -> &[bool] {
        &self.kept
    }

    pub(super) fn no_number(&self, place: Place, cell: BadCell) -> TraceError {
        let column = self.columns.iter().find(|column| column.cell == cell.index);
        let name = column.map_or("", |column| &column.name);
        TraceError::NotANumber {
            place: column_place(&place, cell.index, name),
            text: cell.text,
        }
    }

    /// Converts the time stamp read last to seconds and compares it with the one before.
    pub(super) fn check_time(
        &self,
        columns: &mut [Vec<f64>],
        place: Place,
    ) -> Result<(), TraceError> {
        let Some([before @ .., last]) = columns.get_mut(self.time).map(Vec::as_mut_slice) else {
            return Ok(());
        };
        let place = || match self.columns.get(self.time) {
            Some(column) => column_place(&place, column.cell, &column.name),
            None => place.clone(),
        };
        *last = match self.sequence {
            Some((start_s, step_s)) => start_s + step_s * *last,
            None => *last * self.time_to_s,
        };
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

    pub(super) fn into_trace(self, columns: Vec<Vec<f64>>) -> Trace {
        let mut trace = Trace::default();
        for (index, (column, samples)) in self.columns.into_iter().zip(columns).enumerate() {
            if index == self.time {
                trace.time_s = samples;
            } else {
                trace.channels.push(Channel {
                    name: column.name,
                    unit: column.unit,
                    samples,
                });
            }
        }
        trace
    }
}

/// The columns that hold samples, each with a name of its own.
fn columns(names: &[Name], place: &Place) -> Result<Vec<Column>, TraceError> {
    let mut columns: Vec<Column> = Vec::new();
    for (cell, head) in names.iter().enumerate().filter(|(_, name)| name.kept) {
        let (name, unit) = name_and_unit(&head.text);
        let problem = if name.is_empty() {
            Some("the column has no name; give it one".to_string())
        } else {
            let first = columns.iter().find(|column| column.name == name);
            first.map(|first| {
                let first = first.cell + 1;
                format!("the name stands over column {first} already; rename one")
            })
        };
        if let Some(problem) = problem {
            let place = column_place(place, cell, name);
            return Err(TraceError::Header { place, problem });
        }
        let unit = [head.unit.as_str(), unit]
            .into_iter()
            .find(|unit| !unit.is_empty());
        columns.push(Column {
            name: name.to_string(),
            unit: unit.unwrap_or_default().to_string(),
            cell,
        });
    }
    Ok(columns)
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

/// Whether one of the cells names the time and another one something else.
pub(super) fn has_time(cells: &[String], time: Option<&TimeColumn>) -> bool {
    let mut names = cells.iter().map(|cell| name_and_unit(cell).0);
    cells.len() > 1
        && names.any(|name| match time {
            Some(time) => time.name == name,
            None => is_called_time(name),
        })
}

fn is_called_time(name: &str) -> bool {
    TIME_NAMES.contains(&stem(name).as_str())
}

/// The first column that is called like time, one with a unit of time before one with another; where a row of units
/// says what is what, the first in a unit of time.
fn find_time(columns: &[Column], units_row: bool) -> Option<usize> {
    let called_time = |column: &Column| is_called_time(&column.name);
    let in_time = |column: &Column| time_to_s(column.likely_unit()).is_some();
    let both = |column: &Column| called_time(column) && in_time(column);
    let first = columns.iter().position(both);
    let first = first.or_else(|| columns.iter().position(called_time));
    let stated = |column: &Column| !column.likely_unit().is_empty() && in_time(column);
    first.or_else(|| columns.iter().position(stated).filter(|_| units_row))
}

fn no_time(columns: &[Column], time: Option<&TimeColumn>) -> String {
    let listed = quoted(columns.iter().map(|column| column.name.as_str()));
    if columns
        .iter()
        .all(|column| column.name.parse::<f64>().is_ok())
    {
        return "the first line holds numbers, not the names of the columns; put a header over it"
            .into();
    }
    if let [only] = columns
        && only.name.contains([',', ';', '\t'])
    {
        return format!(
            "all of the head is one column, {listed}: the separator is another one; leave --separator away, and it is found"
        );
    }
    match time {
        Some(column) => format!(
            "there is no time column `{}`; the columns are {listed}",
            column.name
        ),
        None => format!(
            "there is no time column; call it `time (s)` or `t_s`, or name it: `--time-from NAME`, in a rig file `time = {{ channel = \"NAME\" }}`; the columns are {listed}"
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
