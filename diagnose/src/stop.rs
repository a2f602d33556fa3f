//! This file ends a diagnosis early from another thread.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static OWN: RefCell<Option<Stop>> = const { RefCell::new(None) };
}

/// Ends a diagnosis from another thread.
///
/// ```
/// use rigproof_diagnose::stop::{Stop, Stopped};
///
/// let stop = Stop::default();
/// stop.stop();
/// let done = std::panic::catch_unwind(|| stop.clone().during(rigproof_diagnose::stop::look));
/// assert!(done.is_err_and(|payload| payload.is::<Stopped>()));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

/// The payload with which an ended diagnosis unwinds. It is no panic, and nothing is printed.
#[derive(Clone, Copy, Debug)]
pub struct Stopped;

impl Stop {
    /// Ends the work of every thread that has this stop, at its next column or fit.
    pub fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// The stop of this thread, to be put on other threads that share its work.
    pub fn current() -> Option<Stop> {
        OWN.with_borrow(Clone::clone)
    }

    /// Puts a stop on this thread, or removes it, permanently.
    pub fn put(own: Option<Stop>) {
        OWN.set(own);
    }

    /// Puts this stop on the thread for the duration of some work.
    pub fn during<T>(self, work: impl FnOnce() -> T) -> T {
        struct Before(Option<Stop>);
        impl Drop for Before {
            fn drop(&mut self) {
                OWN.set(self.0.take());
            }
        }
        let _before = Before(OWN.replace(Some(self)));
        work()
    }
}

/// Unwinds with [`Stopped`] if the work of this thread was ended. Inner loops of the search call
/// it.
pub fn look() {
    let is_ended = OWN.with_borrow(|own| {
        own.as_ref()
            .is_some_and(|own| own.0.load(Ordering::Relaxed))
    });
    if is_ended {
        std::panic::resume_unwind(Box::new(Stopped));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_thread_that_is_on_it_ends_and_it_is_off_afterwards() {
        let (stop, other) = (Stop::default(), Stop::default());
        stop.stop();
        other.during(look);
        let ended = std::panic::catch_unwind(|| stop.during(look));
        assert!(ended.is_err_and(|payload| payload.is::<Stopped>()));
        assert!(Stop::current().is_none());
        look();
    }
}
