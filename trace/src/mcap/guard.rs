//! This file keeps a panic in somebody else's reader from ending the program.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs what calls into a format's crate, which may panic on damage that it did not foresee.
pub(super) fn guarded<T>(run: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(run))
        .unwrap_or_else(|_| Err("it breaks the format in a way that stops its reader".into()))
}
