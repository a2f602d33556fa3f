//! This file is where a fuzzer enters: any bytes, read in every way there is. A panic is a defect, an answer is none.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use super::decoder::Decoder;
use super::flat::{ELEMENTS, Flat};
use super::read::{Selection, Wanted, read_from};
use super::resample::Between;
use super::summary::summarise;
use super::topics::{Schema, Topic};

/// Reads the bytes as a file: summed up, then the first numbers that were found, then as a run of this program.
pub fn read_bytes(bytes: &[u8]) {
    let file = Path::new("bytes.mcap");
    let Ok(summary) = summarise(Cursor::new(bytes), file) else {
        return;
    };
    let channels = summary.topics.iter().flat_map(|topic| &topic.channels);
    let wanted = channels.take(4).map(|channel| Wanted {
        address: channel.address.clone(),
        between: Between::Line,
    });
    let channels = wanted.collect();
    let time = None;
    for selection in [Selection { channels, time }, Selection::default()] {
        // An error is a fine answer to damage.
        let _ = read_from(Cursor::new(bytes), file, &selection);
    }
}

/// Reads the bytes as a definition and a message of it: the first byte chooses the language, the next two say how long
/// the definition is.
pub fn read_message_bytes(bytes: &[u8]) {
    let Some((&[language, low, high], rest)) = bytes.split_first_chunk() else {
        return;
    };
    let length = usize::from(u16::from_le_bytes([low, high])).min(rest.len());
    let (definition, message) = rest.split_at(length);
    let (encoding, schema) = match language % 4 {
        0 => ("cdr", "ros2msg"),
        1 => ("ros1", "ros1msg"),
        2 => ("json", "jsonschema"),
        _ => ("protobuf", "protobuf"),
    };
    let schema = Schema {
        name: "a/B".into(),
        encoding: schema.into(),
        data: definition.to_vec(),
    };
    let topic = Topic::new("/a", encoding, Some(Arc::new(schema)), BTreeMap::new());
    if let Ok(decoder) = Decoder::new(&topic) {
        let mut flat = Flat::new(ELEMENTS);
        for named in [false, true] {
            // An error is a fine answer to damage.
            let _ = decoder.read(message, &mut flat, named);
        }
        flat.learned();
    }
}
