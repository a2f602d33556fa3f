//! This file reads the numeric arrays of a MATLAB file, version 5 to 7.

use std::fs::File;
use std::path::Path;

use matfile::{MatFile, NumericData};

use super::Entry;
use crate::error::TraceError;

pub(super) fn open(path: &Path) -> Result<(MatFile, Vec<Entry>), TraceError> {
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    let file = MatFile::parse(file).map_err(|error| {
        let reason = match error {
            matfile::Error::IOError(error) => error.to_string(),
            _ => "it breaks the format of version 5".to_string(),
        };
        TraceError::recording(path, format!("the MATLAB file cannot be read: {reason}"))
    })?;
    let entries = file.arrays().iter().filter_map(|array| {
        let &[rows, columns] = array.size().as_slice() else {
            return None;
        };
        real(array.data())?;
        Some(Entry {
            name: array.name().to_string(),
            rows,
            columns,
        })
    });
    let entries = entries.collect();
    Ok((file, entries))
}

/// The numbers of an array, column after column; none when there is no such array.
pub(super) fn values(file: &MatFile, name: &str) -> Vec<f64> {
    let array = file.find_by_name(name);
    array
        .and_then(|array| real(array.data()))
        .unwrap_or_default()
}

/// The numbers of an array without an imaginary part.
fn real(data: &NumericData) -> Option<Vec<f64>> {
    fn wide<T: Copy + Into<f64>>(values: &[T]) -> Vec<f64> {
        values.iter().map(|&value| value.into()).collect()
    }
    match data {
        NumericData::Int8 { real, imag: None } => Some(wide(real)),
        NumericData::UInt8 { real, imag: None } => Some(wide(real)),
        NumericData::Int16 { real, imag: None } => Some(wide(real)),
        NumericData::UInt16 { real, imag: None } => Some(wide(real)),
        NumericData::Int32 { real, imag: None } => Some(wide(real)),
        NumericData::UInt32 { real, imag: None } => Some(wide(real)),
        NumericData::Single { real, imag: None } => Some(wide(real)),
        NumericData::Double { real, imag: None } => Some(real.clone()),
        NumericData::Int64 { real, imag: None } => Some(real.iter().map(|&n| n as f64).collect()),
        NumericData::UInt64 { real, imag: None } => Some(real.iter().map(|&n| n as f64).collect()),
        _ => None,
    }
}
