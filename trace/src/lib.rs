//! How a run is written down: one time-series type, CSV in and out, HDF5 and MATLAB files in, and the rig
//! description that says what a recording's channels mean.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod arrays;
pub mod compare;
pub mod csv;
pub mod error;
pub mod header;
pub mod mcap;
pub mod rig;
pub mod series;
pub mod store;
pub mod suggest;

pub use error::{Place, TraceError};
pub use series::{Channel, Trace};
