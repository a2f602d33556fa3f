//! This file reads the numeric arrays of a MATLAB file, version 5 to 7, those in structures among them.
//!
//! The layout is that of "MAT-File Format" by MathWorks, chapter 1, "Level 5 MAT-File Format".

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;

use super::bytes::{Bytes, COMPRESSED, MATRIX, Numbers};
use super::{Entry, Other, PassedOver};
use crate::budget;
use crate::error::TraceError;

const HEADER: usize = 128;
/// Structures deeper than this are not looked into.
const DEEPEST: usize = 16;

const CELL: u32 = 1;
const STRUCTURE: u32 = 2;
const OBJECT: u32 = 3;
const NUMERIC: std::ops::RangeInclusive<u32> = 6..=15;
const OPAQUE: u32 = 17;
const COMPLEX: u32 = 0x0800;

/// The arrays of a file.
#[derive(Debug, Default)]
pub(super) struct MatFile {
    /// By name; of a name that stands there twice the first, which nobody can ask for.
    arrays: HashMap<String, Numbers>,
}

/// What was found on the way.
#[derive(Default)]
struct Found {
    file: MatFile,
    entries: Vec<Entry>,
    passed_over: Vec<PassedOver>,
}

/// The arrays of a file, their names and sizes, and what is none.
type Opened = (MatFile, Vec<Entry>, Vec<PassedOver>);

pub(super) fn open(path: &Path) -> Result<Opened, TraceError> {
    open_within(path, budget::bytes())
}

/// Opens a file within a budget of memory, bytes: so much of it may the file take with its copies, and so much again what is inflated.
pub(super) fn open_within(path: &Path, budget: u64) -> Result<Opened, TraceError> {
    let largest = budget / budget::COPIES;
    let refused = |problem: &str| {
        let problem = format!("the MATLAB file cannot be read: {problem}");
        TraceError::recording(path, problem)
    };
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(largest.saturating_add(1)).read_to_end(&mut bytes))
        .map_err(TraceError::io("read", path))?;
    if bytes.len() as u64 > largest {
        let beyond = budget::beyond("it", bytes.len() as u64, budget);
        return Err(refused(&format!("{beyond}, or save it with `-v7.3`")));
    }
    let header = bytes
        .get(..HEADER)
        .ok_or_else(|| refused("it is cut off"))?;
    let big = match header.get(HEADER - 2..) {
        Some(b"IM") => false,
        Some(b"MI") => true,
        _ => return Err(refused("it breaks the format of version 5")),
    };
    let mut source = Bytes::new(bytes.get(HEADER..).unwrap_or_default(), big);
    let mut found = Found::default();
    let mut left = largest;
    while !source.is_empty() {
        let read = element(&mut source, &mut left, &mut found);
        if left == 0 {
            let beyond = budget::beyond("what its compressed parts hold", largest, budget);
            return Err(refused(&beyond));
        }
        read.ok_or_else(|| refused("it is cut off or breaks the format of version 5"))?;
    }
    Ok((found.file, found.entries, found.passed_over))
}

/// One variable of the file; `left` is what may still be inflated.
fn element(source: &mut Bytes<'_>, left: &mut u64, found: &mut Found) -> Option<()> {
    let (kind, bytes) = source.element()?;
    match kind {
        MATRIX => matrix(bytes, "", found, DEEPEST),
        COMPRESSED => {
            let mut inflated = Vec::new();
            let decoder = ZlibDecoder::new(bytes.rest());
            decoder.take(*left).read_to_end(&mut inflated).ok()?;
            *left = left.saturating_sub(inflated.len() as u64);
            (*left > 0).then_some(())?;
            let mut inside = Bytes::new(&inflated, bytes.is_big());
            match inside.element()? {
                (MATRIX, bytes) => matrix(bytes, "", found, DEEPEST),
                _ => Some(()),
            }
        }
        _ => Some(()),
    }
}

/// One array with what it holds; `name` is what stands for its own name inside a structure.
fn matrix(mut bytes: Bytes<'_>, name: &str, found: &mut Found, deeper: usize) -> Option<()> {
    if bytes.is_empty() {
        return Some(());
    }
    let (_, mut flags) = bytes.element()?;
    let flags = flags.word()?;
    let class = flags & 0xff;
    if class == OPAQUE {
        let (_, own) = bytes.element()?;
        pass_over(found, &text(own.rest(), name), Other::Object);
        return Some(());
    }
    let (_, dimensions) = bytes.element()?;
    let dimensions = dimensions.sizes()?;
    let (_, own) = bytes.element()?;
    let name = text(own.rest(), name);
    match class {
        STRUCTURE if deeper > 0 => structure(bytes, &name, &dimensions, found, deeper),
        OBJECT => {
            pass_over(found, &name, Other::Object);
            Some(())
        }
        CELL => {
            pass_over(found, &name, Other::Cells);
            Some(())
        }
        class if NUMERIC.contains(&class) => match dimensions.as_slice() {
            [rows, columns] if flags & COMPLEX == 0 => {
                let (kind, real) = bytes.element()?;
                let numbers = Numbers::new(kind, real)?;
                let (rows, columns) = (*rows, *columns);
                let count = rows.checked_mul(columns)?;
                // An empty array of any shape announces no number.
                (numbers.len() == count).then_some(())?;
                found.entries.push(Entry {
                    name: name.clone(),
                    rows,
                    columns,
                });
                found.file.arrays.entry(name).or_insert(numbers);
                Some(())
            }
            [_, _] => {
                pass_over(found, &name, Other::Complex);
                Some(())
            }
            _ => {
                pass_over(found, &name, Other::ManyDimensions);
                Some(())
            }
        },
        _ => Some(()),
    }
}

/// The fields of a structure, `name.field`, or of each of several, `name[k].field`.
fn structure(
    mut bytes: Bytes<'_>,
    name: &str,
    dimensions: &[usize],
    found: &mut Found,
    deeper: usize,
) -> Option<()> {
    let (_, mut width) = bytes.element()?;
    let width = usize::try_from(width.word()?)
        .ok()
        .filter(|width| *width > 0)?;
    let (_, names) = bytes.element()?;
    let fields: Vec<String> = names
        .rest()
        .chunks(width)
        .map(|field| text(field, ""))
        .collect();
    let count = dimensions
        .iter()
        .try_fold(1_usize, |all, n| all.checked_mul(*n))?;
    if fields.is_empty() {
        return Some(());
    }
    for index in 0..count {
        for field in &fields {
            // A cut file ends here: there is no element left for a field that was announced.
            let (kind, value) = bytes.element()?;
            if kind != MATRIX {
                return None;
            }
            let path = match count {
                1 => format!("{name}.{field}"),
                _ => format!("{name}[{index}].{field}"),
            };
            matrix(value, &path, found, deeper - 1)?;
        }
    }
    Some(())
}

fn pass_over(found: &mut Found, name: &str, what: Other) {
    found.passed_over.push(PassedOver {
        name: name.to_owned(),
        what,
    });
}

/// A name up to its first NUL, or another one where it is empty.
fn text(bytes: &[u8], else_name: &str) -> String {
    let end = bytes.iter().position(|byte| *byte == 0);
    match bytes.get(..end.unwrap_or(bytes.len())) {
        Some(own @ [_, ..]) => String::from_utf8_lossy(own).into_owned(),
        _ => else_name.to_owned(),
    }
}

/// The numbers of an array, column after column; none when there is no such array.
pub(super) fn values(file: &MatFile, name: &str) -> Vec<f64> {
    let array = file.arrays.get(name);
    array.map(Numbers::values).unwrap_or_default()
}
