//! This file damages MCAP files in every place: nothing panics, nothing changes in silence, what is missing is said.

use std::io::Cursor;
use std::path::Path;

use mcap::records::op;
use mcap::{Compression, WriteOptions};
use rigproof_trace::mcap::{
    Between, Check, Extras, Selection, Summary, Wanted, read_bytes, read_from, summarise, to_bytes,
};
use rigproof_trace::{Channel, Trace};

use super::chunked;

fn run() -> Trace {
    let samples = (0..16).map(|k| 0.37 + 0.11 * f64::from(k));
    Trace {
        time_s: (0..16).map(|k| 0.713 + 0.0021 * f64::from(k)).collect(),
        channels: vec![Channel {
            name: "load".into(),
            unit: "V".into(),
            samples: samples.collect(),
        }],
    }
}

fn look(bytes: &[u8]) -> Result<Summary, String> {
    summarise(Cursor::new(bytes), Path::new("a.mcap")).map_err(|error| error.to_string())
}

fn back(bytes: &[u8]) -> Option<Trace> {
    let read = read_from(
        Cursor::new(bytes),
        Path::new("a.mcap"),
        &Selection::default(),
    );
    read.ok().map(|reading| reading.trace)
}

/// A file of `count` messages, four to a chunk.
fn chunked(count: u32, compression: Option<Compression>, options: WriteOptions) -> Vec<u8> {
    let messages = (0..count).map(|k| format!("{{\"x\": {}.25}}", k + 3).into_bytes());
    chunked::chunked(options.compression(compression), "/load", 4, messages)
}

/// The places of the chunks in a file.
fn chunks(bytes: &[u8]) -> Vec<(usize, usize)> {
    let mut at = 8;
    let mut found = Vec::new();
    while at + 9 <= bytes.len() - 8 {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
        if bytes[at] == op::CHUNK {
            found.push((at, at + 9 + length));
        }
        at += 9 + length;
    }
    found
}

#[test]
fn no_flipped_bit_changes_a_number_in_silence() {
    let whole = to_bytes(&run(), &Extras::default()).unwrap();
    let truth = back(&whole).unwrap();
    let mut told = 0;
    for at in 0..whole.len() {
        for bit in 0..8 {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            let is_whole = look(&bytes).is_ok_and(|summary| summary.integrity.is_whole());
            told += usize::from(!is_whole);
            if is_whole && let Some(trace) = back(&bytes) {
                assert_eq!(trace, truth, "byte {at}, bit {bit}");
            }
        }
    }
    println!("{told} of {} flips were told", 8 * whole.len());
    assert_eq!(told, 8 * whole.len());
}

#[test]
fn a_file_cut_anywhere_says_so() {
    let whole = chunked(24, Some(Compression::Zstd), WriteOptions::new());
    for length in 8..whole.len() {
        let bytes = &whole[..length];
        read_bytes(bytes);
        let summary = look(bytes).unwrap();
        assert!(!summary.integrity.missing.is_empty(), "{length}");
    }
    assert!(
        look(&whole[..7])
            .unwrap_err()
            .contains("does not begin as MCAP does")
    );
    assert!(look(&whole).unwrap().integrity.is_whole());
}

#[test]
fn whole_chunks_before_the_cut_are_read_and_the_last_one_in_part() {
    for compression in [None, Some(Compression::Zstd), Some(Compression::Lz4)] {
        let whole = chunked(24, compression, WriteOptions::new());
        let (start, end) = chunks(&whole)[3];
        let summary = look(&whole[..end - 24]).unwrap();
        assert!(
            (12..16).contains(&summary.integrity.messages),
            "{compression:?}"
        );
        let missing = summary.integrity.missing.join("\n");
        let expected = format!("inside the record that starts at byte {start}");
        assert!(missing.contains(&expected), "{missing}");
    }
}

#[test]
fn a_damaged_chunk_is_left_out_and_its_messages_are_counted() {
    for compression in [None, Some(Compression::Zstd), Some(Compression::Lz4)] {
        let mut bytes = chunked(24, compression, WriteOptions::new());
        let (start, end) = chunks(&bytes)[2];
        bytes[end - 5] ^= 0x10;
        let summary = look(&bytes).unwrap();
        assert_eq!(summary.integrity.messages, 20);
        assert_eq!(
            (summary.integrity.chunks, summary.integrity.data),
            (Check::Failed, Check::Failed)
        );
        let missing = &summary.integrity.missing;
        assert!(
            missing[0].contains(&format!("chunk at byte {start} is left out")),
            "{missing:?}"
        );
        assert!(missing[0].ends_with("4 messages are lost"), "{missing:?}");
        assert_eq!(missing[1], "20 of 24 messages were read");
    }
}

#[test]
fn a_writer_that_was_stopped_leaves_what_it_had_flushed() {
    let mut bytes = chunked(24, Some(Compression::Zstd), WriteOptions::new());
    let (start, end) = chunks(&bytes)[5];
    // As a writer leaves it that never came back to the chunk's head.
    bytes.truncate(end);
    bytes[start + 1..start + 9].fill(0xff);
    let head = start + 9;
    bytes[head + 16..head + 28].fill(0xff);
    let name = 4 + 4;
    bytes[head + 28 + name..head + 36 + name].fill(0xff);
    let summary = look(&bytes).unwrap();
    assert_eq!(summary.integrity.messages, 24);
    let missing = summary.integrity.missing.join("\n");
    assert!(
        missing.contains("was not closed: its writer was stopped; 4 messages"),
        "{missing}"
    );
}

#[test]
fn files_without_chunks_or_summary_are_read_in_order() {
    let plain = WriteOptions::new().use_chunks(false);
    let bare = WriteOptions::new()
        .emit_summary_records(false)
        .emit_summary_offsets(false);
    for (options, announced) in [(plain, Some(24)), (bare, None)] {
        let bytes = chunked(24, None, options);
        let summary = look(&bytes).unwrap();
        assert_eq!(
            (summary.integrity.messages, summary.integrity.announced),
            (24, announced)
        );
        assert!(summary.integrity.is_whole(), "{:?}", summary.integrity);
        assert_eq!(summary.topics[0].channels[0].address, "/load.x");
        assert_eq!(summary.topics[0].channels[0].maximum, 26.25);
    }
}

/// A file of records as given, without closing part.
fn file(records: &[(u8, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = mcap::MAGIC.to_vec();
    for (kind, content) in records {
        bytes.push(*kind);
        bytes.extend((content.len() as u64).to_le_bytes());
        bytes.extend(content);
    }
    bytes
}

fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat()
}

fn channel(id: u16, schema: u16, topic: &str) -> (u8, Vec<u8>) {
    let ids = [id.to_le_bytes(), schema.to_le_bytes()].concat();
    (
        op::CHANNEL,
        [ids, text(topic), text("json"), vec![0; 4]].concat(),
    )
}

fn message(id: u16, time: u64, data: &str) -> (u8, Vec<u8>) {
    let (id, time) = (id.to_le_bytes(), time.to_le_bytes());
    (
        op::MESSAGE,
        [&id[..], &[0; 4], &time, &time, data.as_bytes()].concat(),
    )
}

#[test]
fn a_channel_declared_twice_loses_what_comes_after() {
    let mut records = vec![
        channel(3, 0, "/a"),
        message(3, 11, "{\"x\": 1.5}"),
        channel(3, 0, "/a"),
    ];
    records.extend([
        message(3, 12, "{\"x\": 2.5}"),
        channel(3, 0, "/b"),
        message(3, 13, "{\"x\": 9.5}"),
    ]);
    records.extend([channel(4, 77, "/c"), message(5, 14, "{\"x\": 9.5}")]);
    let summary = look(&file(&records)).unwrap();
    assert_eq!(summary.topics.len(), 1);
    assert_eq!(summary.topics[0].channels[0].maximum, 2.5);
    let missing = summary.integrity.missing.join("\n");
    for expected in [
        "channel 3 is declared twice in different ways, the second time as `/b`",
        "the channel `/c` refers to schema 77",
        "2 messages belong to channels that the file does not declare",
    ] {
        assert!(missing.contains(expected), "{missing}");
    }
}

#[test]
fn times_out_of_order_are_sorted_and_values_that_are_none_stay_missing() {
    let mut records = vec![channel(1, 0, "/a")];
    for k in 0..20_u64 {
        let time = 1_000_000 * (if k == 7 { 50 } else { k + 10 });
        let value = if k == 3 {
            "null".to_string()
        } else {
            format!("{k}.5")
        };
        records.push(message(1, time, &format!("{{\"x\": {value}, \"y\": 1}}")));
    }
    records.push(message(1, 12_000_000, "{\"x\": 99}"));
    records.push(message(1, 13_000_000, "no json"));
    let wanted = |address: &str| Wanted {
        address: address.into(),
        between: Between::Line,
    };
    let selection = Selection {
        channels: vec![wanted("/a.x"), wanted("/a.y")],
        time: None,
    };
    let reading = read_from(Cursor::new(file(&records)), Path::new("a.mcap"), &selection).unwrap();
    let trace = reading.trace;
    assert_eq!(trace.len(), 20);
    assert!(trace.time_s.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!(trace.channels[0].samples[19], 7.5);
    assert_eq!(trace.channels[0].samples[2], 2.5);
    assert!(trace.channels[0].samples[3].is_nan());
    let said = reading.protocol.join("\n");
    for expected in [
        "came after a later one",
        "1 messages of `/a` have no time",
        "1 messages of `/a` could not be read",
    ] {
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn lengths_that_lie_are_told() {
    let plain = file(&[channel(1, 0, "/a"), message(1, 11, "{\"x\": 1.5}")]);
    for (kind, length) in [
        (op::MESSAGE, u64::MAX),
        (op::SCHEMA, 1 << 40),
        (op::ATTACHMENT, u64::MAX),
        (op::DATA_END, u64::MAX),
        (0x7f, u64::MAX - 3),
    ] {
        let mut bytes = plain.clone();
        bytes.push(kind);
        bytes.extend(length.to_le_bytes());
        bytes.extend([7; 40]);
        let summary = look(&bytes).unwrap();
        assert_eq!(summary.integrity.messages, 1);
        assert!(!summary.integrity.missing.is_empty(), "{kind}");
        read_bytes(&bytes);
    }
}
