//! This file says how many threads a verb works with.

use crate::outcome::Failure;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The most threads that a verb starts: more than any processor has, fewer than a system refuses.
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
    let pool = ThreadPoolBuilder::new().num_threads(jobs).build();
    pool.map_err(|error| Failure::Input(format!("cannot start {jobs} jobs: {error}; give fewer")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_any_processor_has_are_refused() {
        assert_eq!(parse("7"), Ok(7));
        for text in ["1025", "100000", "-3", "2.5", "many"] {
            assert!(parse(text).unwrap_err().contains("0 to 1024"), "{text}");
        }
    }
}
