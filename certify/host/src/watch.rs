//! This file watches the process that works: when it ends, or when nobody wants it any more, everything that it started ends too.

use std::ffi::OsString;
use std::io::{self, Read};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};

use rigproof_certify::foreign::link::Link;
use rigproof_certify::foreign::protocol::{End, Message};
use rustix::io::fcntl_dupfd_cloexec;
use rustix::process::{
    DumpableBehavior, Pid, Signal, WaitId, WaitIdOptions, getpid, kill_process, kill_process_group,
    set_child_subreaper, set_dumpable_behavior, waitid,
};
use rustix::stdio::{dup2_stderr, dup2_stdin, dup2_stdout, stdin, stdout};

/// Lowest number of a descriptor of its own.
const ABOVE_STANDARD: i32 = 3;

/// The exit code of a watch that nobody could be told of.
const FAILED: u8 = 1;

/// Watches; the exit code. Standard input is the connection to the campaign, whose end ends all; standard output is handed on to the process that works, as what it
/// is asked and answers over; standard error as where the controller prints.
pub fn watch(library: &Path) -> u8 {
    close_what_was_inherited(inherited(library).map(|(number, _)| number));
    // Its memory is closed to the controller, where the system can do that.
    let _ = set_dumpable_behavior(DumpableBehavior::NotDumpable);
    let Ok(campaign) = private(stdin()) else {
        return FAILED;
    };
    let campaign = UnixStream::from(campaign);
    let Ok(wanted) = campaign.try_clone() else {
        return FAILED;
    };
    let mut link = Link::new(campaign);
    let message = match start() {
        Ok(process) => over(process, wanted),
        Err(error) => Message::Unusable(format!(
            "the process that opens the library cannot be started: {error}"
        )),
    };
    match link.send(0, &message) {
        Ok(()) => 0,
        // Nobody wants to know.
        Err(_) => FAILED,
    }
}

/// What a library is told as: the descriptor that holds its bytes, with its name behind a colon, or the path of a file.
pub fn inherited(library: &Path) -> Option<(i32, &str)> {
    let (number, name) = library.to_str()?.split_once(':')?;
    let number = number.parse().ok()?;
    (number >= ABOVE_STANDARD).then_some((number, name))
}

/// Closes whatever the program was started with beside its standard descriptors and the library: it is nothing of the controller's.
fn close_what_was_inherited(library: Option<i32>) {
    const OPEN: &str = "/proc/self/fd";
    let Ok(entries) = std::fs::read_dir(OPEN) else {
        return;
    };
    let listed: Vec<i32> = entries
        .flatten()
        .filter_map(|entry| entry.file_name().to_str()?.parse().ok())
        .filter(|number| *number >= ABOVE_STANDARD && Some(*number) != library)
        .collect();
    // The list's own is closed by now.
    let is_open = |number: &i32| std::fs::symlink_metadata(format!("{OPEN}/{number}")).is_ok();
    for number in listed.into_iter().filter(is_open) {
        // SAFETY: it is open, and nothing in this program, which has opened nothing yet, holds it.
        unsafe { rustix::io::close(number) };
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
    let state = Arc::new(Mutex::new(State::Works));
    let seen = Arc::clone(&state);
    std::thread::spawn(move || {
        // Nothing is ever said: this returns when the other end is gone.
        let _ = wanted.read(&mut [0]);
        let mut state = seen.lock().unwrap_or_else(PoisonError::into_inner);
        if let State::Works = *state
            && !has_ended(pid)
        {
            *state = State::Ended(others(pid));
            end(pid);
        }
    });
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
    while let Err(rustix::io::Errno::INTR) = waitid(WaitId::Pid(pid), options) {}
    let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
    let (by_itself, left) = match *state {
        State::Works => (true, others(pid)),
        State::Ended(left) => (false, left),
    };
    // Its number is still that of its group, until it is waited for.
    *state = State::Ended(left);
    end(pid);
    drop(state);
    let status = process.wait();
    crate::descendants::end_all();
    let end = match status {
        Ok(status) if by_itself => how(status),
        _ => End::Lost,
    };
    Message::Ended(end, left)
}

/// Whether a process has ended that was not waited for.
fn has_ended(pid: Pid) -> bool {
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT | WaitIdOptions::NOHANG;
    matches!(waitid(WaitId::Pid(pid), options), Ok(Some(_)))
}

/// What is known of the process.
enum State {
    /// It has not been ended, and its number is its own.
    Works,
    /// It was ended here; so many others that it had started were there.
    Ended(u32),
}

/// How many processes there are beside the one that works.
fn others(pid: Pid) -> u32 {
    let all = crate::descendants::descendants();
    all.iter().filter(|process| **process != pid).count() as u32
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
