//! This file says how many threads a verb works with.

use crate::outcome::Failure;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use rigproof_diagnose::stop::Stop;
use std::fmt::Display;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::Builder;

/// The most jobs at once: more than any processor has threads. A system that gives fewer says so.
const MOST: usize = 1024;

/// Reads a number of jobs; 0 takes every processor.
pub fn parse(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(jobs) if jobs <= MOST => Ok(jobs),
        _ => Err(format!(
            "give a whole number from 0 to {MOST}; 0 takes every processor"
        )),
    }
}

/// That many threads.
///
/// # Errors
/// The system does not give them.
pub fn pool(jobs: usize) -> Result<ThreadPool, Failure> {
    started(jobs).map_err(|error| refused(jobs, &error))
}

/// Threads that end when this one is told to.
fn started(jobs: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    let stop = Stop::current();
    ThreadPoolBuilder::new()
        .num_threads(jobs)
        .start_handler(move |_| Stop::put(stop.clone()))
        .build()
}

fn refused(jobs: usize, error: &dyn Display) -> Failure {
    Failure::Input(format!("cannot start {jobs} jobs: {error}; give fewer"))
}

/// Begins no other item once one of them panics.
struct Last<'a>(&'a AtomicUsize, usize);

impl Drop for Last<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.store(self.1, Ordering::Relaxed);
        }
    }
}

/// Does something with every item, so many at once, and gives the results in the order of the items: 0 takes every processor. Each item has
/// one thread alone, in which its own parallel parts stay: a thread that waits within one item never takes up another, whose memory it would
/// hold beside the first.
///
/// # Errors
/// Those of an item, after which no other one is begun; the system does not give the threads.
pub fn apart<T: Sync, R: Send>(
    jobs: usize,
    items: &[T],
    one: impl Fn(&T) -> Result<R, Failure> + Sync,
) -> Result<Vec<R>, Failure> {
    let jobs = match jobs {
        0 => rayon::current_num_threads(),
        jobs => jobs,
    };
    let alone =
        (0..jobs.min(items.len())).map(|_| started(1).map_err(|error| refused(jobs, &error)));
    let alone = alone.collect::<Result<Vec<ThreadPool>, Failure>>()?;
    let next = AtomicUsize::new(0);
    let work = || -> Vec<(usize, Result<R, Failure>)> {
        let _last = Last(&next, items.len());
        let mut done = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(place) else {
                return done;
            };
            let result = one(item);
            if result.is_err() {
                next.store(items.len(), Ordering::Relaxed);
            }
            done.push((place, result));
        }
    };
    let mut done = Vec::new();
    std::thread::scope(|scope| -> Result<(), Failure> {
        let started = alone.iter().map(|pool| {
            let thread = Builder::new().spawn_scoped(scope, || pool.install(work));
            thread.inspect_err(|_| next.store(items.len(), Ordering::Relaxed))
        });
        let started: Vec<_> = started.collect();
        for thread in started {
            match thread.map_err(|error| refused(jobs, &error))?.join() {
                Ok(own) => done.extend(own),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        Ok(())
    })?;
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_done_once_in_its_place_by_one_thread() {
        for jobs in [0, 1, 3, 40] {
            let done = apart(jobs, &[3, 1, 4, 1, 5, 9, 2], |x| {
                Ok((x * x, rayon::current_num_threads()))
            });
            let expected = [9, 1, 16, 1, 25, 81, 4].map(|square| (square, 1));
            assert_eq!(done.unwrap(), expected);
        }
        assert!(apart(2, &[] as &[u8], |x| Ok(*x)).unwrap().is_empty());
    }

    #[test]
    fn an_item_that_fails_is_the_result() {
        let failed = apart(2, &[3, 7, 5], |x| match x {
            7 => Err(Failure::Input("seven".to_owned())),
            x => Ok(*x),
        });
        assert!(matches!(failed, Err(Failure::Input(why)) if why == "seven"));
    }

    #[test]
    fn an_item_that_panics_is_the_last_one() {
        let begun = AtomicUsize::new(0);
        let caught = std::panic::catch_unwind(|| {
            apart(1, &[3, 7, 5], |x| {
                begun.fetch_add(1, Ordering::Relaxed);
                assert_ne!(*x, 7);
                Ok(())
            })
        });
        assert!(caught.is_err());
        assert_eq!(begun.into_inner(), 2);
    }

    #[test]
    fn more_threads_than_any_processor_has_are_refused() {
        assert_eq!(parse("7"), Ok(7));
        for text in ["1025", "100000", "-3", "2.5", "many"] {
            assert!(parse(text).unwrap_err().contains("0 to 1024"), "{text}");
        }
    }
}
