//! This file counts and sums the bytes of a file while they pass.

use std::io::{self, Read};

/// Bytes that are set aside at once for what a length promises.
const STEP: usize = 1 << 20;

/// A reader that knows where it is and what the bytes since the last mark sum up to.
pub(super) struct Source<R> {
    inner: R,
    position: u64,
    sum: crc32fast::Hasher,
}

impl<R: Read> Source<R> {
    pub(super) fn new(inner: R) -> Source<R> {
        Source {
            inner,
            position: 0,
            sum: crc32fast::Hasher::new(),
        }
    }

    /// Bytes read so far.
    pub(super) fn position(&self) -> u64 {
        self.position
    }

    /// The CRC-32 of what was added since the start or the last call, and begins a new one.
    pub(super) fn take_sum(&mut self) -> u32 {
        std::mem::take(&mut self.sum).finalize()
    }

    pub(super) fn add_to_sum(&mut self, bytes: &[u8]) {
        self.sum.update(bytes);
    }

    /// Reads up to `count` bytes, fewer only at the end of the file, to the front of the buffer, and answers how many.
    /// The buffer grows with what is there, not with what is asked for, and never shrinks.
    pub(super) fn read(&mut self, count: u64, buffer: &mut Vec<u8>) -> io::Result<usize> {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let mut filled = 0;
        while filled < count {
            let end = count.min(filled + STEP);
            if buffer.len() < end {
                buffer.resize(end, 0);
            }
            let read = self.fill(buffer.get_mut(filled..end).unwrap_or_default())?;
            filled += read;
            if filled < end {
                break;
            }
        }
        Ok(filled)
    }

    /// Fills as much of the slice as there is and answers how much that was.
    pub(super) fn fill(&mut self, slice: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while let Some(rest) = slice.get_mut(filled..).filter(|rest| !rest.is_empty()) {
            match self.inner.read(rest) {
                Ok(0) => break,
                Ok(read) => filled += read,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        self.position += filled as u64;
        Ok(filled)
    }

    /// Passes over up to `count` bytes, summing them, and answers how many there were.
    pub(super) fn skip(&mut self, count: u64, buffer: &mut Vec<u8>) -> io::Result<u64> {
        let mut skipped = 0;
        while skipped < count {
            let read = self.read((count - skipped).min(1 << 16), buffer)?;
            if read == 0 {
                break;
            }
            self.sum.update(buffer.get(..read).unwrap_or_default());
            skipped += read as u64;
        }
        Ok(skipped)
    }
}
