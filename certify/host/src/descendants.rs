//! This file finds and ends the processes that a process started, directly or not.

use std::time::{Duration, Instant};

use rustix::io::Errno;
use rustix::process::{Pid, Signal, WaitOptions, getpid, getppid, kill_process, wait};

/// Time after which processes that do not end are left, ms: they wait for a device.
const MOST_MS: u64 = 10_000;

/// The living descendants of this process.
pub fn descendants() -> Vec<Pid> {
    of(getpid())
}

/// Time for a process that was told to end, ms.
const ENDING_MS: u64 = 100;

/// How many processes beside this one its parent has: those that this one started, whose parents may have ended. One that is about to end is waited for.
pub fn beside_this() -> u32 {
    let begun = Instant::now();
    loop {
        let all = getppid().map(of).unwrap_or_default();
        let others = all.iter().filter(|process| **process != getpid()).count();
        if others == 0 || begun.elapsed() > Duration::from_millis(ENDING_MS) {
            return others as u32;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The living descendants of a process.
fn of(process: Pid) -> Vec<Pid> {
    let parents = parents();
    let mut found = vec![process];
    let mut looked_at = 0;
    while let Some(parent) = found.get(looked_at).copied() {
        let children = parents.iter().filter(|(_, of)| *of == parent);
        found.extend(children.map(|(child, _)| *child));
        looked_at += 1;
    }
    found.remove(0);
    found
}

/// Ends the children of this process, and those whose parents ended before them, until there is none. This process has to be their reaper.
pub fn end_all() {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_millis(MOST_MS) {
        match wait(WaitOptions::NOHANG) {
            Ok(Some(_)) => {}
            Ok(None) => {
                for process in descendants() {
                    // One that has ended meanwhile is what is wanted.
                    let _ = kill_process(process, Signal::KILL);
                }
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(Errno::INTR) => {}
            // None is left.
            Err(_) => return,
        }
    }
}

/// Every living process and its parent.
fn parents() -> Vec<(Pid, Pid)> {
    let Ok(entries) = std::fs::read_dir("/proc") else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some(process) = name.to_str().and_then(number) else {
            continue;
        };
        // What has ended meanwhile is not among them.
        let Ok(stat) = std::fs::read_to_string(entry.path().join("stat")) else {
            continue;
        };
        // The name, in brackets, may hold anything; after it come the state and the parent.
        let Some((_, after)) = stat.rsplit_once(')') else {
            continue;
        };
        let mut words = after.split_whitespace();
        let (state, parent) = (words.next(), words.next().and_then(number));
        if let (Some(state), Some(parent)) = (state, parent)
            && !["Z", "X"].contains(&state)
        {
            found.push((process, parent));
        }
    }
    found
}

fn number(text: &str) -> Option<Pid> {
    Pid::from_raw(text.parse().ok()?)
}
