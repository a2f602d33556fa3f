//! Why a recording disagrees: align, locate, explain, refit, show.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod align;
mod candidates;
mod diagnose;
mod evidence;
mod filter;
pub mod five_bar;
pub mod free_run;
pub mod from_rig;
pub mod identify;
pub mod inverse;
mod locate;
mod problem;
#[cfg(test)]
mod recorded;
mod refit;
mod regression;
mod replica;
pub mod report;
pub mod run;
mod scatter;
mod select;
pub mod self_calibration;
mod sensor;
pub mod simulate;
mod unknown;
mod weak;
mod whiten;
mod write_rig;

pub use diagnose::{Curves, Description, Diagnosis, FittedCurves, Measured, Options, diagnose};
pub use select::Gates;
