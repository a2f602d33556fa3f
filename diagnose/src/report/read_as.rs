//! This file is how a text recording was read, with the fields of `report.json`.

use rigproof_trace::csv::Dialect;
use serde::Serialize;

/// The dialect of a text recording.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ReadAs {
    /// `,`, `;`, `tab` or `blank`.
    pub separator: &'static str,
    /// `.` or `,`.
    pub decimal: &'static str,
    /// Lines before the line with the names.
    pub header_lines: usize,
    /// Whether a row of units stands below the names.
    pub units_row: bool,
    /// `UTF-8`, or `UTF-16` and its order of bytes.
    pub encoding: &'static str,
}

impl From<Dialect> for ReadAs {
    fn from(dialect: Dialect) -> ReadAs {
        ReadAs {
            separator: dialect.separator.name(),
            decimal: dialect.decimal.name(),
            header_lines: dialect.header_lines,
            units_row: dialect.units_row,
            encoding: dialect.encoding.name(),
        }
    }
}
