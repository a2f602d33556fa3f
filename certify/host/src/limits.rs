//! This file takes from a process, before it opens a library, what a controller has no need of.

use rustix::io::Errno;
use rustix::process::{Resource, Rlimit, Signal, set_parent_process_death_signal, setrlimit};
use rustix::thread::set_no_new_privs;

/// Limits this process and all that it will start: memory and files, no dumps, no other rights, and an end with the watch.
///
/// # Errors
/// What the system answers.
pub fn limit(memory_bytes: u64) -> Result<(), Errno> {
    let of = |most| Rlimit {
        current: Some(most),
        maximum: Some(most),
    };
    set_parent_process_death_signal(Some(Signal::KILL))?;
    set_no_new_privs(true)?;
    setrlimit(Resource::Core, of(0))?;
    setrlimit(Resource::Fsize, of(memory_bytes))?;
    setrlimit(Resource::As, of(memory_bytes))
}
