//! This file says how a compiled controller is a source: its trials run in processes of their own, and whatever happens there is a finding.

#[cfg(target_os = "linux")]
mod child;
mod end;
#[cfg(target_os = "linux")]
pub mod link;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_os = "linux")]
mod phase;
#[cfg(target_os = "linux")]
mod prints;
pub mod protocol;
#[cfg(target_os = "linux")]
mod sealed;

#[cfg(target_os = "linux")]
use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
#[cfg(target_os = "linux")]
use std::thread::ThreadId;

use serde::{Deserialize, Serialize};

use crate::controller::Failure;

#[cfg(target_os = "linux")]
pub use prints::MARK;

/// Most points of a chain or a spline that a compiled controller is told.
pub const MOST_POINTS: usize = 64;

/// The program that opens the library, and the words before its own: `watch`, the library, and the memory limit in bytes.
///
/// A sandbox may stand in front: its program here, its arguments and then the program of the host as the words. It has to hand on standard input, output
/// and error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Host {
    /// The program.
    pub program: PathBuf,
    /// The words before its own.
    pub words: Vec<OsString>,
}

/// How much a compiled controller is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Time for each of opening the library, `init` and `shutdown`, ms; at least 1.
    pub start_ms: u64,
    /// Time for a tick, ms; `None` for a thousand samples, but at least [`LEAST_TICK_MS`].
    pub tick_ms: Option<u64>,
    /// Address space of its process, bytes: everything that is mapped, the program that opens the library included. A file may be as large.
    pub memory_bytes: u64,
    /// Whether every trial has a process of its own; otherwise one that did not fail is begun anew.
    pub one_trial_a_process: bool,
}

/// Least time for a tick where none is set, ms: a machine under load stops a process for tens of milliseconds.
pub const LEAST_TICK_MS: u64 = 100;

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            start_ms: 5000,
            tick_ms: None,
            memory_bytes: 512 << 20,
            one_trial_a_process: false,
        }
    }
}

impl Limits {
    /// The time for a tick of a rig, ms.
    pub fn tick_ms(&self, sample_s: f64) -> u64 {
        const SAMPLES: f64 = 1000.0;
        // What is not finite becomes 0, what is too large the largest.
        let samples_ms = (SAMPLES * sample_s * 1000.0) as u64;
        let ms = self.tick_ms.unwrap_or(samples_ms.max(LEAST_TICK_MS));
        ms.max(1)
    }
}

/// A compiled controller behind `rigproof_controller.h`.
///
/// It keeps the processes that are at rest, one for every thread that ran a trial. All of them, and whatever they started, end with it.
#[derive(Debug)]
#[cfg_attr(
    not(target_os = "linux"),
    expect(dead_code, reason = "nothing is run there")
)]
pub struct Foreign {
    #[cfg(target_os = "linux")]
    library: sealed::Sealed,
    /// What of its protection the system does not give.
    lacks: Vec<String>,
    host: Host,
    limits: Limits,
    #[cfg(target_os = "linux")]
    idle: Mutex<HashMap<ThreadId, child::Child>>,
    between: Mutex<Vec<Between>>,
}

/// What went wrong where no trial can say it, since the threads decide which trials share a process: an `init` that works in a new process and after its
/// own trial, but did not after another trial, or processes that were started after the last trial was over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Between {
    /// What, in words.
    pub what: String,
    /// How often.
    pub times: u64,
}

/// Most kinds of failures between trials that are kept.
const MOST_BETWEEN: usize = 100;

impl Foreign {
    /// The controller in this shared library, whose bytes are read now and never again; nothing is started yet. From now on this process's memory is closed to
    /// others of its user, where the system can do that.
    ///
    /// # Errors
    /// [`Failure::Unusable`]: it cannot be read.
    pub fn new(library: &Path, host: Host, limits: Limits) -> Result<Foreign, Failure> {
        let unreadable = |error: std::io::Error| {
            Failure::Unusable(format!("{} cannot be read: {error}", library.display()))
        };
        #[cfg(not(target_os = "linux"))]
        std::fs::metadata(library).map_err(unreadable)?;
        Ok(Foreign {
            #[cfg(target_os = "linux")]
            library: sealed::Sealed::of(library).map_err(unreadable)?,
            #[cfg(target_os = "linux")]
            lacks: sealed::closed_to_others(),
            #[cfg(not(target_os = "linux"))]
            lacks: Vec::new(),
            host,
            limits,
            #[cfg(target_os = "linux")]
            idle: Mutex::new(HashMap::new()),
            between: Mutex::new(Vec::new()),
        })
    }

    /// The SHA-256 of the library's bytes, those that every process opens.
    pub fn sha256(&self) -> &str {
        #[cfg(target_os = "linux")]
        return &self.library.sha256;
        #[cfg(not(target_os = "linux"))]
        return "";
    }

    /// What of the protection from its controller this system does not give, a sentence each.
    pub fn lacks(&self) -> &[String] {
        &self.lacks
    }

    /// What went wrong between trials so far.
    pub fn between_trials(&self) -> Vec<Between> {
        held(&self.between).clone()
    }

    /// Keeps a failure between trials.
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "nothing is run there")
    )]
    fn keep(&self, what: String) {
        let mut kept = held(&self.between);
        if let Some(same) = kept.iter_mut().find(|between| between.what == what) {
            same.times += 1;
        } else if kept.len() < MOST_BETWEEN {
            kept.push(Between { what, times: 1 });
        }
    }
}

/// What a lock holds; a thread that panicked left it whole, since it is changed by single calls.
fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(not(target_os = "linux"))]
impl Foreign {
    /// Opens the library once.
    ///
    /// # Errors
    /// [`Failure::Unusable`]: compiled controllers are run on Linux only.
    pub fn check(&self) -> Result<(), Failure> {
        Err(elsewhere())
    }

    /// Ends every process that is at rest: none is.
    pub fn end(&self) {}
}

#[cfg(not(target_os = "linux"))]
impl crate::controller::Source for Foreign {
    fn begin(
        &self,
        _settings: &rigproof_impl::tick::Settings,
        _path: &crate::controller::Task,
    ) -> Result<Box<dyn crate::controller::Controller + '_>, Failure> {
        Err(elsewhere())
    }
}

#[cfg(not(target_os = "linux"))]
impl crate::axis::controller::Source for Foreign {
    fn begin(
        &self,
        _settings: &crate::axis::controller::Settings,
        _place: crate::axis::controller::Place,
    ) -> Result<Box<dyn crate::axis::controller::Controller + '_>, Failure> {
        Err(elsewhere())
    }
}

#[cfg(not(target_os = "linux"))]
fn elsewhere() -> Failure {
    Failure::Unusable(
        "a compiled controller is run in a process with limits, which this build knows on Linux only: run the campaign there"
            .to_owned(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tick_has_a_thousand_samples_and_never_too_little() {
        let limits = Limits::default();
        assert_eq!(limits.tick_ms(0.002), 2000);
        assert_eq!(limits.tick_ms(0.000_03), LEAST_TICK_MS);
        assert_eq!(limits.tick_ms(f64::NAN), LEAST_TICK_MS);
        let set = Limits {
            tick_ms: Some(7),
            ..limits
        };
        assert_eq!(set.tick_ms(0.002), 7);
    }
}
