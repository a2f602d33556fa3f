//! This file is the way of a recording from and to an MCAP file.
//!
//! A file is read in one pass from its start, damage is passed over where there is a way past it, and what is missing
//! is said. Nothing in memory grows with the file but the numbers that were asked for.

mod account;
mod address;
mod chunk;
mod clock;
mod decoder;
mod feed;
mod flat;
mod fuzz;
mod guard;
mod integrity;
mod json;
mod pace;
mod protobuf;
mod read;
mod resample;
mod ros;
mod run;
mod shapes;
mod source;
mod stream;
mod summary;
mod topics;
mod track;
mod write;

pub use fuzz::{read_bytes, read_message_bytes};
pub use integrity::{Check, Integrity};
pub use pace::GAP_STEPS;
pub use read::{Reading, Selection, Wanted, read, read_from};
pub use resample::Between;
pub use summary::{ChannelSummary, Summary, TopicSummary, summarise, summary};
pub use write::{Extras, to_bytes, write};

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::TraceError;

/// Whether a file begins as MCAP does, whatever its name says.
///
/// # Errors
/// The system refuses.
pub fn is_mcap(path: &Path) -> Result<bool, TraceError> {
    let mut start = Vec::new();
    File::open(path)
        .and_then(|file| {
            file.take(::mcap::MAGIC.len() as u64)
                .read_to_end(&mut start)
        })
        .map_err(TraceError::io("read", path))?;
    Ok(start == ::mcap::MAGIC)
}
