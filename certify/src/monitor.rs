//! This file makes the monitor of a certificate: what its trials drew and covered, as numbers that watch the rig.

pub mod drill;
pub mod middle;
