//! What the thesis says: vocabulary, tables, units and laws. No behaviour, no dependencies.
#![no_std]
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod command;
pub mod displays;
pub mod effect;
pub mod geometry;
pub mod inertia;
pub mod joint;
pub mod laws;
pub mod layout;
pub mod methods;
pub mod settings;
pub mod tables;
pub mod trials;
pub mod units;
