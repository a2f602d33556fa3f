//! This file compares the cases on disk with what the model computes now.

use std::collections::BTreeSet;
use std::io;
use std::path::Path;

use rigproof_trace::TraceError;

use crate::Error;
use crate::case::Case;
use crate::manifest::{EXPECTED, INPUT, MANIFEST, Manifest, command, parse, sha256};
use crate::regenerate::{check_folder, computed};
use crate::table::{RUN, Table};

/// Something in the folder of a case that is not as it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The case.
    pub case: String,
    /// The file.
    pub file: String,
    /// What is wrong, in words.
    pub problem: String,
    /// The first cell that differs, if it is a cell.
    pub cell: Option<Cell>,
    /// The command that makes it right, where a command can.
    pub command: Option<String>,
}

/// A cell that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The run it belongs to.
    pub run: String,
    /// Its row, counted from one below the heading.
    pub row: usize,
    /// Its column.
    pub column: String,
    /// The unit of the column; empty when it has none.
    pub unit: String,
    /// What stands in the file.
    pub found: String,
    /// What the model computes.
    pub computed: String,
}

/// Compares one case with its folder below `cases`: hashes, manifest, every cell, what the files must show, foreign files.
///
/// # Errors
/// [`Error::Damaged`] for a manifest that is none; [`Error::NoFolder`]; the model or the system refuses.
pub fn check(case: &Case, cases: &Path) -> Result<Vec<Difference>, Error> {
    check_folder(cases)?;
    let folder = cases.join(&case.name);
    let mut differences = Vec::new();
    let mut report = |file: &str, problem: String, cell: Option<Cell>| {
        differences.push(Difference {
            case: case.name.clone(),
            file: file.to_owned(),
            problem,
            cell,
            command: Some(command(&case.name)),
        });
    };
    let missing = || "the file is missing".to_owned();
    let Some(bytes) = read(&folder.join(MANIFEST))? else {
        report(MANIFEST, missing(), None);
        return Ok(differences);
    };
    let found = String::from_utf8_lossy(&bytes);
    let manifest = parse(&found, &folder.join(MANIFEST), &case.name)?;
    let computed = computed(case)?;
    let mut tables = Vec::new();
    for (file, computed) in [(INPUT, &computed.input), (EXPECTED, &computed.expected)] {
        let Some(bytes) = read(&folder.join(file))? else {
            report(file, missing(), None);
            continue;
        };
        if let Some(problem) = other_hash(&manifest, file, &bytes) {
            report(file, problem, None);
        }
        match Table::parse(&bytes) {
            Ok(found) => {
                if let Some((problem, cell)) = apart(&found, computed) {
                    report(file, problem, cell);
                }
                tables.push(found);
            }
            Err(error) => report(file, format!("it is no table: {error}"), None),
        }
    }
    if let [input, expected] = tables.as_slice() {
        for claim in &manifest.must_show {
            for problem in claim.missing(case.runs.len(), input, expected) {
                report(EXPECTED, problem, None);
            }
        }
    }
    let [(_, text), ..] = &computed.files;
    if let Some(problem) = other_line(&found, &String::from_utf8_lossy(text)) {
        report(MANIFEST, problem, None);
    }
    Ok(differences)
}

/// Everything below `cases` that belongs to no case.
///
/// # Errors
/// [`Error::NoFolder`], or the system refuses.
pub fn orphans(known: &[Case], cases: &Path) -> Result<Vec<Difference>, Error> {
    check_folder(cases)?;
    let known: BTreeSet<&str> = known.iter().map(|case| case.name.as_str()).collect();
    let mut found = Vec::new();
    let orphan = |case: &str, file: String| Difference {
        case: case.to_owned(),
        file,
        problem: "no case writes it: delete it, or add its case to the room golden".to_owned(),
        cell: None,
        command: None,
    };
    for name in names(cases)? {
        if !known.contains(name.as_str()) {
            found.push(orphan(&name, String::new()));
            continue;
        }
        for file in names(&cases.join(&name))? {
            if ![MANIFEST, INPUT, EXPECTED].contains(&file.as_str()) {
                found.push(orphan(&name, file));
            }
        }
    }
    Ok(found)
}

/// The names in a folder, in their order.
fn names(folder: &Path) -> Result<BTreeSet<String>, Error> {
    let entries = std::fs::read_dir(folder).and_then(|entries| {
        let name = |entry: io::Result<std::fs::DirEntry>| {
            Ok(entry?.file_name().to_string_lossy().into_owned())
        };
        entries.map(name).collect::<io::Result<BTreeSet<String>>>()
    });
    Ok(entries.map_err(refused(folder))?)
}

/// The bytes of a file, or `None` when it is not there.
fn read(path: &Path) -> Result<Option<Vec<u8>>, Error> {
    match std::fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(refused(path)(error).into()),
    }
}

fn refused(path: &Path) -> impl FnOnce(io::Error) -> TraceError {
    let path = path.to_path_buf();
    move |source| TraceError::File {
        action: "read",
        path,
        source,
    }
}

/// Whether the bytes of a file have another hash than its manifest says.
fn other_hash(manifest: &Manifest, file: &str, bytes: &[u8]) -> Option<String> {
    let found = sha256(bytes);
    let said = manifest.files.iter().find(|entry| entry.name == file);
    match said {
        None => Some("the manifest does not name the file".to_owned()),
        Some(entry) if entry.sha256 == found => None,
        Some(entry) => Some(format!(
            "its sha256 is {found}, the manifest says {}",
            entry.sha256
        )),
    }
}

/// The first line in which two manifests differ.
fn other_line(found: &str, computed: &str) -> Option<String> {
    let (mut found, mut computed) = (found.lines(), computed.lines());
    for number in 1.. {
        match (found.next(), computed.next()) {
            (None, None) => break,
            (ours, theirs) if ours == theirs => {}
            (ours, theirs) => {
                let said = |line: Option<&str>| {
                    line.map_or("nothing".to_owned(), |line| format!("`{line}`"))
                };
                return Some(format!(
                    "line {number}: {} here, {} as computed",
                    said(ours),
                    said(theirs)
                ));
            }
        }
    }
    None
}

/// How a table lies apart from the computed one: the first cell, and how many there are.
///
/// Cells are compared as they were decoded: two numbers must be equal, not near (decision 0060).
fn apart(found: &Table, computed: &Table) -> Option<(String, Option<Cell>)> {
    if found.columns != computed.columns {
        let names = |table: &Table| {
            let headings = table
                .columns
                .iter()
                .map(|(name, unit)| format!("{name} ({unit})"));
            headings.collect::<Vec<String>>().join(", ")
        };
        let (found, computed) = (names(found), names(computed));
        return Some((
            format!("its columns are {found}, the model computes {computed}"),
            None,
        ));
    }
    let mut cells = found
        .rows
        .iter()
        .zip(&computed.rows)
        .enumerate()
        .flat_map(|(row, pair)| {
            let pairs = pair.0.iter().zip(pair.1).enumerate();
            pairs
                .filter(|(_, (a, b))| !same(a, b))
                .map(move |(column, (a, b))| (row, column, a, b))
        });
    if let Some((row, column, a, b)) = cells.next() {
        let count = 1 + cells.count();
        let (name, unit) = computed.columns.get(column).cloned().unwrap_or_default();
        let run = computed
            .place(RUN)
            .and_then(|place| computed.rows.get(row)?.get(place).cloned());
        let cell = Cell {
            run: run.unwrap_or_default(),
            row: row + 1,
            column: name,
            unit,
            found: a.clone(),
            computed: b.clone(),
        };
        let cells = if count == 1 {
            "1 cell differs".to_owned()
        } else {
            format!("{count} cells differ")
        };
        return Some((cells, Some(cell)));
    }
    let (found, computed) = (found.rows.len(), computed.rows.len());
    (found != computed).then(|| {
        (
            format!("it has {found} rows, the model computes {computed}"),
            None,
        )
    })
}

fn same(found: &str, computed: &str) -> bool {
    let decoded = |text: &str| text.parse::<f64>().ok();
    found == computed || matches!((decoded(found), decoded(computed)), (Some(a), Some(b)) if a == b)
}
