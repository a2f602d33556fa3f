//! This file feeds bytes to the reader of rig descriptions: it gives a rig or a named error.
#![no_main]

#[path = "../claims.rs"]
#[allow(dead_code, reason = "a target feeds one reader")]
mod claims;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| claims::rig(bytes));
