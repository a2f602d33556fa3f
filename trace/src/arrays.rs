//! This file takes arrays out of HDF5 and MATLAB files and makes a recording of them.

mod assemble;
mod bytes;
mod hdf5;
mod matlab;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::budget;
use crate::error::TraceError;
use crate::suggest::{advice, short};

pub use assemble::{Selection, TimeSource};

/// The numeric arrays of a file, up to two dimensions.
#[derive(Debug)]
pub struct Arrays {
    path: PathBuf,
    content: Content,
    entries: Vec<Entry>,
    passed_over: Vec<PassedOver>,
}

/// A variable that holds no array of real numbers, and what it is instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassedOver {
    /// The name.
    pub name: String,
    /// What it is.
    pub what: Other,
}

/// What is no array of real numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Other {
    /// A `timeseries`, a table, a text of the newer kind: MATLAB does not say how they are laid out.
    Object,
    /// A cell array.
    Cells,
    /// Complex numbers.
    Complex,
    /// Numbers in more than two dimensions.
    ManyDimensions,
    /// A name that stands in the file more than once.
    Repeated,
}

impl PassedOver {
    /// "`ts` is an object of MATLAB, which is not read; …", with what to save instead.
    pub fn advice(&self) -> String {
        let name = &self.name;
        let (what, instead) = match self.what {
            Other::Object => (
                "is an object of MATLAB",
                format!("`t = {name}.Time; x = {name}.Data`"),
            ),
            Other::Cells => ("is a cell array", format!("`x = {name}{{1}}`")),
            Other::Complex => ("is complex", format!("`x = real({name})`")),
            Other::ManyDimensions => (
                "has more than two dimensions",
                format!("`x = squeeze({name}(1, 1, :))`"),
            ),
            Other::Repeated => (
                "stands in the file more than once, so that it cannot be told which is meant",
                format!("`x = {name}` in a file of its own"),
            ),
        };
        format!(
            "`{name}` {what}, which is not read; in MATLAB, save its numbers as arrays, such as {instead}"
        )
    }
}

/// One array of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name, with what it stands in before it: groups of HDF5 end in `/`, structures of MATLAB in `.` (`Y[1].Data`
    /// of the second structure of an array).
    pub name: String,
    /// Rows; a vector stands upright.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
}

#[derive(Debug)]
enum Content {
    Hdf5(hdf5::Datasets),
    /// HDF5 as MATLAB writes it: every array lies on its side.
    Matlab73(hdf5::Datasets),
    Matlab(matlab::MatFile),
}

impl Arrays {
    /// Opens a file, or answers `None` when it is neither HDF5 nor MATLAB (version 5 to 7.3), as its first bytes
    /// say.
    ///
    /// # Errors
    /// The file cannot be read, or breaks its format.
    pub fn open(path: &Path) -> Result<Option<Arrays>, TraceError> {
        let mut start = Vec::new();
        File::open(path)
            .and_then(|file| file.take(1024).read_to_end(&mut start))
            .map_err(TraceError::io("read", path))?;
        let is_hdf5 = hdf5_pure::is_hdf5(path).map_err(TraceError::io("read", path))?;
        let (content, mut entries, passed_over) = if is_hdf5 {
            let from_matlab = start.starts_with(b"MATLAB 7.3");
            let (datasets, mut entries, passed_over) = hdf5::open(path, from_matlab)?;
            if from_matlab {
                for entry in &mut entries {
                    (entry.rows, entry.columns) = (entry.columns, entry.rows);
                }
                (Content::Matlab73(datasets), entries, passed_over)
            } else {
                (Content::Hdf5(datasets), entries, passed_over)
            }
        } else if start.starts_with(b"MATLAB 5.0") {
            let (file, entries, passed_over) = matlab::open(path)?;
            (Content::Matlab(file), entries, passed_over)
        } else {
            return Ok(None);
        };
        for entry in &mut entries {
            if entry.rows == 1 {
                (entry.rows, entry.columns) = (entry.columns, 1);
            }
        }
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        let mut arrays = Arrays {
            path: path.to_path_buf(),
            content,
            entries,
            passed_over,
        };
        arrays.pass_over_repeated();
        Ok(Some(arrays))
    }

    fn pass_over_repeated(&mut self) {
        let same_name = self.entries.chunk_by(|a, b| a.name == b.name);
        let (once, repeated): (Vec<_>, Vec<_>) = same_name.partition(|same| same.len() == 1);
        let names = repeated.into_iter().filter_map(|same| same.first());
        self.passed_over.extend(names.map(|entry| PassedOver {
            name: entry.name.clone(),
            what: Other::Repeated,
        }));
        self.entries = once.concat();
    }

    /// Every array, by name.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Variables that hold no array of real numbers.
    pub fn passed_over(&self) -> &[PassedOver] {
        &self.passed_over
    }

    /// The array of exactly that name; they stand in the order of their names, each once.
    fn named(&self, name: &str) -> Option<&Entry> {
        let place = self
            .entries
            .binary_search_by(|entry| entry.name.as_str().cmp(name));
        self.entries.get(place.ok()?)
    }

    /// The array of that name; structures may be named as MATLAB does, `Y(2).Data` for `Y[1].Data`.
    fn entry(&self, name: &str) -> Option<&Entry> {
        let named = |name: &str| self.named(name);
        let own = named(name);
        if own.is_some() || matches!(self.content, Content::Hdf5(_)) {
            return own;
        }
        let name = from_matlab(name);
        // A single structure has no index.
        named(&name).or_else(|| named(&name.replace("[0].", ".")))
    }

    fn no_variable(&self, name: &str) -> String {
        let own = self
            .passed_over
            .iter()
            .find(|other| from_matlab(name).starts_with(&other.name));
        if let Some(own) = own {
            return own.advice();
        }
        let names: Vec<&str> = self.entries.iter().map(|e| e.name.as_str()).collect();
        let advice = advice(name, "variables", &names);
        format!("there is no variable `{name}`; {advice}")
    }

    /// One column of an array: `name`, or `name[k]` with k counted from 0 where there is more than one.
    ///
    /// # Errors
    /// There is no such array or column, or the file is damaged.
    pub fn column(&self, wanted: &str) -> Result<Vec<f64>, TraceError> {
        let refused = |problem: String| TraceError::recording(&self.path, problem);
        // A name may itself end in an index.
        let whole = self.named(wanted);
        let (entry, index) = if let Some(entry) = whole {
            (entry, None)
        } else {
            let (name, index) = split_index(wanted);
            let Some(entry) = self.entry(name) else {
                return Err(refused(self.no_variable(name)));
            };
            (entry, index)
        };
        let name = entry.name.as_str();
        let count = entry.rows.checked_mul(entry.columns);
        let what = format!(
            "`{}` of {} × {} numbers",
            short(name),
            entry.rows,
            entry.columns
        );
        let bytes = count.map_or(u64::MAX, |count| (count as u64).saturating_mul(8));
        budget::check(&self.path, &what, bytes)?;
        let count = count.unwrap_or_default();
        let index = match (index, entry.columns) {
            (Some(index), columns) if index < columns => index,
            (None, 1) => 0,
            (_, columns) => {
                let last = columns.saturating_sub(1);
                return Err(refused(format!(
                    "`{wanted}` names no column: `{name}` has {columns}; write `{name}[0]` to `{name}[{last}]`"
                )));
            }
        };
        let (values, row_major) = match &self.content {
            Content::Hdf5(datasets) => (hdf5::values(datasets, &self.path, name)?, true),
            Content::Matlab73(datasets) => (hdf5::values(datasets, &self.path, name)?, false),
            Content::Matlab(file) => (matlab::values(file, name), false),
        };
        if values.len() != count {
            let (found, rows, columns) = (values.len(), entry.rows, entry.columns);
            return Err(refused(format!(
                "`{name}` holds {found} numbers where {rows} × {columns} were announced; the file is damaged"
            )));
        }
        let (start, step, count) = match row_major {
            true => (index, entry.columns, entry.rows),
            false => (index * entry.rows, 1, entry.rows),
        };
        let column = values
            .into_iter()
            .skip(start)
            .step_by(step.max(1))
            .take(count);
        Ok(column.collect())
    }
}

/// A path as MATLAB writes it, or with `/`, in the form of [`Entry::name`].
fn from_matlab(path: &str) -> String {
    let mut name = String::new();
    let mut rest = path;
    while let Some((before, after)) = rest.split_once('(') {
        let index = after.split_once(')').and_then(|(index, after)| {
            let index: usize = index.parse().ok()?;
            Some((index.checked_sub(1)?, after))
        });
        name += before;
        let (index, after) = match index {
            Some((index, after)) => (format!("[{index}]"), after),
            None => ("(".to_owned(), after),
        };
        name += &index;
        rest = after;
    }
    (name + rest).replace('/', ".")
}

/// The name and the index of `name[k]`.
fn split_index(text: &str) -> (&str, Option<usize>) {
    let indexed = || {
        let (name, index) = text.strip_suffix(']')?.rsplit_once('[')?;
        Some((name, index.parse().ok()?))
    };
    indexed().map_or((text, None), |(name, index)| (name, Some(index)))
}

#[cfg(test)]
mod structures;
#[cfg(test)]
mod tests;
