//! This file knows the loggers that write no column of time stamps: LabVIEW and Rigol.

use super::layout::Name;
use super::table::Table;

/// A time that counts samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeBase {
    pub(super) start_s: f64,
    pub(super) step_s: f64,
    /// Whether a column counts the samples; else they are counted as they come.
    has_column: bool,
}

impl TimeBase {
    /// Rows without a time, counted from 0, one a second.
    pub(super) const COUNTED: TimeBase = TimeBase {
        start_s: 0.0,
        step_s: 1.0,
        has_column: false,
    };

    /// Whether the rows are counted as they come.
    pub(super) fn has_no_column(&self) -> bool {
        !self.has_column
    }
}

/// The time base of a file that states one instead of time stamps.
pub(super) fn time_base(
    table: &Table,
    names: &[Name],
    units: Option<&[String]>,
) -> Option<TimeBase> {
    rigol(table, names, units).or_else(|| labview(table))
}

/// Start and step of a Rigol's time, which counts samples: they stand in the units row.
fn rigol(table: &Table, names: &[Name], units: Option<&[String]>) -> Option<TimeBase> {
    let units = units.filter(|cells| cells.first().is_some_and(|c| c == "Sequence"))?;
    let head = table.rows().find(|cells| {
        cells.first().map(String::as_str) == names.first().map(|name| name.text.as_str())
    })?;
    let number = |name: &str| {
        let column = head.iter().position(|text| text == name)?;
        table.decimal.number(units.get(column)?)
    };
    Some(TimeBase {
        start_s: number("Start")?,
        step_s: number("Increment")?,
        has_column: true,
    })
}

/// Start and step of a LabVIEW measurement without a column of time: they stand in the head.
fn labview(table: &Table) -> Option<TimeBase> {
    let entry = |key: &str| {
        let mut rows = table.rows();
        let row = rows.find(|cells| cells.first().is_some_and(|cell| cell == key))?;
        row.get(1).cloned()
    };
    let number = |key: &str| table.decimal.number(&entry(key)?);
    is_labview(table).then_some(())?;
    entry("X_Columns").filter(|columns| columns == "No")?;
    Some(TimeBase {
        start_s: number("X0").unwrap_or(0.0),
        step_s: number("Delta_X")?,
        has_column: false,
    })
}

/// Whether the file is a LabVIEW measurement.
pub(super) fn is_labview(table: &Table) -> bool {
    let first = table.cells(0).and_then(<[String]>::first);
    first.is_some_and(|cell| cell.starts_with("LabVIEW Measurement"))
}

/// Of a LabVIEW measurement without time stamps: the column is empty, or only its name is left.
pub(super) fn leave_out_stamps(table: &Table, names: &mut Vec<Name>) {
    let is_stamp = names.first().is_some_and(|name| name.text == "X_Value");
    let is_empty = table
        .run_rows()
        .all(|cells| cells.first().is_none_or(String::is_empty));
    match (is_stamp, is_empty) {
        (_, true) => {
            if let Some(first) = names.first_mut() {
                first.kept = false;
            }
        }
        (true, false) => {
            names.remove(0);
        }
        (false, false) => {}
    }
}
