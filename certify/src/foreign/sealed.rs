//! This file keeps a library's bytes in a sealed file in memory: what was hashed is what every process opens, whatever becomes of the file.

use std::ffi::OsString;
use std::fs::File;
use std::io::Write;
use std::os::fd::{AsRawFd, OwnedFd};
use std::path::{Path, PathBuf};

use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, memfd_create};
use rustix::io::{FdFlags, fcntl_dupfd_cloexec, fcntl_setfd};
use rustix::process::{DumpableBehavior, geteuid, set_dumpable_behavior};

use crate::digest;

/// The lowest number of the descriptor of such a file.
const NUMBER: i32 = 200;
/// The largest library, bytes.
const LARGEST: u64 = 256 << 20;

/// A library that nobody can change any more.
#[derive(Debug)]
pub struct Sealed {
    /// Open as long as this lives; inherited by the processes that open it, and closed there once they have.
    memory: OwnedFd,
    name: PathBuf,
    /// The SHA-256 of its bytes.
    pub sha256: String,
}

impl Sealed {
    /// Reads a file once.
    ///
    /// # Errors
    /// It cannot be read, is none, is too large, or the system keeps no such memory.
    pub fn of(file: &Path) -> std::io::Result<Sealed> {
        let opened = File::open(file)?;
        let length = opened.metadata()?.len();
        if !opened.metadata()?.is_file() || length > LARGEST {
            let problem = format!("it is no file of at most {} MiB", LARGEST >> 20);
            return Err(std::io::Error::other(problem));
        }
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut std::io::Read::take(opened, LARGEST), &mut bytes)?;
        let memory = memfd_create(
            "rigproof-controller",
            MemfdFlags::ALLOW_SEALING | MemfdFlags::CLOEXEC,
        )?;
        let mut written = File::from(memory);
        written.write_all(&bytes)?;
        let memory = OwnedFd::from(written);
        // Out of the way of those that a process opens itself.
        let memory = fcntl_dupfd_cloexec(&memory, NUMBER)?;
        // It has to outlive the start of a program.
        fcntl_setfd(&memory, FdFlags::empty())?;
        let all = SealFlags::WRITE | SealFlags::GROW | SealFlags::SHRINK | SealFlags::SEAL;
        fcntl_add_seals(&memory, all)?;
        Ok(Sealed {
            name: file.canonicalize()?,
            sha256: digest::of_bytes(&bytes),
            memory,
        })
    }

    /// What a process that inherits it is told: the number of the descriptor, and after a colon the name of the file, for people.
    pub fn told(&self) -> OsString {
        let mut told = OsString::from(format!("{}:", self.memory.as_raw_fd()));
        told.push(&self.name);
        told
    }
}

/// Closes this process's memory to every other of the same user, and says what of its protection this system does not give.
pub fn closed_to_others() -> Vec<String> {
    let mut lacks = Vec::new();
    if set_dumpable_behavior(DumpableBehavior::NotDumpable).is_err() {
        lacks.push(
            "the campaign's memory is open to processes of its user: the system does not close it"
                .to_owned(),
        );
    }
    if geteuid().is_root() {
        lacks.push("it ran as root, who reads and writes the memory of any process through /proc: run the campaign as another user".to_owned());
    }
    if !Path::new("/proc/sys/kernel/seccomp/actions_avail").exists() {
        lacks.push("the system has no filter of calls (seccomp): it could trace processes and use the network".to_owned());
    }
    lacks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_read_stays_as_it_was_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.so");
        std::fs::write(&file, "first").unwrap();
        let sealed = Sealed::of(&file).unwrap();
        std::fs::write(&file, "second").unwrap();
        let path = format!("/proc/self/fd/{}", sealed.memory.as_raw_fd());
        assert_eq!(std::fs::read(&path).unwrap(), b"first");
        assert!(sealed.told().to_str().unwrap().ends_with("/a.so"));
        assert_eq!(sealed.sha256, digest::of_bytes(b"first"));
        assert!(
            File::options()
                .write(true)
                .open(&path)
                .and_then(|mut own| own.write_all(b"x"))
                .is_err()
        );
        assert!(Sealed::of(folder.path()).is_err());
    }
}
