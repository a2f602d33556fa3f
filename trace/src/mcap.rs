//! This file is the way of a recording from and to an MCAP file.
//!
//! A file is read in one pass from its start, damage is passed over where there is a way past it, and what is missing
//! is said. Nothing in memory grows with the file but the numbers that were asked for.

mod account;
mod address;
mod chunk;
mod decoder;
mod flat;
mod integrity;
mod json;
mod pace;
mod protobuf;
mod ros;
mod source;
mod stream;
mod summary;
mod topics;

pub use integrity::{Check, Integrity};
pub use pace::GAP_STEPS;
pub use summary::{ChannelSummary, Summary, TopicSummary, summarise, summary};
