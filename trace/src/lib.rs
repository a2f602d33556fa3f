//! How a run is written down: one time-series type, CSV in and out, and the rig description that says what a
//! recording's channels mean.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod series;

pub use series::{Channel, Trace};
