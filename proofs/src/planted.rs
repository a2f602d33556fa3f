//! This file holds the planted mutants: the rig's own selection with one change each, under the same claims; in an optimised build only.
#![allow(clippy::all, dead_code, unused, missing_docs)]

use rigproof_impl::claim::{Checker, Claim};

/// A mutant.
pub struct Planted<C> {
    /// Its name.
    pub name: &'static str,
    /// The file below `impl/src` that it changes.
    pub file: &'static str,
    /// What stands there.
    pub from: &'static str,
    /// What stands there instead.
    pub to: &'static str,
    /// The claims about it.
    pub claims: Vec<Claim<C>>,
}

include!(concat!(env!("OUT_DIR"), "/planted/planted.rs"));
