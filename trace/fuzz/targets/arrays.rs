//! This file feeds bytes to the readers of HDF5 and MATLAB files: they give arrays or a named error.
#![no_main]

#[path = "../claims.rs"]
#[allow(dead_code, reason = "a target feeds one reader")]
mod claims;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| claims::arrays(bytes));
