//! This file is the manifest of a case: what is in its folder, from what, and what that must show.

use std::fmt::Write as _;
use std::path::Path;

use serde::Deserialize;
use sha2::{Digest, Sha256};

use crate::Error;
use crate::case::{Case, Parameter, Value};
use crate::claim::{Claim, Shows};
use crate::table::Table;

/// The manifest's file.
pub const MANIFEST: &str = "manifest.toml";
/// What goes into the model.
pub const INPUT: &str = "input.csv";
/// What the model made of it.
pub const EXPECTED: &str = "expected.csv";

/// A manifest that was read.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// What the case is for.
    pub purpose: String,
    /// The command that writes it.
    pub producer: String,
    /// Where the thesis speaks of it.
    pub citations: Vec<String>,
    /// Step in which the model is run.
    pub step: Quantity,
    /// Time between the rows of `expected.csv`.
    pub rows: Quantity,
    /// What holds for every run.
    pub parameters: Vec<Entry>,
    /// The columns of both files.
    pub columns: Vec<Column>,
    /// The files, with the sha256 of their bytes.
    pub files: Vec<File>,
    /// The runs.
    pub run: Vec<Described>,
    /// What the files must contain.
    pub must_show: Vec<Claim>,
}

/// A number with a unit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: String,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// A number or a word.
    pub value: toml::Value,
    /// The unit of a number.
    pub unit: Option<String>,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// The file it stands in.
    pub file: String,
    /// Its name.
    pub name: String,
    /// Its unit, if it holds numbers that have one.
    pub unit: Option<String>,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Its name.
    pub name: String,
    /// The sha256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Described {
    /// Its number in the column `run`.
    pub number: usize,
    /// What happens.
    pub what: String,
    /// Its parameters.
    pub parameters: Vec<Entry>,
}

/// The sha256 of bytes, in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Reads the manifest of a case.
///
/// # Errors
/// [`Error::Damaged`]: it is no manifest.
pub fn parse(text: &str, file: &Path, case: &str) -> Result<Manifest, Error> {
    toml::from_str(text).map_err(|error| {
        let place = error.span().map_or_else(String::new, |span| {
            let before = text.get(..span.start).unwrap_or(text);
            format!("line {}: ", before.matches('\n').count() + 1)
        });
        Error::Damaged {
            file: file.to_path_buf(),
            case: case.to_owned(),
            problem: format!("{place}{}", error.message().replace('\n', " ")),
        }
    })
}

/// The manifest of a case whose files are `tables`, each with its name and its bytes.
pub fn text(case: &Case, tables: &[(&str, &Table, &[u8])]) -> String {
    let citations = case.citations.iter().map(|place| quoted(place));
    let citations: Vec<String> = citations.collect();
    let columns = tables.iter().flat_map(|(file, table, _)| {
        table.columns.iter().map(|(name, unit)| {
            format!(
                "{{ file = {}, name = {}{} }}",
                quoted(file),
                quoted(name),
                unit_of(unit)
            )
        })
    });
    let files = tables.iter().map(|(name, _, bytes)| {
        format!(
            "{{ name = {}, sha256 = {} }}",
            quoted(name),
            quoted(&sha256(bytes))
        )
    });
    let mut text = format!(
        "# Written by the producer below; a change of a number is a commit of its own that says which equation moved.\n\
         purpose = {}\nproducer = {}\ncitations = [{}]\n\
         step = {{ value = {:?}, unit = \"s\" }}\nrows = {{ value = {:?}, unit = \"s\" }}\n",
        quoted(&case.purpose),
        quoted(&command(&case.name)),
        citations.join(", "),
        case.step_s,
        case.rows_s,
    );
    text += &list("parameters", case.parameters.iter().map(entry));
    text += &list("columns", columns);
    text += &list("files", files);
    for (index, run) in case.runs.iter().enumerate() {
        let (number, what) = (index + 1, quoted(&run.what));
        text += &format!("\n[[run]]\nnumber = {number}\nwhat = {what}\n");
        text += &list("parameters", run.parameters.iter().map(entry));
    }
    for claim in &case.must_show {
        let run = claim.run.map(|run| format!("run = {run}\n"));
        text += &format!(
            "\n[[must_show]]\nsays = {}\n{}column = {}\nshows = {{ {} }}\n",
            quoted(&claim.says),
            run.unwrap_or_default(),
            quoted(&claim.column),
            shows(&claim.shows),
        );
    }
    text
}

/// The command that writes a case.
pub fn command(case: &str) -> String {
    format!("rigproof golden regenerate {case}")
}

fn list(name: &str, items: impl Iterator<Item = String>) -> String {
    let items: String = items.map(|item| format!("    {item},\n")).collect();
    format!("{name} = [\n{items}]\n")
}

fn entry(parameter: &Parameter) -> String {
    let value = match &parameter.value {
        Value::Number(value) => format!("{value:?}"),
        Value::Word(word) => quoted(word),
    };
    let unit = unit_of(parameter.unit);
    format!(
        "{{ name = {}, value = {value}{unit} }}",
        quoted(parameter.name)
    )
}

fn unit_of(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(", unit = {}", quoted(unit))
    }
}

fn shows(shows: &Shows) -> String {
    match shows {
        Shows::Reaches(value) => format!("reaches = {value:?}"),
        Shows::EndsWithin(value) => format!("ends_within = {value:?}"),
        Shows::Spans(value) => format!("spans = {value:?}"),
        Shows::Lasts(least) => format!("lasts = {least}"),
        Shows::SignChanges(least) => format!("sign_changes = {least}"),
        Shows::Changes(least) => format!("changes = {least}"),
        Shows::Has(word) => format!("has = {}", quoted(word)),
    }
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}
