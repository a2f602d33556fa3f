//! Whether a changed controller may go on the rig: campaigns of simulated trials, the laws that every sample is held to, and what was found.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod axis;
pub mod built_in;
pub mod calibration;
pub mod campaign;
pub mod certificate;
pub mod cluster;
pub mod controller;
pub mod coverage;
pub mod declared;
pub mod description;
pub mod differential;
pub mod digest;
pub mod error;
pub mod finding;
pub mod foreign;
pub mod hand;
pub mod journal;
pub mod judge;
pub mod law;
pub mod left_out;
pub mod metrics;
pub mod monitor;
pub mod plan;
pub mod proved;
mod rebuilt;
pub mod recheck;
pub mod record;
pub mod recordings;
pub mod requirement;
pub mod scenario;
pub mod search;
mod shape;
pub mod shrink;
pub mod summary;
pub mod tool;
pub mod trial;
pub mod way;

pub use error::Error;
