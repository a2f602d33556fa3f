//! This file feeds definitions and messages of them to the decoders: they give numbers or a named error.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| rigproof_trace::mcap::read_message_bytes(bytes));
