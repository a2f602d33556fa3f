//! This file runs one process of a controller: starts it, asks it, and ends it with all that it started.

use std::ffi::OsStr;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio};

use tempfile::TempDir;

use super::link::{Broken, Link};
use super::phase::Phase;
use super::prints::Prints;
use super::protocol::{End, Message};
use super::{Host, Limits};
use crate::controller::Failure;

/// Time for a process that closed its connection to be seen to end, ms.
const CLOSING_MS: u64 = 1000;
/// Time for the watch to end everything, ms; it gives up sooner.
const ENDING_MS: u64 = 15_000;

/// A process with the library open, its watch beside it.
#[derive(Debug)]
pub struct Child {
    watch: std::process::Child,
    /// To the watch: closing it ends all. From it: how the process ended.
    control: Link,
    /// To the process with the library.
    link: Link,
    prints: Option<Prints>,
    number: u64,
    /// The asks of this trial's ticks so far.
    ticks: u64,
    limits: Limits,
    stopped: Option<Stopped>,
    /// Where the process runs; goes with this.
    _folder: TempDir,
}

/// What was learnt at the end.
#[derive(Clone, Debug, Default)]
pub struct Stopped {
    /// How the process ended, if the watch said so.
    pub end: Option<End>,
    /// How many processes that it had started were ended.
    pub left: u32,
    /// What the watch said if it could not start the process.
    refused: Option<String>,
}

impl Child {
    /// A process that has opened the library.
    ///
    /// # Errors
    /// [`Failure`]: it cannot be started, or the library cannot be opened.
    pub fn start(library: &OsStr, host: &Host, limits: &Limits) -> Result<Child, Failure> {
        let mut child = spawn(library, host, limits).map_err(|error| {
            Failure::Unusable(format!("its process cannot be started: {error}"))
        })?;
        child.answered(Phase::Open, limits.start_ms)?;
        Ok(child)
    }

    /// Asks, and waits for the answer: [`Message::Done`], [`Message::Currents`] or [`Message::Effort`].
    ///
    /// # Errors
    /// [`Failure`]: the process has been ended, with everything that it had started.
    pub fn ask(
        &mut self,
        phase: Phase,
        message: &Message,
        limit_ms: u64,
    ) -> Result<Message, Failure> {
        self.number += 1;
        let sent = match self.link.limit(limit_ms) {
            Ok(()) => self.link.send(self.number, message),
            Err(broken) => Err(broken),
        };
        match sent {
            Ok(()) => self.answered(phase, limit_ms),
            Err(broken) => Err(self.broke(phase, limit_ms, broken)),
        }
    }

    fn answered(&mut self, phase: Phase, limit_ms: u64) -> Result<Message, Failure> {
        let answer = match self.link.limit(limit_ms) {
            Ok(()) => self.link.receive(),
            Err(broken) => Err(broken),
        };
        let failure = match answer {
            Ok((number, answer)) if number == self.number => match answer {
                Message::Done | Message::Currents(_) | Message::Effort(_) => return Ok(answer),
                Message::Unusable(text) => Failure::Unusable(text),
                Message::WroteOutside(text) => Failure::WroteOutside(text),
                Message::Status(status) if phase == Phase::Init => Failure::Refused(format!(
                    "init answered with status {status}{}",
                    self.last_prints()
                )),
                Message::Status(status) => Failure::Status(status),
                Message::Left(count) => Failure::LeftRunning(count),
                other => Failure::Garbage(format!("{other:?}, {phase}")),
            },
            Ok((number, _)) => Failure::Garbage(format!(
                "an answer to request {number} when request {} was made, {phase}",
                self.number
            )),
            Err(broken) => return Err(self.broke(phase, limit_ms, broken)),
        };
        self.stop();
        Err(failure)
    }

    /// Ends the process and says what happened.
    fn broke(&mut self, phase: Phase, limit_ms: u64, broken: Broken) -> Failure {
        match broken {
            Broken::Late => {
                self.stop();
                Failure::Hung { limit_ms }
            }
            Broken::Garbage(text) => {
                self.stop();
                Failure::Garbage(format!("{text}, {phase}"))
            }
            Broken::Closed => self.ended(phase),
        }
    }

    fn ended(&mut self, phase: Phase) -> Failure {
        // One that ended says so soon; one that does not has only closed its connection, and is ended.
        if let Some(stopped) = self.heard(CLOSING_MS) {
            self.stopped = Some(stopped);
        }
        let Stopped { end, left, refused } = self.stop();
        let prints = self.last_prints();
        if let Some(text) = refused {
            return Failure::Unusable(text);
        }
        let Some(end) = end else {
            return self.unwatched(phase, &prints);
        };
        let words = end.words(self.limits.memory_bytes);
        Failure::Ended(format!("{phase}: {words}{}{prints}", of_left(left)))
    }

    /// What is said of a process whose watch ended without a word.
    fn unwatched(&mut self, phase: Phase, prints: &str) -> Failure {
        let status = match self.watch.try_wait() {
            Ok(Some(status)) => status.to_string(),
            _ => "no status".to_owned(),
        };
        match phase {
            Phase::Open => Failure::Unusable(format!(
                "the program that opens the library ended before it could ({status}){prints}"
            )),
            _ => Failure::Ended(format!(
                "{phase}: and the process that watches it, which a controller must leave alone ({status}){prints}"
            )),
        }
    }

    /// What the watch says within this time.
    fn heard(&mut self, limit_ms: u64) -> Option<Stopped> {
        self.control.limit(limit_ms).ok()?;
        match self.control.receive() {
            Ok((_, Message::Ended(end, left))) => Some(Stopped {
                end: Some(end),
                left,
                refused: None,
            }),
            Ok((_, Message::Unusable(text))) => Some(Stopped {
                refused: Some(text),
                ..Stopped::default()
            }),
            _ => None,
        }
    }

    /// Ends the process and whatever it started, and waits until they are gone.
    pub fn stop(&mut self) -> Stopped {
        self.control.close();
        if self.stopped.is_none() {
            let heard = self.heard(ENDING_MS);
            if heard.is_none() {
                // A watch that says nothing is none; one that has ended is only waited for.
                let _ = self.watch.kill();
            }
            self.stopped = Some(heard.unwrap_or_default());
        }
        // Of the program's own children, whose status nobody else takes: waiting does not fail.
        let _ = self.watch.wait();
        self.stopped.clone().unwrap_or_default()
    }

    fn last_prints(&mut self) -> String {
        self.stop();
        let prints = self.prints.take();
        prints.map(|prints| prints.last()).unwrap_or_default()
    }

    /// The number of the next tick of the trial, from 1.
    pub fn next_tick(&mut self) -> u64 {
        self.ticks += 1;
        self.ticks
    }

    /// Forgets how many ticks there were.
    pub fn forget_ticks(&mut self) {
        self.ticks = 0;
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        self.stop();
    }
}

/// Words about processes that were left.
pub fn of_left(left: u32) -> String {
    match left {
        0 => String::new(),
        1 => "; a process that it had started was ended".to_owned(),
        _ => format!("; {left} processes that it had started were ended"),
    }
}

fn spawn(library: &OsStr, host: &Host, limits: &Limits) -> std::io::Result<Child> {
    let folder = TempDir::new()?;
    let (control, of_watch) = UnixStream::pair()?;
    let (link, of_process) = UnixStream::pair()?;
    let mut watch = Command::new(&host.program)
        .args(&host.words)
        .arg("watch")
        .arg(library)
        .arg(limits.memory_bytes.to_string())
        .env_clear()
        .current_dir(folder.path())
        .stdin(OwnedFd::from(of_watch))
        .stdout(OwnedFd::from(of_process))
        .stderr(Stdio::piped())
        .process_group(0)
        .spawn()?;
    let prints = watch.stderr.take().map(Prints::of);
    Ok(Child {
        watch,
        control: Link::new(control),
        link: Link::new(link),
        prints,
        number: 0,
        ticks: 0,
        limits: *limits,
        stopped: None,
        _folder: folder,
    })
}
