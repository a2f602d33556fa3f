//! How a run is written down: one time-series type, CSV in and out, HDF5 and MATLAB files in, and the rig
//! description that says what a recording's channels mean.
//!
//! What a recorded channel means stands in the rig description:
//!
//! ```
//! use rigproof_trace::rig::Rig;
//! use rigproof_trace::{Channel, Trace};
//! use std::path::Path;
//!
//! let rig = Rig::parse(
//!     r#"
//!     name = "slide"
//!     plant = "axis"
//!     motion = "linear"
//!     [channels]
//!     position = { channel = "x", unit = "mm" }
//!     command = { channel = "u", unit = "V" }
//!     [parameters]
//!     inertia = { value = 1.7, unit = "kg" }
//!     command_gain = { value = 35.5, unit = "N/V" }
//!     "#,
//!     Path::new("rig.toml"),
//! )?;
//! let channel = |name: &str, unit: &str, samples: &[f64]| Channel {
//!     name: name.to_owned(),
//!     unit: unit.to_owned(),
//!     samples: samples.to_vec(),
//! };
//! let trace = Trace {
//!     time_s: vec![0.0, 0.001, 0.002],
//!     channels: vec![channel("x", "mm", &[0.0, 1.5, 4.0]), channel("u", "V", &[0.1, 0.1, 0.2])],
//! };
//! let recording = rig.apply(&trace, Path::new("run.csv"))?;
//! assert_eq!(recording.position.samples[2], 0.004); // m
//! # Ok::<(), rigproof_trace::TraceError>(())
//! ```
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod arrays;
pub mod budget;
pub mod clock;
pub mod compare;
pub mod csv;
pub mod error;
pub mod foreign;
pub mod header;
pub mod mcap;
pub mod rig;
pub mod series;
pub mod store;
pub mod suggest;

pub use error::{Place, TraceError};
pub use series::{Channel, Trace};
