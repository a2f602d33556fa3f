//! This file is a table of a case: columns with units, a row a time or a run, every number in ten digits.

use rigproof_trace::header::{header, name_and_unit};

use crate::Error;

/// The column that says to which run a row belongs.
pub const RUN: &str = "run";

/// A table as it stands in `input.csv` or `expected.csv`: cells are text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Name and unit of each column; the unit is empty for words and whole numbers.
    pub columns: Vec<(String, String)>,
    /// The rows, each as long as `columns`.
    pub rows: Vec<Vec<String>>,
}

/// A number as C's `%.9e` prints it: ten digits, a sign and at least two digits of exponent; zero has no sign.
pub fn number(value: f64) -> String {
    let text = format!("{:.9e}", value + 0.0);
    match text.split_once('e') {
        Some((digits, exponent)) => {
            let (sign, exponent) = match exponent.strip_prefix('-') {
                Some(exponent) => ('-', exponent),
                None => ('+', exponent),
            };
            format!("{digits}e{sign}{exponent:0>2}")
        }
        None => text,
    }
}

impl Table {
    /// A table without rows.
    pub fn new(columns: &[(&str, &str)]) -> Table {
        let owned = |(name, unit): &(&str, &str)| ((*name).to_owned(), (*unit).to_owned());
        Table {
            columns: columns.iter().map(owned).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row: the number of its run, then numbers.
    pub fn push(&mut self, run: usize, numbers: &[f64]) {
        let numbers = numbers.iter().map(|value| number(*value));
        let row = std::iter::once(run.to_string()).chain(numbers);
        self.rows.push(row.collect());
    }

    /// Adds whole numbers or words to the last row.
    pub fn extend<W: ToString>(&mut self, words: impl IntoIterator<Item = W>) {
        if let Some(row) = self.rows.last_mut() {
            row.extend(words.into_iter().map(|word| word.to_string()));
        }
    }

    /// The place of a column.
    pub fn place(&self, column: &str) -> Option<usize> {
        self.columns.iter().position(|(name, _)| name == column)
    }

    /// The cells of a column in the rows of a run.
    ///
    /// # Errors
    /// There is no such column.
    pub fn words(&self, run: usize, column: &str) -> Result<Vec<&str>, Error> {
        let missing = |name: &str| Error::Table(format!("there is no column `{name}`"));
        let place = self.place(column).ok_or_else(|| missing(column))?;
        let of = self.place(RUN).ok_or_else(|| missing(RUN))?;
        let run = run.to_string();
        let rows = self.rows.iter().filter(|row| row.get(of) == Some(&run));
        Ok(rows
            .filter_map(|row| row.get(place))
            .map(String::as_str)
            .collect())
    }

    /// The numbers of a column in the rows of a run.
    ///
    /// # Errors
    /// There is no such column, or a cell is no number.
    pub fn numbers(&self, run: usize, column: &str) -> Result<Vec<f64>, Error> {
        let words = self.words(run, column)?.into_iter();
        words
            .map(|word| {
                let value: Result<f64, _> = word.parse();
                value.map_err(|_| {
                    Error::Table(format!("the column `{column}` holds `{word}`, no number"))
                })
            })
            .collect()
    }

    /// The text of the file.
    ///
    /// # Errors
    /// A row has another length than the heading, or a heading would not read back.
    pub fn to_csv(&self) -> Result<Vec<u8>, Error> {
        let failed = |error: csv::Error| Error::Table(error.to_string());
        let mut file = csv::Writer::from_writer(Vec::new());
        let mut headings = Vec::new();
        for (name, unit) in &self.columns {
            let heading = header(name, unit);
            headings.push(heading.ok_or_else(|| {
                Error::Table(format!("the heading `{name} ({unit})` would not read back"))
            })?);
        }
        file.write_record(&headings).map_err(failed)?;
        for row in &self.rows {
            file.write_record(row).map_err(failed)?;
        }
        file.into_inner()
            .map_err(|error| Error::Table(error.to_string()))
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// It is no comma-separated text, or a row is longer or shorter than the heading.
    pub fn parse(bytes: &[u8]) -> Result<Table, Error> {
        let failed = |error: csv::Error| Error::Table(error.to_string());
        let mut file = csv::Reader::from_reader(bytes);
        let headings = file.headers().map_err(failed)?;
        let columns = headings.iter().map(name_and_unit);
        let columns = columns.map(|(name, unit)| (name.to_owned(), unit.to_owned()));
        let columns = columns.collect();
        let rows = file
            .records()
            .map(|record| Ok(record?.iter().map(str::to_owned).collect()))
            .collect::<Result<_, _>>()
            .map_err(failed)?;
        Ok(Table { columns, rows })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_written_as_c_writes_it() {
        for (value, expected) in [
            (0.031_415_926_535, "3.141592653e-02"),
            (-6.02e23, "-6.020000000e+23"),
            (7.3e-123, "7.300000000e-123"),
            (-0.0, "0.000000000e+00"),
        ] {
            assert_eq!(number(value), expected);
        }
    }

    #[test]
    fn a_table_reads_back_as_it_was_written() {
        let mut table = Table::new(&[
            (RUN, ""),
            ("time", "s"),
            ("held_a", ""),
            ("torque_a", "N·m"),
        ]);
        table.push(3, &[0.017]);
        table.extend([1]);
        table.extend([number(-2.9)]);
        assert_eq!(Table::parse(&table.to_csv().unwrap()).unwrap(), table);
        assert_eq!(table.numbers(3, "torque_a").unwrap(), [-2.9]);
        assert!(table.numbers(2, "torque_a").unwrap().is_empty());
        assert!(table.numbers(3, "force").is_err());
    }
}
