//! This file counts and sums the bytes of a file while they pass.

use std::io::{self, Read};

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

    /// Fills the buffer with up to `count` bytes, fewer only at the end of the file; memory grows with what is
    /// there, not with what is asked for.
    pub(super) fn read(&mut self, count: u64, buffer: &mut Vec<u8>) -> io::Result<()> {
        buffer.clear();
        let read = (&mut self.inner).take(count).read_to_end(buffer)?;
        self.position += read as u64;
        Ok(())
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
            self.read((count - skipped).min(1 << 16), buffer)?;
            if buffer.is_empty() {
                break;
            }
            self.sum.update(buffer);
            skipped += buffer.len() as u64;
        }
        Ok(skipped)
    }
}
