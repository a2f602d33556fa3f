//! This file unpacks a chunk, whole and checked where it can be, piece by piece where it was never closed.

use std::io::{self, Read};

use ::mcap::McapError;
use ::mcap::records::op;
use ::mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::source::Source;

/// The longest record, and the longest chunk that is checked before it is used, bytes.
pub(super) const LARGEST_RECORD: usize = 32 << 20;
/// The most that one chunk may unpack to, bytes.
const LARGEST_CHUNK: u64 = 1 << 30;
/// How much of a chunk that is not whole is fed at a time, bytes.
const MEAL: usize = 1 << 16;
/// Bytes of a record before its content: its kind and its length.
pub(super) const RECORD_HEAD: usize = 9;
/// Bytes of a chunk's head before the name of its compression.
const HEAD_START: usize = 32;
/// The longest name of a compression, bytes.
const LONGEST_NAME: u32 = 64;

/// What stands before the content of a chunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Head {
    pub(super) unpacked_size: u64,
    pub(super) sum: u32,
    pub(super) packed_size: u64,
    /// Bytes of the head itself.
    pub(super) length: u64,
    bytes: Vec<u8>,
}

impl Head {
    /// How many bytes a head has that starts like this, or `None` when it cannot be one.
    fn length(start: &[u8]) -> Option<usize> {
        let name = u32::from_le_bytes(start.get(28..HEAD_START)?.try_into().ok()?);
        (name <= LONGEST_NAME).then_some(HEAD_START + name as usize + 8)
    }

    pub(super) fn parse(bytes: &[u8]) -> Option<Head> {
        let length = Head::length(bytes)?;
        let bytes = bytes.get(..length)?;
        let number = |at: usize| {
            let field = bytes.get(at..at + 8)?;
            Some(u64::from_le_bytes(field.try_into().ok()?))
        };
        Some(Head {
            unpacked_size: number(16)?,
            sum: u32::from_le_bytes(bytes.get(24..28)?.try_into().ok()?),
            packed_size: number(length - 8)?,
            length: length as u64,
            bytes: bytes.to_vec(),
        })
    }

    pub(super) fn read<R: Read>(source: &mut Source<R>) -> io::Result<Option<Head>> {
        let mut bytes = vec![0; HEAD_START];
        let mut filled = source.fill(&mut bytes)?;
        if let Some(length) = Head::length(bytes.get(..filled).unwrap_or_default()) {
            bytes.resize(length, 0);
            filled += source.fill(bytes.get_mut(filled..).unwrap_or_default())?;
        }
        let bytes = bytes.get(..filled).unwrap_or_default();
        source.add_to_sum(bytes);
        Ok(Head::parse(bytes))
    }

    /// Whether the writer never came back to fill in the sizes.
    pub(super) fn is_open(&self) -> bool {
        self.packed_size == u64::MAX || self.unpacked_size == u64::MAX
    }

    /// Whether the content is not packed.
    fn is_plain(&self) -> bool {
        self.bytes.len() == HEAD_START + 8
    }

    /// The record's start with sizes that a reader can live with when the true ones were never written.
    fn opened(&self) -> Vec<u8> {
        let far = i64::MAX as u64;
        let mut record = vec![op::CHUNK];
        record.extend(far.to_le_bytes());
        let (times, rest) = self.bytes.split_at(16.min(self.bytes.len()));
        record.extend(times);
        record.extend(far.to_le_bytes());
        record.extend(0_u32.to_le_bytes());
        let name = rest.get(12..rest.len().saturating_sub(8));
        record.extend(name.unwrap_or_default());
        record.extend((far - self.length).to_le_bytes());
        record
    }
}

/// Unpacks chunks; kept from one to the next, so that its buffers are.
#[derive(Default)]
pub(super) struct Unpacker {
    reader: Option<LinearReader>,
}

impl Unpacker {
    /// Hands on every record of a chunk that is in memory, checked against its sum before the first one.
    pub(super) fn whole(
        &mut self,
        record: &[u8],
        head: &Head,
        hand_on: &mut dyn FnMut(u8, &[u8]),
    ) -> Result<(), String> {
        if head.unpacked_size > LARGEST_RECORD as u64 {
            let mut rest = Source::new(record.get(head.length as usize..).unwrap_or_default());
            return pieces(head, record.len() as u64, &mut rest, hand_on);
        }
        if head.is_plain() {
            return plain(record, head, hand_on);
        }
        // A reader that failed is not used again.
        let mut reader = self.reader.take().unwrap_or_else(|| {
            let options = options().with_prevalidate_chunk_crcs(true);
            LinearReader::new_with_options(options)
        });
        let total = RECORD_HEAD + record.len();
        let place = reader.insert(total);
        if let Some((start, rest)) = place.split_at_mut_checked(RECORD_HEAD) {
            let length = (record.len() as u64).to_le_bytes();
            start.copy_from_slice(&[[op::CHUNK].as_slice(), &length].concat());
            rest.copy_from_slice(record);
        }
        reader.notify_read(total);
        let mut unpacked = 0;
        loop {
            match reader.next_event() {
                Some(Ok(LinearReadEvent::Record { data, opcode })) => {
                    unpacked += (RECORD_HEAD + data.len()) as u64;
                    hand_on(opcode, data);
                }
                Some(Ok(LinearReadEvent::ReadRequest(_))) | None => break,
                Some(Err(error)) => return Err(reason(&error)),
            }
        }
        if unpacked != head.unpacked_size {
            return Err(format!(
                "it holds {unpacked} bytes of records where {} were announced",
                head.unpacked_size
            ));
        }
        self.reader = Some(reader);
        Ok(())
    }
}

/// Hands on the records of a chunk that is not packed, from where they stand.
fn plain(record: &[u8], head: &Head, hand_on: &mut dyn FnMut(u8, &[u8])) -> Result<(), String> {
    let records = record.get(head.length as usize..).unwrap_or_default();
    let size = usize::try_from(head.packed_size).ok();
    let mut rest = size
        .and_then(|size| records.get(..size))
        .filter(|_| head.packed_size == head.unpacked_size)
        .ok_or("its lengths contradict each other")?;
    if head.sum != 0 && head.sum != crc32fast::hash(rest) {
        return Err("its check sum fails".into());
    }
    while !rest.is_empty() {
        let ends = || "it ends in the middle of a record".to_string();
        let (&[kind, length @ ..], behind) =
            rest.split_first_chunk::<RECORD_HEAD>().ok_or_else(ends)?;
        let length = usize::try_from(u64::from_le_bytes(length)).map_err(|_| ends())?;
        let (content, behind) = behind.split_at_checked(length).ok_or_else(ends)?;
        hand_on(kind, content);
        rest = behind;
    }
    Ok(())
}

/// Hands on the records of a chunk as they are unpacked, before its sum is known; `length` is the record's.
pub(super) fn pieces<R: Read>(
    head: &Head,
    length: u64,
    source: &mut Source<R>,
    hand_on: &mut dyn FnMut(u8, &[u8]),
) -> Result<(), String> {
    let options = options().with_validate_chunk_crcs(true);
    let mut reader = LinearReader::new_with_options(options);
    let start = match head.is_open() {
        true => head.opened(),
        false => {
            let length = length.to_le_bytes();
            [[op::CHUNK].as_slice(), &length, &head.bytes].concat()
        }
    };
    reader.insert(start.len()).copy_from_slice(&start);
    reader.notify_read(start.len());
    let mut left = length.saturating_sub(head.length);
    let mut unpacked = 0;
    loop {
        match reader.next_event() {
            Some(Ok(LinearReadEvent::Record { data, opcode })) => {
                unpacked += (RECORD_HEAD + data.len()) as u64;
                if unpacked > LARGEST_CHUNK {
                    return Err(format!("it unpacks to more than {LARGEST_CHUNK} bytes"));
                }
                hand_on(opcode, data);
            }
            Some(Ok(LinearReadEvent::ReadRequest(wanted))) => {
                let wanted = wanted.min(MEAL).min(left.try_into().unwrap_or(MEAL));
                if wanted == 0 {
                    break;
                }
                let place = reader.insert(wanted);
                let read = source.fill(place).map_err(|error| error.to_string())?;
                if let Some(read) = place.get(..read) {
                    source.add_to_sum(read);
                }
                if read == 0 {
                    return Err("the file ends inside it".into());
                }
                left -= read as u64;
                reader.notify_read(read);
            }
            Some(Err(error)) => return Err(reason(&error)),
            None => break,
        }
    }
    match unpacked == head.unpacked_size {
        true => Ok(()),
        false => Err("it ends in the middle of a record".into()),
    }
}

fn options() -> LinearReaderOptions {
    LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_record_length_limit(LARGEST_RECORD)
}

/// What is wrong with a chunk, in the words of this project.
fn reason(error: &McapError) -> String {
    match error {
        McapError::BadChunkCrc { .. } => "its check sum fails".into(),
        McapError::UnsupportedCompression(name) => {
            format!(
                "its compression `{}` is neither zstd nor lz4",
                super::topics::short(name)
            )
        }
        McapError::DecompressionError(_) | McapError::Io(_) => "it cannot be unpacked".into(),
        McapError::RecordTooLarge { len, .. } => {
            format!("it announces a record of {len} bytes, at most {LARGEST_RECORD} are read")
        }
        McapError::ChunkTooLarge(size) => {
            format!("it announces {size} bytes, at most {LARGEST_RECORD} are checked at once")
        }
        McapError::UnexpectedEoc | McapError::UnexpectedEof => {
            "it ends in the middle of a record".into()
        }
        McapError::BadChunkLength { .. } => "its lengths contradict each other".into(),
        _ => "it breaks the format".into(),
    }
}
