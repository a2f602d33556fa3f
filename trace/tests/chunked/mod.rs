//! This file writes a chunked MCAP file of JSON messages through the format's own crate.

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::WriteOptions;
use mcap::records::MessageHeader;

/// The bytes of a file with the messages on one topic, so many to a chunk.
pub fn chunked(
    options: WriteOptions,
    topic: &str,
    in_chunk: u32,
    messages: impl Iterator<Item = Vec<u8>>,
) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = options.chunk_size(None).create(&mut bytes).unwrap();
    let channel = writer
        .add_channel(0, topic, "json", &BTreeMap::new())
        .unwrap();
    for (sequence, message) in (0..).zip(messages) {
        let time = 7_000_003 + 1_000_017 * u64::from(sequence);
        let header = MessageHeader {
            channel_id: channel,
            sequence,
            log_time: time,
            publish_time: time,
        };
        writer.write_to_known_channel(&header, &message).unwrap();
        if (sequence + 1) % in_chunk == 0 {
            writer.flush().unwrap();
        }
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}
