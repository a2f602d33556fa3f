//! Whether a changed controller may go on the rig: campaigns of simulated trials, the laws that every sample is held to, and what was found.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod controller;
pub mod foreign;
