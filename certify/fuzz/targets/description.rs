//! This file feeds bytes to the reader of what is to be certified.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use rigproof_certify::description::Description;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(text) = std::str::from_utf8(bytes)
        && let Err(error) = Description::parse(text, Path::new("certify.toml"))
    {
        assert!(error.to_string().starts_with("certify.toml"), "{error}");
    }
});
