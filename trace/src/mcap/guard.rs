//! This file keeps a panic in somebody else's reader from ending the program, and its text from the terminal.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Runs what calls into a format's crate, which may panic on damage that it did not foresee.
pub(super) fn guarded<T>(run: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    keep_quiet();
    let before = GUARDED.replace(true);
    let answer = catch_unwind(AssertUnwindSafe(run));
    GUARDED.set(before);
    answer.unwrap_or_else(|_| Err("it breaks the format in a way that stops its reader".into()))
}

/// Panics that are caught here say nothing; all others say what they did before.
fn keep_quiet() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let others = take_hook();
        set_hook(Box::new(move |panic| {
            if !GUARDED.get() {
                others(panic);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_answer_and_the_next_call_is_guarded_again() {
        for _ in 0..2 {
            let answer = guarded::<u8>(|| panic!("what somebody else's reader says"));
            assert!(answer.unwrap_err().contains("stops its reader"));
            assert!(!GUARDED.get());
        }
        assert_eq!(guarded(|| Ok(3)), Ok(3));
    }
}
