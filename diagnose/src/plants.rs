//! This room is the plants: a folder each, which knows its recordings, its equations and its noise.

mod brake;
pub mod chain;
pub mod five_bar;
mod joined;
pub mod joint;
mod registry;

pub use registry::{Description, Measured, Replica};
