//! This file reads the numeric datasets of an HDF5 file.

use std::path::Path;

use hdf5_pure::{DType, File, Group};

use super::Entry;
use crate::error::TraceError;

/// Groups deeper than this are not looked into, so that a file that refers to itself ends.
const DEEPEST: usize = 16;

pub(super) fn open(path: &Path) -> Result<(File, Vec<Entry>), TraceError> {
    let file = File::open_streaming(path).map_err(damaged(path))?;
    let mut entries = Vec::new();
    collect(&file.root(), "", DEEPEST, &mut entries).map_err(damaged(path))?;
    Ok((file, entries))
}

pub(super) fn values(file: &File, path: &Path, name: &str) -> Result<Vec<f64>, TraceError> {
    let dataset = file.dataset(name).map_err(damaged(path))?;
    dataset.read_f64().map_err(damaged(path))
}

fn collect(
    group: &Group,
    prefix: &str,
    deeper: usize,
    entries: &mut Vec<Entry>,
) -> Result<(), hdf5_pure::Error> {
    for name in group.datasets()? {
        let dataset = group.dataset(&name)?;
        let shape: Vec<usize> = dataset
            .shape()?
            .into_iter()
            .filter_map(|n| n.try_into().ok())
            .collect();
        let (rows, columns) = match (shape.as_slice(), is_number(&dataset.dtype()?)) {
            ([], true) => (1, 1),
            (&[rows], true) => (rows, 1),
            (&[rows, columns], true) => (rows, columns),
            _ => continue,
        };
        let name = format!("{prefix}{name}");
        entries.push(Entry {
            name,
            rows,
            columns,
        });
    }
    if deeper > 0 {
        for name in group.groups()? {
            let inner = format!("{prefix}{name}/");
            collect(&group.group(&name)?, &inner, deeper - 1, entries)?;
        }
    }
    Ok(())
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
