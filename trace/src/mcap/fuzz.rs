//! This file is where a fuzzer enters: any bytes, read in every way there is. A panic is a defect, an answer is none.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use super::decoder::Decoder;
use super::flat::{ELEMENTS, Flat};
use super::read::{Selection, Wanted, read_from};
use super::resample::Between;
use super::shapes::Shapes;
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
/// the definition is. The message comes several times, once with a bit turned: it has the numbers that it has by itself.
///
/// # Panics
/// Numbers depend on what came before.
pub fn read_message_bytes(bytes: &[u8]) {
    let Some((decoder, turn, message)) = parts(bytes) else {
        return;
    };
    let (mut shapes, mut flat) = (Shapes::new(), Flat::new(ELEMENTS));
    let mut other = message.to_vec();
    let place = usize::from(turn) * other.len() / 64;
    if let Some(byte) = other.get_mut(place) {
        *byte ^= 1;
    }
    for data in [message, message, &other, message] {
        let mut walk = Flat::new(ELEMENTS);
        let walked = decoder.read(data, &mut walk, false);
        let read = shapes.read(&decoder, data, &mut flat, <[_]>::len);
        assert_eq!(
            read.is_ok(),
            walked.is_ok(),
            "an error depends on what came before"
        );
        if let Ok(Some((count, numbers))) = read {
            assert_eq!(*count, walk.numbers.len(), "numbers without a place");
            let each = walk.numbers.iter().enumerate();
            let mut differ = each.filter(|(at, x)| x.to_bits() != numbers.at(*at).to_bits());
            assert_eq!(differ.next(), None, "a number depends on what came before");
        }
    }
}

/// A decoder, which part of the message is to be turned, in 64ths, and the message.
fn parts(bytes: &[u8]) -> Option<(Decoder, u8, &[u8])> {
    let (&[first, low, high], rest) = bytes.split_first_chunk()?;
    let length = usize::from(u16::from_le_bytes([low, high])).min(rest.len());
    let (definition, message) = rest.split_at(length);
    let (encoding, schema, name) = match first % 4 {
        0 => ("cdr", "ros2msg", "a/B"),
        1 => ("ros1", "ros1msg", "a/B"),
        2 => ("json", "jsonschema", "a/B"),
        _ => ("protobuf", "protobuf", "a.B"),
    };
    let schema = Schema {
        name: name.into(),
        encoding: schema.into(),
        data: definition.to_vec(),
    };
    let topic = Topic::new("/a", encoding, Some(Arc::new(schema)), BTreeMap::new());
    Some((Decoder::new(&topic).ok()?, first / 4, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_message_that_fuzzing_begins_with_has_numbers() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus/messages");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            println!("{}", path.display());
            let bytes = std::fs::read(&path).unwrap();
            let (decoder, _, message) = parts(&bytes).unwrap();
            let mut flat = Flat::new(ELEMENTS);
            decoder.read(message, &mut flat, false).unwrap();
            assert!(flat.numbers.len() >= 3);
        }
    }
}
