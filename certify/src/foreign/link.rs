//! This file carries messages over a socket: one write a message, one read, no allocation once both buffers have grown.

use std::io::{ErrorKind, Read, Write};
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

use super::protocol::{HEAD, LONGEST, Message, decode, encode, head};

/// One end of a connection.
#[derive(Debug)]
pub struct Link {
    stream: UnixStream,
    inbox: Vec<u8>,
    outbox: Vec<u8>,
    limit_ms: Option<u64>,
}

/// Why no message came or went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Broken {
    /// The other end is closed.
    Closed,
    /// The time is over.
    Late,
    /// What came is no message: this.
    Garbage(String),
}

impl Link {
    /// One end of a connection, without a time limit.
    pub fn new(stream: UnixStream) -> Link {
        Link {
            stream,
            inbox: vec![0; HEAD + LONGEST],
            outbox: Vec::with_capacity(HEAD + LONGEST),
            limit_ms: None,
        }
    }

    /// Gives every wait for a message, and every write, so much time, ms; at least 1.
    ///
    /// # Errors
    /// [`Broken::Closed`]: the socket takes no limit.
    pub fn limit(&mut self, limit_ms: u64) -> Result<(), Broken> {
        if self.limit_ms != Some(limit_ms) {
            let limit = Some(Duration::from_millis(limit_ms.max(1)));
            self.stream
                .set_read_timeout(limit)
                .and_then(|()| self.stream.set_write_timeout(limit))
                .map_err(|_| Broken::Closed)?;
            self.limit_ms = Some(limit_ms);
        }
        Ok(())
    }

    /// Tells the other end that nothing more comes.
    pub fn close(&mut self) {
        // One that is closed already needs no more.
        let _ = self.stream.shutdown(Shutdown::Write);
    }

    /// Sends a message as the request of this number, or as the answer to it.
    ///
    /// # Errors
    /// [`Broken`]
    pub fn send(&mut self, number: u64, message: &Message) -> Result<(), Broken> {
        self.outbox.clear();
        encode(number, message, &mut self.outbox);
        self.stream.write_all(&self.outbox).map_err(broken)
    }

    /// The next message and the number of its request.
    ///
    /// # Errors
    /// [`Broken`]: after any of them nothing more can be read.
    pub fn receive(&mut self) -> Result<(u64, Message), Broken> {
        let mut came = 0;
        let mut since = None;
        loop {
            let free = self.inbox.get_mut(came..).unwrap_or_default();
            came += match self.stream.read(free) {
                Ok(0) if came == 0 => return Err(Broken::Closed),
                Ok(0) => return Err(garbage(self.inbox.get(..came))),
                Ok(bytes) => bytes,
                Err(error) if error.kind() == ErrorKind::Interrupted => 0,
                Err(error) => return Err(broken(error)),
            };
            let all = self.inbox.get(..came).unwrap_or_default();
            if let Some((first, body)) = all.split_first_chunk::<HEAD>() {
                let (kind, length, number) = head(first).ok_or_else(|| garbage(Some(all)))?;
                if body.len() >= length {
                    let message = decode(kind, body).ok_or_else(|| garbage(Some(all)))?;
                    return Ok((number, message));
                }
            }
            // A message comes whole; one in pieces is given the time of one wait more.
            let since: &Instant = since.get_or_insert_with(Instant::now);
            let limit = self.limit_ms.map(Duration::from_millis);
            if limit.is_some_and(|limit| since.elapsed() > limit) {
                return Err(Broken::Late);
            }
        }
    }
}

fn broken(error: std::io::Error) -> Broken {
    match error.kind() {
        ErrorKind::WouldBlock | ErrorKind::TimedOut => Broken::Late,
        _ => Broken::Closed,
    }
}

fn garbage(bytes: Option<&[u8]>) -> Broken {
    const SHOWN: usize = 16;
    let bytes = bytes.unwrap_or_default();
    let shown: Vec<String> = bytes
        .iter()
        .take(SHOWN)
        .map(|byte| format!("{byte:02x}"))
        .collect();
    Broken::Garbage(format!(
        "{} bytes that begin with {}",
        bytes.len(),
        shown.join(" ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::controller as axis;
    use crate::controller::Task;
    use crate::foreign::protocol::{Begin, End};
    use rigproof_impl::tick::{Sensed, Settings};
    use rigproof_impl::vector::Vector;
    use rigproof_spec::layout::Layout;

    fn pair() -> (Link, Link) {
        let (one, other) = UnixStream::pair().unwrap();
        (Link::new(one), Link::new(other))
    }

    fn messages() -> Vec<Message> {
        let begin = |layout, task| {
            let settings = Settings {
                counts_per_turn: [98_765, 43_210],
                zero_counts: [-17, 2_345],
                sample_s: 0.001_3,
                greatest_rate_rad_s: 29.7,
                greatest_force_n: 187.3,
                ..Settings::thesis(layout)
            };
            Message::Begin(Box::new(Begin { settings, task }))
        };
        let many_m: Vec<[f64; 2]> = (0..64).map(|k| [f64::from(k) * 0.013, -0.31]).collect();
        let arc = Task::Arc {
            centre_m: [0.011, 0.379],
            radius_m: 0.083,
            from_rad: 0.7,
            to_rad: -2.3,
        };
        vec![
            begin(Layout::ThreeBrake, Task::Chain(many_m.clone())),
            begin(Layout::FourBrake, Task::Spline(many_m)),
            begin(Layout::FourBrake, arc),
            Message::Tick(Sensed {
                number: u32::MAX - 3,
                counts: [i32::MIN + 7, 33_421],
                tip_force_n: Vector::new(-3.7, 1e-300),
            }),
            Message::BeginAxis(axis::Settings::of(true, [0.002, 1.7, 9.5, 1e-6])),
            Message::TickAxis(axis::Sensed::of(71, [0.3, -0.0, 7.1, f64::INFINITY, 1e-9])),
            Message::Over,
            Message::Done,
            Message::Effort(-3.7),
            Message::Currents([0.31, -0.0, f64::INFINITY, 1e-9]),
            Message::Status(-71),
            Message::Left(3),
            Message::WroteOutside("eight bytes".to_owned()),
            Message::Unusable("no".to_owned()),
            Message::Ended(End::Code(3), 2),
            Message::Ended(End::Signal(11), 0),
            Message::Ended(End::Lost, 1),
        ]
    }

    #[test]
    fn every_message_arrives_as_it_was_sent() {
        let (mut one, mut other) = pair();
        for (number, message) in (71_u64..).zip(messages()) {
            one.send(number, &message).unwrap();
            assert_eq!(other.receive(), Ok((number, message)));
        }
    }

    #[test]
    fn no_message_makes_a_buffer_grow() {
        let (mut one, mut other) = pair();
        let room = |link: &Link| (link.inbox.capacity(), link.outbox.capacity());
        let before = [room(&one), room(&other)];
        let longest = "x".repeat(3 * LONGEST);
        let texts = [
            Message::Unusable(longest.clone()),
            Message::WroteOutside(longest),
        ];
        for message in messages().into_iter().chain(texts) {
            one.send(3, &message).unwrap();
            other.receive().unwrap();
        }
        assert_eq!([room(&one), room(&other)], before);
    }

    #[test]
    fn a_current_that_is_no_number_keeps_its_bits() {
        let (mut one, mut other) = pair();
        let odd = f64::from_bits(0x7ff8_0000_dead_beef);
        one.send(1, &Message::Currents([odd; 4])).unwrap();
        let Ok((1, Message::Currents(currents_a))) = other.receive() else {
            panic!("no currents");
        };
        assert!(currents_a.iter().all(|a| a.to_bits() == odd.to_bits()));
    }

    #[test]
    fn a_message_in_pieces_is_one_message() {
        let (mut one, mut other) = pair();
        let mut bytes = Vec::new();
        encode(9, &Message::Currents([0.1, 0.2, 0.3, 0.4]), &mut bytes);
        let writer = std::thread::spawn(move || {
            for piece in bytes.chunks(7) {
                one.stream.write_all(piece).unwrap();
                std::thread::sleep(Duration::from_millis(2));
            }
            one
        });
        other.limit(1000).unwrap();
        let expected = Message::Currents([0.1, 0.2, 0.3, 0.4]);
        assert_eq!(other.receive(), Ok((9, expected)));
        writer.join().unwrap();
    }

    #[test]
    fn what_is_no_message_is_refused() {
        let mut whole = Vec::new();
        encode(9, &Message::Status(3), &mut whole);
        let with = |place: usize, byte: u8| {
            let mut bytes = whole.clone();
            bytes[place] = byte;
            bytes
        };
        let longer = [&whole[..], b"x"].concat();
        let much = vec![b'x'; 900];
        for bytes in [with(0, b'x'), with(3, b'?'), with(7, 0x7f), longer, much] {
            let (mut one, mut other) = pair();
            one.stream.write_all(&bytes).unwrap();
            let answer = other.receive();
            assert!(matches!(answer, Err(Broken::Garbage(_))), "{answer:?}");
        }
        // Half a message, and then nothing: late while the other end is there, garbage once it is gone.
        for (gone, expected) in [(false, "Late"), (true, "Garbage")] {
            let (mut one, mut other) = pair();
            other.limit(20).unwrap();
            one.stream.write_all(&whole[..9]).unwrap();
            if gone {
                one.close();
            }
            assert!(format!("{:?}", other.receive()).contains(expected));
        }
    }

    #[test]
    fn silence_is_late_and_an_end_is_closed() {
        let (one, mut other) = pair();
        other.limit(20).unwrap();
        assert_eq!(other.receive(), Err(Broken::Late));
        drop(one);
        assert_eq!(other.receive(), Err(Broken::Closed));
        assert_eq!(other.send(1, &Message::Over), Err(Broken::Closed));
    }
}
