//! This file walks over an MCAP file record by record, past damage where there is a way past it.

use std::io::{self, Read};
use std::path::Path;

use ::mcap::MAGIC;
use ::mcap::records::op;

use super::account::{Account, Section, Visitor};
use super::chunk::{self, Head, LARGEST_RECORD, RECORD_HEAD, Unpacker};
use super::guard::guarded;
use super::integrity::Integrity;
use super::source::Source;
use super::topics::Topic;
use crate::error::TraceError;

/// Walks over a file from its start; `file` is what messages name.
///
/// # Errors
/// The system refuses, or the bytes do not begin as MCAP does. Everything else ends in the account.
pub(super) fn walk<R: Read, V: Visitor>(
    source: R,
    file: &Path,
    visitor: &mut V,
) -> Result<(Vec<Topic>, Integrity), TraceError> {
    let mut walk = Walk {
        source: Source::new(source),
        account: Account::new(visitor),
        unpacker: Unpacker::default(),
        buffer: Vec::new(),
    };
    let refused = || TraceError::io("read", file);
    let mut magic = [0; MAGIC.len()];
    walk.source.fill(&mut magic).map_err(refused())?;
    if magic != *MAGIC {
        let problem = "the file does not begin as MCAP does; check how it was saved";
        return Err(TraceError::recording(file, problem));
    }
    walk.source.add_to_sum(&magic);
    while !walk.account.visitor.is_full() && walk.record().map_err(refused())? {}
    walk.account.close();
    Ok((walk.account.topics.into_topics(), walk.account.integrity))
}

struct Walk<'v, R, V> {
    source: Source<R>,
    account: Account<'v, V>,
    unpacker: Unpacker,
    buffer: Vec<u8>,
}

/// A record's place in the file.
#[derive(Clone, Copy)]
struct Extent {
    start: u64,
    length: u64,
}

impl Extent {
    fn end(self) -> u64 {
        (self.start + RECORD_HEAD as u64).saturating_add(self.length)
    }
}

impl<R: Read, V: Visitor> Walk<'_, R, V> {
    /// Reads one record; false when it was the last one.
    fn record(&mut self) -> io::Result<bool> {
        let start = self.source.position();
        let mut head = [0; RECORD_HEAD];
        let filled = self.source.fill(&mut head)?;
        let [kind, length @ ..] = head;
        let length = u64::from_le_bytes(length);
        let extent = Extent { start, length };
        if filled < RECORD_HEAD {
            let end = self.source.position();
            self.miss(format!(
                "the file ends at byte {end} without its closing part: it was cut off, or its writer was stopped"
            ));
            return Ok(false);
        }
        if kind != op::MESSAGE_INDEX {
            self.account.tell_lost();
        }
        match (kind, self.account.section) {
            (op::DATA_END, Section::Data) => {
                let sum = self.source.take_sum();
                return self.data_end(extent, sum);
            }
            (op::FOOTER, Section::Summary) => {
                self.source.add_to_sum(&head);
                return self.footer(extent);
            }
            _ => self.source.add_to_sum(&head),
        }
        let large = length > LARGEST_RECORD as u64;
        match (kind, self.account.section) {
            (op::CHUNK, Section::Data) if large => return self.endless_chunk(extent),
            (op::ATTACHMENT, _) => return self.pass_over(extent, true),
            _ if large => return self.pass_over(extent, false),
            _ => {}
        }
        let mut buffer = std::mem::take(&mut self.buffer);
        let read = self.source.read(length, &mut buffer)?;
        let content = buffer.get(..read).unwrap_or_default();
        self.source.add_to_sum(content);
        let whole = read as u64 == length;
        match (kind, self.account.section) {
            (op::CHUNK, Section::Data) => self.chunk(extent, content),
            _ if whole => {
                let taken = guarded(|| {
                    self.account.record(kind, content);
                    Ok(())
                });
                if let Err(reason) = taken {
                    self.miss(format!("the record at byte {start}: {reason}"));
                }
            }
            _ => {}
        }
        self.buffer = buffer;
        self.check_end(extent, whole)
    }

    /// Unpacks a chunk that is in memory, or what there is of it.
    fn chunk(&mut self, extent: Extent, content: &[u8]) {
        let Extent { start, length } = extent;
        let Some(head) = Head::parse(content) else {
            self.miss(format!("the chunk at byte {start} breaks the format"));
            return;
        };
        let before = self.account.integrity.messages;
        let account = &mut self.account;
        if content.len() as u64 == length && !head.is_open() {
            let unpacker = &mut self.unpacker;
            let result =
                guarded(|| unpacker.whole(content, &head, &mut |k, c| account.record(k, c)));
            if head.sum != 0 {
                self.account.integrity.chunks.add(result.is_ok());
            }
            if let Err(reason) = result {
                self.unpacker = Unpacker::default();
                self.lose(start, before, &reason);
            }
        } else {
            let mut rest = Source::new(content.get(head.length as usize..).unwrap_or_default());
            let result = guarded(|| {
                chunk::pieces(&head, length, &mut rest, &mut |k, c| account.record(k, c))
            });
            let reason = result.err().unwrap_or_else(|| "its end is missing".into());
            self.lose(start, before, &reason);
        }
    }

    /// Unpacks a chunk that is longer than what is kept in memory, or that was never closed.
    fn endless_chunk(&mut self, extent: Extent) -> io::Result<bool> {
        let Extent { start, length } = extent;
        let Some(head) = Head::read(&mut self.source)? else {
            self.miss(format!("the chunk at byte {start} breaks the format"));
            return Ok(false);
        };
        let before = self.account.integrity.messages;
        let (source, account) = (&mut self.source, &mut self.account);
        let result =
            guarded(|| chunk::pieces(&head, length, source, &mut |k, c| account.record(k, c)));
        if head.is_open() {
            let read = self.account.integrity.messages - before;
            self.miss(format!(
                "the chunk that starts at byte {start} was not closed: its writer was stopped; {read} messages were read from it, how many are lost is not known"
            ));
            return Ok(false);
        }
        if head.sum != 0 {
            self.account.integrity.chunks.add(result.is_ok());
        }
        if let Err(reason) = result {
            self.lose(start, before, &reason);
        }
        self.skip_rest(extent)
    }

    /// Passes over a record that is not looked into; an attachment's name is.
    fn pass_over(&mut self, extent: Extent, attachment: bool) -> io::Result<bool> {
        let Extent { start, length } = extent;
        let mut buffer = std::mem::take(&mut self.buffer);
        let read = self.source.read(length.min(4096), &mut buffer)?;
        let content = buffer.get(..read).unwrap_or_default();
        self.source.add_to_sum(content);
        match attachment_name(content) {
            Some(name) if attachment => self.account.visitor.attachment(&name, length),
            _ if attachment => self.miss(format!("the attachment at byte {start} has no name")),
            _ => self.miss(format!(
                "the record at byte {start} announces {length} bytes, at most {LARGEST_RECORD} are read; it is left out"
            )),
        }
        self.buffer = buffer;
        self.skip_rest(extent)
    }

    fn skip_rest(&mut self, extent: Extent) -> io::Result<bool> {
        let rest = extent.end().saturating_sub(self.source.position());
        let skipped = self.source.skip(rest, &mut self.buffer)?;
        self.check_end(extent, skipped == rest)
    }

    fn check_end(&mut self, extent: Extent, whole: bool) -> io::Result<bool> {
        if !whole {
            let (at, start, end) = (self.source.position(), extent.start, extent.end());
            self.miss(format!(
                "the file ends at byte {at}, inside the record that starts at byte {start} and was to end at byte {end}"
            ));
        }
        Ok(whole)
    }

    /// The data section ended; `sum` is what it sums up to.
    fn data_end(&mut self, extent: Extent, sum: u32) -> io::Result<bool> {
        let stated = self.closing_sum(extent, 0)?;
        match stated {
            Some(0) => {}
            Some(stated) => self.account.integrity.data.add(stated == sum),
            None => return Ok(false),
        }
        self.source.take_sum();
        self.account.section = Section::Summary;
        Ok(true)
    }

    /// The last record: the sum of the summary section, then the magic bytes, then nothing.
    fn footer(&mut self, extent: Extent) -> io::Result<bool> {
        let Some(stated) = self.closing_sum(extent, 16)? else {
            return Ok(false);
        };
        let sum = self.source.take_sum();
        if stated != 0 {
            self.account.integrity.summary.add(stated == sum);
        }
        let mut magic = [0; MAGIC.len() + 1];
        let filled = self.source.fill(&mut magic)?;
        match magic.get(..filled) {
            Some(MAGIC) => {}
            Some(end) if end.starts_with(MAGIC) => {
                self.miss("bytes follow the end of the file's content; they are left out".into());
            }
            _ => self.miss("the file's last bytes are not those of MCAP".into()),
        }
        Ok(false)
    }

    /// Reads a closing record, sums its first bytes, and answers the check sum that stands behind them.
    fn closing_sum(&mut self, extent: Extent, before: usize) -> io::Result<Option<u32>> {
        let mut buffer = std::mem::take(&mut self.buffer);
        let most = LARGEST_RECORD as u64;
        let read = self.source.read(extent.length.min(most), &mut buffer)?;
        let content = buffer.get(..read).unwrap_or_default();
        let stated = content.split_at_checked(before).and_then(|(summed, rest)| {
            self.source.add_to_sum(summed);
            rest.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
        });
        let whole = read as u64 == extent.length;
        self.buffer = buffer;
        if self.check_end(extent, whole)? && stated.is_none() {
            let start = extent.start;
            self.miss(format!("the closing record at byte {start} is too short"));
        }
        Ok(stated.filter(|_| whole))
    }

    fn lose(&mut self, start: u64, before: u64, reason: &str) {
        let line = match self.account.integrity.messages - before {
            0 => format!("the chunk at byte {start} is left out: {reason}"),
            read => format!(
                "the chunk at byte {start} is read in part: {reason}; {read} messages were read from it"
            ),
        };
        self.account.lose(line);
    }

    fn miss(&mut self, line: String) {
        self.account.integrity.miss(line);
    }
}

/// The name of an attachment: two times of eight bytes, then a text with its length before it.
fn attachment_name(content: &[u8]) -> Option<String> {
    let (length, rest) = content.get(16..)?.split_first_chunk()?;
    let name = rest.get(..u32::from_le_bytes(*length) as usize)?;
    Some(super::topics::short(std::str::from_utf8(name).ok()?))
}
