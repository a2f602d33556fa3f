//! This file feeds bytes to the reader of text recordings: it gives a recording or a named error.
#![no_main]

#[path = "../claims.rs"]
#[allow(dead_code, reason = "a target feeds one reader")]
mod claims;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| claims::csv(bytes));
