//! This file says what the program of the host does: watch, or work.

use std::path::PathBuf;

/// What one process of the host does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Starts the process that works, ends with it everything that it started, and says how it ended.
    Watch,
    /// Opens the library and answers for it.
    Work,
}

impl Role {
    /// The role of this name.
    pub fn of(name: &str) -> Option<Role> {
        match name {
            "watch" => Some(Role::Watch),
            "work" => Some(Role::Work),
            _ => None,
        }
    }
}

/// Does what a role does; the exit code. The words of the program that calls this end in the role, the library and the limit: a watch starts the same program with
/// the same words but for the role.
#[cfg(target_os = "linux")]
pub fn run(role: Role, library: PathBuf, memory_bytes: u64) -> u8 {
    match role {
        Role::Watch => crate::watch::watch(&library),
        Role::Work => crate::work::work(&library, memory_bytes),
    }
}

/// Refuses: the limits of a process are known on Linux only.
#[cfg(not(target_os = "linux"))]
pub fn run(_role: Role, _library: PathBuf, _memory_bytes: u64) -> u8 {
    use std::io::Write;
    // Nobody is left to be told when this fails.
    let _ = writeln!(
        std::io::stderr(),
        "error: compiled controllers are run on Linux only"
    );
    3
}
