//! This file takes arrays out of HDF5 and MATLAB files and makes a recording of them.

mod assemble;
mod hdf5;
mod matlab;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::error::TraceError;
use crate::suggest::advice;

pub use assemble::{Selection, TimeSource};

/// The numeric arrays of a file, up to two dimensions.
#[derive(Debug)]
pub struct Arrays {
    path: PathBuf,
    content: Content,
    entries: Vec<Entry>,
}

/// One array of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name, with the groups it stands in before it, separated by `/`.
    pub name: String,
    /// Rows; a vector stands upright.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
}

#[derive(Debug)]
enum Content {
    Hdf5(Box<hdf5_pure::File>),
    /// HDF5 as MATLAB writes it: every array lies on its side.
    Matlab73(Box<hdf5_pure::File>),
    Matlab(matfile::MatFile),
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
        let (content, mut entries) = if is_hdf5 {
            let (file, mut entries) = hdf5::open(path)?;
            if start.starts_with(b"MATLAB 7.3") {
                for entry in &mut entries {
                    (entry.rows, entry.columns) = (entry.columns, entry.rows);
                }
                (Content::Matlab73(Box::new(file)), entries)
            } else {
                (Content::Hdf5(Box::new(file)), entries)
            }
        } else if start.starts_with(b"MATLAB 5.0") {
            matlab::open(path).map(|(file, entries)| (Content::Matlab(file), entries))?
        } else {
            return Ok(None);
        };
        for entry in &mut entries {
            if entry.rows == 1 {
                (entry.rows, entry.columns) = (entry.columns, 1);
            }
        }
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(Some(Arrays {
            path: path.to_path_buf(),
            content,
            entries,
        }))
    }

    /// Every array, by name.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// One column of an array: `name`, or `name[k]` with k counted from 0 where there is more than one.
    ///
    /// # Errors
    /// There is no such array or column, or the file is damaged.
    pub fn column(&self, wanted: &str) -> Result<Vec<f64>, TraceError> {
        let refused = |problem: String| TraceError::recording(&self.path, problem);
        let (name, index) = split_index(wanted);
        let Some(entry) = self.entries.iter().find(|entry| entry.name == name) else {
            let names: Vec<&str> = self.entries.iter().map(|e| e.name.as_str()).collect();
            let advice = advice(name, "variables", &names);
            return Err(refused(format!("there is no variable `{name}`; {advice}")));
        };
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
            Content::Hdf5(file) => (hdf5::values(file, &self.path, name)?, true),
            Content::Matlab73(file) => (hdf5::values(file, &self.path, name)?, false),
            Content::Matlab(file) => (matlab::values(file, name), false),
        };
        if values.len() != entry.rows * entry.columns {
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

/// The name and the index of `name[k]`.
fn split_index(text: &str) -> (&str, Option<usize>) {
    let indexed = || {
        let (name, index) = text.strip_suffix(']')?.rsplit_once('[')?;
        Some((name, index.parse().ok()?))
    };
    indexed().map_or((text, None), |(name, index)| (name, Some(index)))
}

#[cfg(test)]
mod tests;
