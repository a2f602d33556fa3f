//! This file is the way of a recording from and to a comma-separated text file.

mod lines;
mod read;
mod write;

pub(crate) use read::time_to_s;
pub use read::{LEAST_SAMPLES, TimeColumn, parse, read, read_with_time};
pub use write::{to_bytes, write};
