//! This file feeds bytes to the reader of MCAP files: it gives messages or a named error.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| rigproof_trace::mcap::read_bytes(bytes));
