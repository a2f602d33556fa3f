//! This file writes what an experiment computed as a table of its own, with a unit over every column.

use crate::Error;

/// A table: columns of equal length.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The file's name without its ending: lower case, digits and hyphens.
    pub name: String,
    /// The columns; a run over time has the time first, as `Table::run` puts it.
    pub columns: Vec<Column>,
}

/// One column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// What it holds.
    pub name: String,
    /// Its unit; empty for words and plain numbers.
    pub unit: String,
    /// One cell a row.
    pub cells: Cells,
}

/// The cells of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Numbers; NaN is written as an empty cell.
    Numbers(Vec<f64>),
    /// Words.
    Words(Vec<String>),
}

impl Table {
    /// A table of columns.
    pub fn new(name: impl Into<String>, columns: Vec<Column>) -> Table {
        Table {
            name: name.into(),
            columns,
        }
    }

    /// A run: the time, s, and what was computed at it. It reads back as a recording.
    pub fn run(name: impl Into<String>, time_s: &[f64], signals: Vec<Column>) -> Table {
        let mut columns = vec![Column::numbers("time", "s", time_s)];
        columns.extend(signals);
        Table::new(name, columns)
    }

    /// The bytes of its file: a header `name (unit)`, and the shortest digits that read back as the same number.
    ///
    /// # Errors
    /// The columns are of different length, or a header would not read back.
    pub fn to_csv(&self) -> Result<Vec<u8>, Error> {
        let refused = |problem: String| Error::Table {
            table: self.name.clone(),
            problem,
        };
        let rows = self.columns.first().map_or(0, |column| column.cells.len());
        let mut headers = Vec::new();
        for Column { name, unit, cells } in &self.columns {
            let found = cells.len();
            if found != rows {
                return Err(refused(format!(
                    "the column `{name}` has {found} cells, the first has {rows}; they must be equal"
                )));
            }
            let header = rigproof_trace::header::header(name, unit);
            headers.push(header.ok_or_else(|| {
                refused(format!("the header `{name} ({unit})` would not read back"))
            })?);
        }
        let mut file = csv::Writer::from_writer(Vec::new());
        let failed = |error: csv::Error| refused(error.to_string());
        file.write_record(&headers).map_err(failed)?;
        for row in 0..rows {
            let cells = self.columns.iter().map(|column| column.cells.text(row));
            file.write_record(cells).map_err(failed)?;
        }
        file.into_inner()
            .map_err(|error| refused(error.to_string()))
    }
}

impl Column {
    /// A column of numbers.
    pub fn numbers(name: impl Into<String>, unit: &str, values: &[f64]) -> Column {
        Column {
            name: name.into(),
            unit: unit.to_owned(),
            cells: Cells::Numbers(values.to_vec()),
        }
    }

    /// A column of words.
    pub fn words<W: ToString>(name: impl Into<String>, words: &[W]) -> Column {
        Column {
            name: name.into(),
            unit: String::new(),
            cells: Cells::Words(words.iter().map(W::to_string).collect()),
        }
    }
}

impl Cells {
    fn len(&self) -> usize {
        match self {
            Cells::Numbers(values) => values.len(),
            Cells::Words(words) => words.len(),
        }
    }

    fn text(&self, row: usize) -> String {
        match self {
            Cells::Numbers(values) => match values.get(row) {
                Some(value) if value.is_finite() => format!("{value:?}"),
                _ => String::new(),
            },
            Cells::Words(words) => words.get(row).cloned().unwrap_or_default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_reads_back_as_a_recording() {
        let time_s: Vec<f64> = (0..23).map(|k| 0.013 * f64::from(k)).collect();
        let torque: Vec<f64> = time_s.iter().map(|t| 1.7 * t - 0.3).collect();
        let run = Table::run(
            "step",
            &time_s,
            vec![Column::numbers("torque", "N·m", &torque)],
        );
        let bytes = run.to_csv().unwrap();
        let name = std::path::Path::new("step.csv");
        let trace = rigproof_trace::csv::parse(bytes.as_slice(), name, None).unwrap();
        assert_eq!(trace.time_s, time_s);
        assert_eq!(trace.channel("torque").unwrap().samples, torque);
    }

    #[test]
    fn columns_of_different_length_are_refused() {
        let table = Table::new(
            "gain",
            vec![
                Column::words("brake", &["A", "E"]),
                Column::numbers("gain", "N·m", &[1.3]),
            ],
        );
        let message = table.to_csv().unwrap_err().to_string();
        assert!(
            message.contains("`gain` has 1 cells, the first has 2"),
            "{message}"
        );
    }
}
