//! This file watches the process that works: when it ends, or when nobody wants it any more, everything that it started ends too.

use std::ffi::OsString;
use std::io::{self, Read};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};

use rigproof_certify::foreign::link::Link;
use rigproof_certify::foreign::protocol::{End, Message};
use rustix::io::fcntl_dupfd_cloexec;
use rustix::process::{
    Pid, Signal, WaitId, WaitIdOptions, getpid, kill_process, kill_process_group,
    set_child_subreaper, waitid,
};
use rustix::stdio::{dup2_stderr, dup2_stdin, dup2_stdout, stdin, stdout};

/// Lowest number of a descriptor of its own.
const ABOVE_STANDARD: i32 = 3;

/// Watches. Standard input is the connection to the campaign, whose end ends all; standard output is handed on to the process that works, as what it
/// is asked and answers over; standard error as where the controller prints.
pub fn watch() -> ExitCode {
    let Ok(campaign) = private(stdin()) else {
        return ExitCode::FAILURE;
    };
    let campaign = UnixStream::from(campaign);
    let Ok(wanted) = campaign.try_clone() else {
        return ExitCode::FAILURE;
    };
    let mut link = Link::new(campaign);
    let message = match start() {
        Ok(process) => over(process, wanted),
        Err(error) => Message::Unusable(format!(
            "the process that opens the library cannot be started: {error}"
        )),
    };
    match link.send(0, &message) {
        Ok(()) => ExitCode::SUCCESS,
        // Nobody wants to know.
        Err(_) => ExitCode::FAILURE,
    }
}

/// A descriptor of this program's own for what a standard one is.
pub fn private(standard: impl std::os::fd::AsFd) -> rustix::io::Result<OwnedFd> {
    fcntl_dupfd_cloexec(standard, ABOVE_STANDARD)
}

/// The same program as one that works; this one then keeps nothing of what it handed on, so that the other ends see an end.
fn start() -> io::Result<Child> {
    // Whatever the process leaves behind becomes this one's child.
    set_child_subreaper(Some(getpid()))?;
    let asked = private(stdout())?;
    let printed = private(rustix::stdio::stderr())?;
    let process = Command::new("/proc/self/exe")
        .args(words())
        .stdin(asked)
        .stdout(printed)
        .stderr(Stdio::inherit())
        .process_group(0)
        .spawn()?;
    let nothing = std::fs::File::options()
        .read(true)
        .write(true)
        .open("/dev/null")?;
    dup2_stdin(&nothing)?;
    dup2_stdout(&nothing)?;
    dup2_stderr(&nothing)?;
    Ok(process)
}

/// The words of this program, with the role of the one that works.
fn words() -> Vec<OsString> {
    let mut words: Vec<OsString> = std::env::args_os().skip(1).collect();
    // Role, library, limit.
    if let Some(role) = words.iter_mut().rev().nth(2) {
        *role = OsString::from("work");
    }
    words
}

/// Waits for the end, by itself or because nobody wants it any more, and says how it was.
fn over(mut process: Child, mut wanted: UnixStream) -> Message {
    let pid = Pid::from_child(&process);
    // While it holds true the number is the process's own: it has not been waited for.
    let there = Arc::new(Mutex::new(true));
    let seen = Arc::clone(&there);
    std::thread::spawn(move || {
        // Nothing is ever said: this returns when the other end is gone.
        let _ = wanted.read(&mut [0]);
        let there = seen.lock().unwrap_or_else(PoisonError::into_inner);
        if *there {
            end(pid);
        }
    });
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
    while let Err(rustix::io::Errno::INTR) = waitid(WaitId::Pid(pid), options) {}
    let mut there = there.lock().unwrap_or_else(PoisonError::into_inner);
    let left = crate::descendants::descendants().len() as u32;
    // Its number is still that of its group.
    end(pid);
    let status = process.wait();
    *there = false;
    drop(there);
    crate::descendants::end_all();
    Message::Ended(status.map_or(End::Lost, how), left)
}

/// Ends a process and its group, which need not be one any more.
fn end(pid: Pid) {
    // What has ended already is what is wanted.
    let _ = kill_process_group(pid, Signal::KILL);
    let _ = kill_process(pid, Signal::KILL);
}

fn how(status: ExitStatus) -> End {
    match (status.code(), status.signal()) {
        (Some(code), _) => End::Code(code),
        (None, Some(signal)) => End::Signal(signal),
        (None, None) => End::Lost,
    }
}
