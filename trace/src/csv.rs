//! This file is the way of a recording from and to a text file: any dialect in, comma-separated out.

mod columns;
mod dialect;
mod layout;
mod lines;
mod read;
mod units_row;
mod write;

pub use columns::TimeColumn;
pub(crate) use columns::time_to_s;
pub use dialect::{Decimal, Dialect, Encoding, Hints, Separator};
pub use read::{LEAST_SAMPLES, parse, parse_as, read, read_as};
pub use write::{to_bytes, write};

#[cfg(test)]
mod dialects;
