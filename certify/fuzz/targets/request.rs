//! This file feeds bytes to what takes a request of the local page apart.
#![no_main]

#[path = "../../../cli/src/serve/head.rs"]
mod head;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| match head::asked(bytes) {
    Ok(asked) => assert!(!asked.method.is_empty() && !asked.url.is_empty()),
    Err((status, _)) => assert!([400, 431].contains(&status)),
});
