//! This file makes the monitor of a certificate: what its trials drew and covered, as numbers that watch the rig.

pub mod drill;
mod files;
mod made;
mod middle;
mod tail;

pub use files::{FILES, header, json, source};
pub use made::{Basis, Made, Refused, made};
pub use middle::constants;
