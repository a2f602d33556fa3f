//! This file is what a command line says of how a text recording is written down, and what is printed of it.

use std::path::Path;

use rigproof_diagnose::report::ReadAs;
use rigproof_spec::units::Unit;
use rigproof_trace::csv::{Decimal, Dialect, Hints, Separator};
use serde_json::{Value, json};

/// Where the options of a text recording stand in the help. Each names it: a heading of the whole group would take in what follows.
const HEADING: &str = "Text recordings (found out and printed where not given)";

/// What is known of a text recording; the rest is found out and printed.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Reading {
    /// What stands between two cells: `,` `;` `tab` or `blank`
    #[arg(long, value_name = "MARK", value_parser = parse_separator, help_heading = HEADING)]
    separator: Option<Separator>,
    /// What stands before the fraction of a number: `.` or `,`
    #[arg(long, value_name = "MARK", value_parser = parse_decimal, help_heading = HEADING)]
    decimal: Option<Decimal>,
    /// Lines before the line with the names
    #[arg(long, value_name = "COUNT", help_heading = HEADING)]
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

/// How a recording of a rig is read.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct RigReading {
    #[command(flatten)]
    text: Reading,
    /// The unit that a column is in, whatever its header says
    #[arg(long = "unit", value_name = "NAME=UNIT", value_parser = parse_unit, help_heading = HEADING)]
    units: Vec<(String, String)>,
}

impl RigReading {
    pub fn hints(&self) -> Hints {
        self.text.hints()
    }

    /// What the command line says of the units of columns.
    pub fn units(&self) -> &[(String, String)] {
        &self.units
    }
}

/// A name and its unit.
pub fn parse_unit(text: &str) -> Result<(String, String), String> {
    // A name may hold the mark itself, as `/joint_states.position[name=elbow]` does; a unit does not.
    let (name, unit) = text
        .rsplit_once('=')
        .ok_or("write NAME=UNIT, such as u=N")?;
    match Unit::parse(unit) {
        Some(_) => Ok((name.to_string(), unit.to_string())),
        None => Err(format!("`{unit}` is no known unit")),
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
