//! Why a recording disagrees: align, locate, explain, refit, show.
#![deny(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod align;
pub mod candidates;
mod diagnose;
pub mod evidence;
pub mod filter;
pub mod free_run;
pub mod from_rig;
pub mod inverse;
pub mod locate;
pub mod problem;
pub mod refit;
pub mod regression;
pub mod report;
pub mod run;
pub mod select;
pub mod simulate;
pub mod unknown;
pub mod weak;
pub mod whiten;
pub mod write_rig;

pub use diagnose::{Curves, Diagnosis, Options, diagnose};
