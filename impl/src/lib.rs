//! What the rig runs: one tick of a controller, one step of the plant. No standard library but for the feature `batch`, no heap, no
//! panic, and bounded work in every tick.
#![no_std]
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod actuation;
#[cfg(feature = "batch")]
pub mod batch;
#[cfg(any(kani, feature = "claims"))]
pub mod claim;
pub mod command;
pub mod current;
pub mod encoder;
pub mod guard;
pub mod law;
pub mod linkage;
pub mod number;
pub mod path;
pub mod plant;
pub mod select;
mod setting;
pub mod tick;
pub mod tip_mass;
pub mod vector;
pub mod velocity;
