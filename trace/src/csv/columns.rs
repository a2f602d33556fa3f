//! This file says what the columns of a text file are: names, units, which one is the time, and which are passed over.

use std::collections::HashMap;
use std::path::Path;

use rigproof_spec::units::{Dimension, Unit};

use super::dialect::Kind;
use super::layout::{Layout, Name};
use super::time::Clock;
use crate::error::{Place, TraceError};
use crate::header::{guessed_unit, name_and_unit, stem};
use crate::suggest::{nearest, quoted};

/// Names of a time column, in lower case, without a unit, blanks and marks, and the unit that they say. LabVIEW calls it
/// `X_Value`, a pandas index or a plot tool `__time`, ROS `%time`.
const TIME_NAMES: [(&str, &str); 27] = [
    ("t", ""),
    ("time", ""),
    ("timestamp", ""),
    ("elapsed", ""),
    ("elapsedtime", ""),
    ("timeelapsed", ""),
    ("xvalue", ""),
    ("datetime", ""),
    ("rostime", ""),
    ("zeit", ""),
    ("zeitstempel", ""),
    ("messzeit", ""),
    ("temps", ""),
    ("tiempo", ""),
    ("tempo", ""),
    ("sec", "s"),
    ("secs", "s"),
    ("seconds", "s"),
    ("ms", "ms"),
    ("msec", "ms"),
    ("millis", "ms"),
    ("milliseconds", "ms"),
    ("micros", "us"),
    ("usec", "us"),
    ("microseconds", "us"),
    ("nanos", "ns"),
    ("nanoseconds", "ns"),
];
/// The most names in a remark.
const NAMED: usize = 8;

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
    /// Those that are read, the time not among them.
    pub(super) channels: Vec<Column>,
    /// What is done with each cell of a line.
    pub(super) roles: Vec<Role>,
    pub(super) clock: Clock,
    /// What is to be said of the reading.
    pub(super) remarks: Vec<String>,
}

/// What is done with a cell of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// It is not looked at.
    Skip,
    /// It is the time stamp.
    Time,
    /// It is a sample of this channel.
    Channel(usize),
}

pub(super) struct Column {
    pub(super) name: String,
    pub(super) unit: String,
    /// What stands in the header, unit and all.
    text: String,
    /// The cell of a line, counted from 0.
    pub(super) cell: usize,
    kind: Kind,
    grows: bool,
    counts: bool,
}

impl Column {
    /// The unit that the header states, or else the one that the name suggests.
    fn likely_unit(&self) -> &str {
        match self.unit.as_str() {
            "" => guessed_unit(&self.name),
            stated => stated,
        }
    }

    fn is_called(&self, name: &str) -> bool {
        self.name == name || self.text == name
    }

    /// Whether it may hold time stamps.
    fn may_be_time(&self) -> bool {
        self.kind != Kind::Text
    }
}

impl Header {
    /// The columns of a layout; of the channels only those in `wanted` are read, or all that hold numbers.
    pub(super) fn new(
        layout: &Layout,
        file: &Path,
        time: Option<&TimeColumn>,
        wanted: Option<&[&str]>,
    ) -> Result<Header, TraceError> {
        let place = Place::line(file, layout.names_line);
        let mut columns = columns(&layout.names);
        let mut remarks = Vec::new();
        let counted = layout.time_base.filter(|base| base.has_no_column());
        let index = match (counted, time) {
            (Some(_), _) => None,
            (None, Some(time)) => Some(named_time(&columns, time, layout, &place)?),
            (None, None) => Some(find_time(&columns, layout, &place, &mut remarks)?),
        };
        let mut clock = Clock::counted(layout.time_base, layout.dialect.decimal);
        let mut roles = vec![Role::Skip; layout.names.len()];
        let mut time_column = None;
        if let Some(index) = index {
            let column = columns.remove(index);
            clock = clock.of_column(&column.name, column.cell, layout.dialect.decimal);
            let stated = time.map_or("", |time| time.unit.as_str());
            set_unit(&mut clock, &column, stated, &place, &mut remarks)?;
            if let Some(role) = roles.get_mut(column.cell) {
                *role = Role::Time;
            }
            // LabVIEW repeats the time stamps for each channel.
            columns.retain(|other| other.name != "X_Value" || column.name != "X_Value");
            time_column = Some(column);
        }
        if !layout.has_header {
            remarks.push(format!(
                "there is no header: the columns are called `column 1` to `column {}`",
                layout.names.len()
            ));
        }
        let (channels, passed_over) = chosen(columns, wanted);
        remarks.extend(passed_over);
        check_names(time_column.iter().chain(&channels), &place)?;
        for (channel, column) in channels.iter().enumerate() {
            if let Some(role) = roles.get_mut(column.cell) {
                *role = Role::Channel(channel);
            }
        }
        Ok(Header {
            channels,
            roles,
            clock,
            remarks,
        })
    }

    /// The place of a cell.
    pub(super) fn place(&self, line: Place, cell: usize) -> Place {
        let column = self.channels.iter().find(|column| column.cell == cell);
        column_place(&line, cell, column.map_or("", |column| &column.name))
    }
}

/// Says in which unit the time is.
fn set_unit(
    clock: &mut Clock,
    column: &Column,
    stated: &str,
    place: &Place,
    remarks: &mut Vec<String>,
) -> Result<(), TraceError> {
    let (name, own) = (&column.name, column.likely_unit());
    let said_by_name = || time_name(name).map_or("", |(_, unit)| unit);
    let unit = match (stated, own) {
        ("", "") => said_by_name(),
        ("", own) => own,
        (stated, _) => stated,
    };
    if unit.is_empty() {
        return Ok(());
    }
    let Some(to_s) = time_to_s(unit) else {
        return Err(TraceError::Header {
            place: column_place(place, column.cell, name),
            problem: format!("`{unit}` is no unit of time; use s, ms, us, ns, min or h"),
        });
    };
    if !column.unit.is_empty() && time_to_s(&column.unit) != Some(to_s) {
        remarks.push(format!(
            "the header calls the unit of the time `{name}` `{}`; it is read in `{unit}`, as was said",
            column.unit
        ));
    }
    clock.state_unit(to_s);
    Ok(())
}

/// The columns that may hold samples.
fn columns(names: &[Name]) -> Vec<Column> {
    let named = names.iter().enumerate().filter(|(_, name)| name.kept);
    let columns = named.map(|(cell, head)| {
        let (name, unit) = name_and_unit(&head.text);
        let unit = [head.unit.as_str(), unit]
            .into_iter()
            .find(|unit| !unit.is_empty());
        Column {
            name: name.to_string(),
            unit: unit.unwrap_or_default().to_string(),
            text: head.text.clone(),
            cell,
            kind: head.kind,
            grows: head.grows,
            counts: head.counts,
        }
    });
    columns.collect()
}

/// The channels that are read, and what is to be said of the others.
fn chosen(columns: Vec<Column>, wanted: Option<&[&str]>) -> (Vec<Column>, Vec<String>) {
    let is_wanted = |column: &Column| match wanted {
        Some(names) => names.iter().any(|name| column.is_called(name)),
        None => !column.name.is_empty() && column.kind != Kind::Text && column.kind != Kind::Stamp,
    };
    let (mut chosen, others): (Vec<Column>, Vec<Column>) = columns.into_iter().partition(is_wanted);
    for column in &mut chosen {
        let text = wanted.and_then(|names| names.iter().find(|name| **name == column.text));
        if let Some(text) = text {
            column.name = (*text).to_string();
        }
    }
    let name = |column: &Column| match (column.name.as_str(), column.kind) {
        ("", _) => format!("column {} (no name)", column.cell + 1),
        (name, Kind::Text) => format!("`{name}` (text)"),
        (name, Kind::Stamp) => format!("`{name}` (dates or times)"),
        (name, _) => format!("`{name}`"),
    };
    let names: Vec<String> = others.iter().take(NAMED).map(name).collect();
    let more = match others.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let remark = (!names.is_empty()).then(|| format!("passed over: {}{more}", names.join(", ")));
    (chosen, remark.into_iter().collect())
}

/// Each name is there once.
fn check_names<'a>(
    columns: impl Iterator<Item = &'a Column>,
    place: &Place,
) -> Result<(), TraceError> {
    let mut columns: Vec<&Column> = columns.collect();
    columns.sort_by_key(|column| column.cell);
    let mut seen = HashMap::new();
    for column in &columns {
        if let Some(first) = seen.insert(column.name.as_str(), column.cell) {
            return Err(TraceError::Header {
                place: column_place(place, column.cell, &column.name),
                problem: format!(
                    "the name stands over column {} already; rename one",
                    first + 1
                ),
            });
        }
    }
    Ok(())
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
    cells.len() > 1
        && cells.iter().any(|cell| match time {
            Some(time) => time.name == *cell || time.name == name_and_unit(cell).0,
            None => time_name(name_and_unit(cell).0).is_some(),
        })
}

/// The entry of [`TIME_NAMES`] for a name; letters and digits count.
fn time_name(name: &str) -> Option<&'static (&'static str, &'static str)> {
    let stem = stem(name);
    let plain: String = stem.chars().filter(|c| c.is_alphanumeric()).collect();
    TIME_NAMES.iter().find(|(name, _)| *name == plain)
}

/// The column that the caller calls the time.
fn named_time(
    columns: &[Column],
    time: &TimeColumn,
    layout: &Layout,
    place: &Place,
) -> Result<usize, TraceError> {
    let index = columns
        .iter()
        .position(|column| column.is_called(&time.name));
    index.ok_or_else(|| {
        let names = || columns.iter().map(|column| column.name.as_str());
        let near = nearest(&time.name, names());
        let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        TraceError::Header {
            place: place.clone(),
            problem: only_column(columns, layout).unwrap_or_else(|| {
                format!(
                    "there is no time column `{}`{near}; the columns are {}",
                    time.name,
                    quoted(names())
                )
            }),
        }
    })
}

/// The column of the time: the first that is called so, one with a unit of time before one with another; else the first that
/// is in a unit of time, or holds dates; else the first one without a name, or of a file without names, if it grows.
fn find_time(
    columns: &[Column],
    layout: &Layout,
    place: &Place,
    remarks: &mut Vec<String>,
) -> Result<usize, TraceError> {
    let called_time = |column: &Column| time_name(&column.name).is_some() && column.may_be_time();
    let in_time = |column: &Column| time_to_s(column.likely_unit()).is_some();
    let both = |column: &Column| called_time(column) && in_time(column);
    let stated = |column: &Column| !column.likely_unit().is_empty() && in_time(column);
    let units_row = layout.dialect.units_row;
    let guess = |column: &Column| stated(column) && (units_row || column.grows);
    let dated = |column: &Column| column.kind == Kind::Stamp && column.grows;
    let rules: [&dyn Fn(&Column) -> bool; 4] = [&both, &called_time, &guess, &dated];
    let find = |rule: &&dyn Fn(&Column) -> bool| columns.iter().position(rule);
    if let Some(index) = rules.iter().find_map(find) {
        return Ok(index);
    }
    let may_be = |column: &&Column| {
        let unnamed = column.name.is_empty() || !layout.has_header;
        unnamed && column.grows && (!column.counts || !layout.has_header)
    };
    match columns.first().filter(may_be) {
        Some(column) => {
            let numbered = column.cell + 1;
            remarks.push(format!(
                "column {numbered} has no name; it grows from line to line, so it is taken for the time in s: a guess, which `--time-from` or a header overrules"
            ));
            Ok(0)
        }
        None => Err(TraceError::Header {
            place: place.clone(),
            problem: no_time(columns, layout),
        }),
    }
}

/// A head that is one column was split with the wrong separator.
fn only_column(columns: &[Column], layout: &Layout) -> Option<String> {
    let [only] = columns else {
        return None;
    };
    let split_wrongly = layout.has_header && only.text.contains([',', ';', '\t']);
    split_wrongly.then(|| {
        format!(
            "all of the head is one column, `{}`: the separator is another one; leave --separator away, and it is found",
            only.text
        )
    })
}

fn no_time(columns: &[Column], layout: &Layout) -> String {
    let numbers = |column: &Column| column.text.parse::<f64>().is_ok();
    if columns.iter().all(numbers) || !layout.has_header {
        return "the first line holds numbers, not the names of the columns; put a header over it"
            .into();
    }
    only_column(columns, layout).unwrap_or_else(|| {
        let listed = quoted(columns.iter().map(|column| column.name.as_str()));
        format!(
            "there is no time column; call it `time (s)` or `t_s`, or name it: `--time-from NAME`, in a rig file `time = {{ channel = \"NAME\" }}`; the settled rows of a static sweep need none: `inspect --sweep`, in a rig file `drive = \"static\"`; the columns are {listed}"
        )
    })
}

pub(super) fn column_place(line: &Place, index: usize, name: &str) -> Place {
    Place {
        column: index + 1,
        name: name.to_string(),
        ..line.clone()
    }
}
