//! This file answers for a controller: what it is asked over a private descriptor it asks the library, and says what came of it.

use std::ffi::{c_char, c_int, c_void};
use std::io::{self, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;

use rigproof_certify::foreign::MARK;
use rigproof_certify::foreign::link::Link;
use rigproof_certify::foreign::protocol::{LOST, Message};
use rustix::stdio::{dup2_stdin, stdin};

use crate::axis::call as axis;
use crate::call::{Controller, Outcome};
use crate::descendants::beside_this;
use crate::library::Opened;
use crate::limits::limit;
use crate::owner::{Whose, is_libc, whose};
use crate::watch::{inherited, private};

// Of the C library that this program is linked to.
unsafe extern "C" {
    static stdout: *mut c_void;
    fn setvbuf(stream: *mut c_void, buffer: *mut c_char, mode: c_int, size: usize) -> c_int;
    fn fflush(stream: *mut c_void) -> c_int;
}

/// `_IOLBF`: a line is written when it is whole.
const BY_LINES: c_int = 1;

/// Works until nobody asks any more; the exit code. Standard input is what it is asked over; it is empty for the controller, whose prints go where this process's do.
pub fn work(library: &Path, memory_bytes: u64) -> u8 {
    let Ok(mut link) = connection() else {
        return LOST as u8;
    };
    let first = match limit(memory_bytes) {
        Ok(()) => opened(library),
        Err(error) => Err(format!("its process cannot be limited: {error}")),
    };
    let (exports, first) = match first {
        Ok(exports) => (Some(exports), Message::Done),
        Err(text) => (None, Message::Unusable(text)),
    };
    if link.send(0, &first).is_ok()
        && let Some(exports) = exports
    {
        answer(&mut link, &mut Either::new(exports));
    }
    // The controller may have closed its descriptor, which must not be closed again.
    std::mem::forget(link);
    LOST as u8
}

/// Opens the library, and closes the descriptor that it came in.
fn opened(library: &Path) -> Result<Opened, String> {
    let before = linked();
    let exports = match inherited(library) {
        None => Opened::of(library),
        Some((number, name)) => {
            let path = format!("/proc/self/fd/{number}");
            let exports = Opened::of(Path::new(&path));
            // SAFETY: it was handed down for this library alone, and nothing in this process holds it.
            unsafe { rustix::io::close(number) };
            exports.map_err(|why| why.replace(&path, name))
        }
    }?;
    let after = linked();
    let own = after.iter().filter(|file| !before.contains(file));
    let libc = before.iter().find(|file| is_libc(file));
    let mut others = own.map(|file| (file, whose(file, libc)));
    match others.find(|(_, whose)| *whose != Whose::TheSystem) {
        None => Ok(exports),
        Some((file, Whose::CannotBeTold)) => Err(format!(
            "it links to {file}, and whether that is the system's cannot be told here: this user namespace does not map its owner; run the campaign outside of it, or link that in statically"
        )),
        Some((file, _)) => Err(format!(
            "it links to {file}, which its hash does not name: link that in statically, so that the controller is one file"
        )),
    }
}

/// The files that code of this process was loaded from.
fn linked() -> Vec<String> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    let path = |line: &str| Some(line.get(line.find('/')?..)?.to_owned());
    let mut files: Vec<String> = maps.lines().filter_map(path).collect();
    files.dedup();
    // The library itself is memory.
    files.retain(|file| !file.starts_with("/memfd:"));
    files
}

/// The connection, out of the controller's way.
fn connection() -> io::Result<Link> {
    let link = Link::new(UnixStream::from(private(stdin())?));
    dup2_stdin(std::fs::File::open("/dev/null")?)?;
    // SAFETY: nothing has been printed yet, and the stream is the C library's own.
    unsafe { setvbuf(stdout, std::ptr::null_mut(), BY_LINES, 0) };
    Ok(link)
}

/// A controller behind either header.
enum Either {
    FiveBar(Controller),
    Axis(axis::Controller),
}

impl Either {
    fn new(opened: Opened) -> Either {
        match opened {
            Opened::FiveBar(exports) => Either::FiveBar(Controller::new(exports)),
            Opened::Axis(exports) => Either::Axis(axis::Controller::new(exports)),
        }
    }

    /// What it answers to a message; `None` where nobody asks that.
    fn answer(&mut self, message: Message) -> Option<Message> {
        Some(match (message, self) {
            (Message::Begin(begin), Either::FiveBar(own)) => done(own.init(&begin)),
            (Message::BeginAxis(settings), Either::Axis(own)) => done(own.init(&settings)),
            (Message::Begin(_), Either::Axis(_)) => Message::Unusable(
                "it is a controller of an axis (rigproof_axis_controller.h): write `plant = \"axis\"`".to_owned(),
            ),
            (Message::BeginAxis(_), Either::FiveBar(_)) => Message::Unusable(
                "it is a controller of the five-bar (rigproof_controller.h): one of an axis exports the functions of rigproof_axis_controller.h".to_owned(),
            ),
            (Message::Tick(sensed), Either::FiveBar(own)) => told(own.tick(&sensed), Message::Currents),
            (Message::TickAxis(sensed), Either::Axis(own)) => told(own.tick(&sensed), Message::Effort),
            (Message::Over, own) => {
                let over = match own {
                    Either::FiveBar(own) => own.shutdown(),
                    Either::Axis(own) => own.shutdown(),
                };
                match (done(over), beside_this()) {
                    (Message::Done, left) if left > 0 => Message::Left(left),
                    (done, _) => done,
                }
            }
            // Nothing else is asked.
            _ => return None,
        })
    }
}

/// Answers until the connection ends.
fn answer(link: &mut Link, controller: &mut Either) {
    while let Ok((number, message)) = link.receive() {
        if let Message::Begin(_) | Message::BeginAxis(_) = message {
            mark();
        }
        let Some(answer) = controller.answer(message) else {
            return;
        };
        if link.send(number, &answer).is_err() {
            return;
        }
    }
}

fn done(outcome: Outcome<()>) -> Message {
    told(outcome, |()| Message::Done)
}

fn told<T>(outcome: Outcome<T>, answered: fn(T) -> Message) -> Message {
    match outcome {
        Outcome::Answered(answer) => answered(answer),
        Outcome::Status(status) => Message::Status(status),
        Outcome::WroteOutside(place) => Message::WroteOutside(place),
    }
}

/// Divides the prints of one trial from those of the next.
fn mark() {
    // SAFETY: null stands for every stream of the C library.
    unsafe { fflush(std::ptr::null_mut()) };
    let mut printed = io::stdout().lock();
    // Where the prints go is the controller's to close.
    let _ = printed.write_all(MARK).and_then(|()| printed.flush());
}
