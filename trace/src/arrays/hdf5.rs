//! This file reads the numeric datasets of an HDF5 file, and what MATLAB 7.3 makes of structures.

use std::collections::HashMap;
use std::path::Path;

use hdf5_pure::{DType, Dataset, File, Group, Object};

use super::{Entry, Other, PassedOver};
use crate::budget;
use crate::error::TraceError;

/// Groups deeper than this are not looked into, so that a file that refers to itself ends.
const DEEPEST: usize = 16;
/// The most groups and datasets that are looked at, so that such a file ends soon.
const MOST_OBJECTS: usize = 1 << 16;

/// The datasets by their names.
#[derive(Debug, Default)]
pub(super) struct Datasets(HashMap<String, Dataset>);

/// What was found on the way.
struct Found {
    /// Whether MATLAB wrote the file.
    matlab: bool,
    datasets: Datasets,
    entries: Vec<Entry>,
    passed_over: Vec<PassedOver>,
    seen: usize,
}

pub(super) fn open(
    path: &Path,
    matlab: bool,
) -> Result<(Datasets, Vec<Entry>, Vec<PassedOver>), TraceError> {
    let file = File::open_streaming(path).map_err(damaged(path))?;
    let mut found = Found {
        matlab,
        datasets: Datasets::default(),
        entries: Vec::new(),
        passed_over: Vec::new(),
        seen: 0,
    };
    found
        .group(&file.root(), "", DEEPEST)
        .map_err(damaged(path))?;
    Ok((found.datasets, found.entries, found.passed_over))
}

pub(super) fn values(datasets: &Datasets, path: &Path, name: &str) -> Result<Vec<f64>, TraceError> {
    match datasets.0.get(name) {
        Some(dataset) => {
            check_chunk(dataset, path)?;
            dataset.read_f64().map_err(damaged(path))
        }
        None => Ok(Vec::new()),
    }
}

/// A small dataset may announce large chunks, each of which is unpacked whole.
fn check_chunk(dataset: &Dataset, path: &Path) -> Result<(), TraceError> {
    let shape = dataset.chunk_shape().map_err(damaged(path))?;
    let width = dataset.element_size().map_err(damaged(path))?;
    let bytes = shape
        .unwrap_or_default()
        .into_iter()
        .fold(width, u64::saturating_mul);
    budget::check(path, "a chunk of it", bytes)
}

impl Found {
    fn group(
        &mut self,
        group: &Group,
        prefix: &str,
        deeper: usize,
    ) -> Result<(), hdf5_pure::Error> {
        self.seen += 1;
        if self.seen > MOST_OBJECTS {
            return Ok(());
        }
        // One walk over the group: by its name, each would be looked for among all.
        for (name, dataset) in group.iter_datasets()? {
            self.dataset(dataset, prefix, &name, deeper)?;
        }
        // What MATLAB keeps for itself is called `#refs#` and `#subsystem#`.
        if deeper == 0 {
            return Ok(());
        }
        for (name, inside) in group.iter_groups()? {
            if self.matlab && name.starts_with('#') {
                continue;
            }
            let end = if self.matlab { '.' } else { '/' };
            let inner = format!("{prefix}{name}{end}");
            self.group(&inside, &inner, deeper - 1)?;
        }
        Ok(())
    }

    fn dataset(
        &mut self,
        dataset: Dataset,
        prefix: &str,
        name: &str,
        deeper: usize,
    ) -> Result<(), hdf5_pure::Error> {
        self.seen += 1;
        let full = format!("{prefix}{name}");
        let dtype = dataset.dtype()?;
        if self.seen > MOST_OBJECTS {
            return Ok(());
        }
        if self.matlab {
            let attributes = dataset.attrs().unwrap_or_default();
            if attributes.contains_key("MATLAB_object_decode") {
                self.pass_over(full, Other::Object);
                return Ok(());
            }
            if dtype == DType::ObjectReference {
                return self.field_of_several(&dataset, prefix, name, deeper);
            }
        }
        let shape = dataset.shape()?.into_iter();
        let shape: Vec<usize> = shape.filter_map(|n| n.try_into().ok()).collect();
        let (rows, columns) = match (shape.as_slice(), is_number(&dtype)) {
            ([], true) => (1, 1),
            (&[rows], true) => (rows, 1),
            (&[rows, columns], true) => (rows, columns),
            (_, true) => {
                self.pass_over(full, Other::ManyDimensions);
                return Ok(());
            }
            _ => return Ok(()),
        };
        self.entries.push(Entry {
            name: full.clone(),
            rows,
            columns,
        });
        self.datasets.0.insert(full, dataset);
        Ok(())
    }

    /// A field of an array of structures: references, one for each structure. A cell array looks the same and gives
    /// the same names: what stands at the top has no structure before it.
    fn field_of_several(
        &mut self,
        references: &Dataset,
        prefix: &str,
        field: &str,
        deeper: usize,
    ) -> Result<(), hdf5_pure::Error> {
        let Some(owner) = prefix.strip_suffix('.') else {
            self.pass_over(field.to_owned(), Other::Cells);
            return Ok(());
        };
        let count: u64 = references.shape()?.into_iter().fold(1, u64::saturating_mul);
        if deeper == 0 || count > MOST_OBJECTS as u64 {
            return Ok(());
        }
        for (index, object) in references.dereference()?.into_iter().enumerate() {
            let prefix = format!("{owner}[{index}].");
            match object {
                Object::Dataset(dataset) => self.dataset(*dataset, &prefix, field, deeper - 1)?,
                Object::Group(group) => {
                    self.group(&group, &format!("{prefix}{field}."), deeper - 1)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn pass_over(&mut self, name: String, what: Other) {
        self.passed_over.push(PassedOver { name, what });
    }
}

fn is_number(dtype: &DType) -> bool {
    use DType::*;
    matches!(
        dtype,
        F32 | F64 | I8 | I16 | I32 | I64 | U8 | U16 | U32 | U64
    )
}

fn damaged(path: &Path) -> impl Fn(hdf5_pure::Error) -> TraceError {
    move |error| TraceError::recording(path, format!("the HDF5 file cannot be read: {error}"))
}
