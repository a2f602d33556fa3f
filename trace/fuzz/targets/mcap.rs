//! This file feeds bytes to the reader of MCAP files: it gives messages or a named error.
#![no_main]

use std::panic::{set_hook, take_hook};

use libfuzzer_sys::fuzz_target;
use rigproof_trace::mcap;

fuzz_target!(init: own_panics_stop(), |bytes: &[u8]| mcap::read_bytes(bytes));

/// The reader catches what panics inside the format's crate; what panics in its own code is a defect, caught or not.
fn own_panics_stop() {
    // The first record makes the reader put its own hook in place, which this one goes before.
    mcap::read_bytes(&[b"\x89MCAP0\r\n\x7f".as_slice(), &[0; 8]].concat());
    let others = take_hook();
    set_hook(Box::new(move |panic| {
        let place = panic.location().map_or("", |place| place.file());
        if place.contains("trace/src/") {
            eprintln!("{panic}");
            std::process::abort();
        }
        others(panic);
    }));
}
