//! This file is the way of a recording from and to a text file: any dialect in, comma-separated out.

mod columns;
mod dialect;
mod layout;
mod lines;
mod logger;
mod read;
mod stamp;
mod table;
mod time;
mod units_row;
mod write;

pub use columns::TimeColumn;
pub(crate) use columns::time_to_s;
pub use dialect::{Decimal, Dialect, Encoding, Hints, Separator};
pub use read::{Known, LEAST_SAMPLES, Text, parse, parse_as, parse_text, read, read_as, read_text};
pub use write::{to_bytes, write};

#[cfg(test)]
mod dialects;
