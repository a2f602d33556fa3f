//! This file is what a command line says of how a text recording is written down, and what is printed of it.

use std::path::Path;

use rigproof_diagnose::report::ReadAs;
use rigproof_trace::csv::{Decimal, Dialect, Hints, Separator};
use serde_json::{Value, json};

/// What is known of a text recording; the rest is found out and printed.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
#[command(next_help_heading = "Text recordings (found out and printed where not given)")]
pub struct Reading {
    /// What stands between two cells: `,` `;` `tab` or `blank`
    #[arg(long, value_name = "MARK", value_parser = parse_separator)]
    separator: Option<Separator>,
    /// What stands before the fraction of a number: `.` or `,`
    #[arg(long, value_name = "MARK", value_parser = parse_decimal)]
    decimal: Option<Decimal>,
    /// Lines before the line with the names
    #[arg(long, value_name = "COUNT")]
    header_lines: Option<usize>,
}

impl Reading {
    pub fn hints(&self) -> Hints {
        Hints {
            separator: self.separator,
            decimal: self.decimal,
            header_lines: self.header_lines,
        }
    }
}

/// How a file was read, for a person.
pub fn in_words(file: &Path, dialect: &Dialect) -> String {
    format!("{} read as: {dialect}", file.display())
}

/// How a file was read, as in `report.json`.
pub fn in_json(dialect: Dialect) -> Value {
    // Plain words and numbers are always JSON.
    json!(ReadAs::from(dialect))
}

fn parse_separator(text: &str) -> Result<Separator, String> {
    let named = Separator::ALL.into_iter().find(|s| s.name() == text);
    named.ok_or_else(|| "give `,` `;` `tab` or `blank`".to_owned())
}

fn parse_decimal(text: &str) -> Result<Decimal, String> {
    let named = Decimal::ALL.into_iter().find(|d| d.name() == text);
    named.ok_or_else(|| "give `.` or `,`".to_owned())
}
