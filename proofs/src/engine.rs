//! This file names the engines that examine a claim.

pub mod enumeration;
pub mod random;
pub mod smt;
