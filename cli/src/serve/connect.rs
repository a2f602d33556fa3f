//! This file holds the connections of the local page: none waits for another, none lasts without end, and all together are bounded.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::answer::{Site, answer};
use super::head::asked;

/// Most connections that are open at once; one more ends the oldest.
const MOST_OPEN: usize = 256;
/// Most bytes of answers that are held for readers; more ends the oldest that hold any.
const MOST_HELD: usize = 48 << 20;
/// Longest head of a request, bytes.
const LONGEST_HEAD: usize = 64 << 10;
/// Time for a whole head.
const HEAD_WITHIN: Duration = Duration::from_secs(5);
/// Time without a byte taken, after which a reader is given up, and time for a whole answer.
const TAKEN_WITHIN: Duration = Duration::from_secs(5);
const READ_WITHIN: Duration = Duration::from_secs(120);
/// Time in which what a client sends beyond its head is passed over, and the most of it, so that it sees the answer.
const DRAINED_WITHIN: Duration = Duration::from_millis(300);
const MOST_DRAINED: usize = 256 << 10;
/// Pause after the system refused a connection: mostly it has no descriptors left.
const PAUSE: Duration = Duration::from_millis(20);
/// Stack of a connection's thread, bytes.
const STACK: usize = 1 << 20;

/// What is sent.
pub enum Body {
    /// These bytes.
    Bytes(Vec<u8>),
    /// So many bytes of a file.
    File(File, u64),
}

impl Body {
    /// Its length, bytes.
    pub fn len(&self) -> u64 {
        match self {
            Body::Bytes(bytes) => bytes.len() as u64,
            Body::File(_, length) => *length,
        }
    }
}

/// A connection that is open.
struct Open {
    number: u64,
    stream: TcpStream,
    /// Bytes of an answer that are held for it.
    held: usize,
}

/// The connections, the oldest first.
#[derive(Default)]
struct Door(Mutex<VecDeque<Open>>);

impl Door {
    fn all(&self) -> MutexGuard<'_, VecDeque<Open>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn enter(&self, number: u64, stream: TcpStream) {
        let mut all = self.all();
        while all.len() >= MOST_OPEN {
            all.pop_front().into_iter().for_each(end);
        }
        let held = 0;
        all.push_back(Open {
            number,
            stream,
            held,
        });
    }

    /// Counts what is held for a connection.
    fn holds(&self, number: u64, bytes: usize) {
        let mut all = self.all();
        if let Some(own) = all.iter_mut().find(|open| open.number == number) {
            own.held = bytes;
        }
        let mut held: usize = all.iter().map(|open| open.held).sum();
        while held > MOST_HELD {
            let oldest = all.iter().position(|open| open.held > 0);
            let Some(oldest) = oldest.and_then(|place| all.remove(place)) else {
                break;
            };
            held -= oldest.held;
            end(oldest);
        }
    }

    fn leave(&self, number: u64) {
        self.all().retain(|open| open.number != number);
    }
}

/// Ends a connection: its thread sees that.
fn end(open: Open) {
    // What is closed already is what is wanted.
    let _ = open.stream.shutdown(Shutdown::Both);
}

/// Lets everybody in who asks this machine, until the program ends.
pub fn listen(listener: &TcpListener, site: &Arc<Site>) {
    let door = Arc::new(Door::default());
    for number in 0.. {
        let Ok((stream, _)) = listener.accept() else {
            thread::sleep(PAUSE);
            continue;
        };
        let Ok(own) = stream.try_clone() else {
            continue;
        };
        door.enter(number, own);
        let (site, inside) = (Arc::clone(site), Arc::clone(&door));
        let talk = move || {
            // A client that is gone is no fault.
            let _ = talk(&site, &inside, number, stream);
            inside.leave(number);
        };
        if thread::Builder::new()
            .stack_size(STACK)
            .spawn(talk)
            .is_err()
        {
            door.leave(number);
        }
    }
}

/// One request and its answer.
fn talk(site: &Site, door: &Door, number: u64, mut stream: TcpStream) -> io::Result<()> {
    stream.set_write_timeout(Some(TAKEN_WITHIN))?;
    let asked = match head(&mut stream)? {
        Head::Whole(bytes) => asked(&bytes),
        Head::TooLong => Err((431, "The head of the request is too long.")),
        Head::TooLate => Err((408, "The request did not come within its time.")),
        Head::Cut => return Ok(()),
    };
    let (head, body) = answer(site, asked);
    if let Body::Bytes(bytes) = &body {
        door.holds(number, bytes.len());
    }
    let until = Instant::now() + READ_WITHIN;
    send(&mut stream, head.as_bytes(), until)?;
    match body {
        Body::Bytes(bytes) => send(&mut stream, &bytes, until)?,
        Body::File(file, length) => copy(&mut stream, file.take(length), until)?,
    }
    stream.shutdown(Shutdown::Write)?;
    drain(&mut stream)
}

/// What came of waiting for a head.
enum Head {
    Whole(Vec<u8>),
    TooLong,
    TooLate,
    Cut,
}

/// Reads until an empty line.
fn head(stream: &mut TcpStream) -> io::Result<Head> {
    let until = Instant::now() + HEAD_WITHIN;
    let mut read = Vec::new();
    let mut some = [0; 4096];
    loop {
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Ok(Head::TooLate);
        }
        stream.set_read_timeout(Some(left))?;
        let count = match stream.read(&mut some) {
            Ok(0) => return Ok(Head::Cut),
            Ok(count) => count,
            Err(error) if is_late(&error) => return Ok(Head::TooLate),
            Err(error) => return Err(error),
        };
        let from = read.len().saturating_sub(3);
        read.extend_from_slice(some.get(..count).unwrap_or_default());
        let fresh = read.get(from..).unwrap_or_default();
        if fresh.windows(4).any(|four| four == b"\r\n\r\n")
            || fresh.windows(2).any(|two| two == b"\n\n")
        {
            return Ok(Head::Whole(read));
        }
        if read.len() > LONGEST_HEAD {
            return Ok(Head::TooLong);
        }
    }
}

fn is_late(error: &io::Error) -> bool {
    let kinds = [io::ErrorKind::WouldBlock, io::ErrorKind::TimedOut];
    kinds.contains(&error.kind())
}

/// Sends bytes piece by piece: a reader that takes none for some time, or all too slowly, is given up.
fn send(stream: &mut TcpStream, bytes: &[u8], until: Instant) -> io::Result<()> {
    for piece in bytes.chunks(1 << 16) {
        if Instant::now() > until {
            return Err(io::ErrorKind::TimedOut.into());
        }
        stream.write_all(piece)?;
    }
    Ok(())
}

fn copy(stream: &mut TcpStream, mut from: impl Read, until: Instant) -> io::Result<()> {
    let mut some = vec![0; 1 << 16];
    loop {
        let count = from.read(&mut some)?;
        match some.get(..count) {
            Some(read) if count > 0 => send(stream, read, until)?,
            _ => return Ok(()),
        }
    }
}

/// Passes over what is sent beyond the head, within bounds: a connection that is closed on unread bytes takes the answer with it.
fn drain(stream: &mut TcpStream) -> io::Result<()> {
    let until = Instant::now() + DRAINED_WITHIN;
    let (mut some, mut all) = ([0; 4096], 0);
    loop {
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() || all > MOST_DRAINED {
            return Ok(());
        }
        stream.set_read_timeout(Some(left))?;
        match stream.read(&mut some)? {
            0 => return Ok(()),
            count => all += count,
        }
    }
}
