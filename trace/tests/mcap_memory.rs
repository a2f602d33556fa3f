//! This file reads more than fits the memory and measures what the process took.

mod chunked;

use std::io::{Cursor, Read};
use std::path::Path;

use mcap::{Compression, WriteOptions};
use rigproof_trace::mcap::{read_bytes, summarise};

/// The most memory the process ever had, MB, where the system says.
fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}

/// A file of one chunk, whose messages have so many bytes each.
fn piece(compression: Option<Compression>, bytes_each: usize, count: u32) -> Vec<u8> {
    let messages = (0..count).map(|k| {
        let mut text = format!("{{\"x\": {}.25, \"rest\": \"", k + 3).into_bytes();
        text.resize(bytes_each - 2, b'a' + (k % 23) as u8);
        text.extend(b"\"}");
        text
    });
    let options = WriteOptions::new().compression(compression);
    chunked::chunked(options, "/bulk", u32::MAX, messages)
}

/// The bytes of the first chunk of a file, its head included.
fn first_chunk(bytes: &[u8]) -> std::ops::Range<usize> {
    let length = |at: usize| u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
    let header_end = 8 + 9 + length(8);
    header_end..header_end + 9 + length(header_end)
}

/// A start, then the same piece again and again.
struct Endless {
    start: Cursor<Vec<u8>>,
    piece: Vec<u8>,
    at: usize,
    left: u64,
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let started = self.start.read(buffer)?;
        if started > 0 || self.left == 0 {
            return Ok(started);
        }
        let read = (&self.piece[self.at..]).read(buffer)?;
        self.at = (self.at + read) % self.piece.len();
        self.left = self.left.saturating_sub(read as u64);
        Ok(read)
    }
}

#[test]
fn memory_does_not_grow_with_the_file() {
    // The campaign is 2 GB: RIGPROOF_CAMPAIGN=2000 (megabytes).
    let campaign = std::env::var("RIGPROOF_CAMPAIGN").ok();
    let megabytes: u64 = campaign.and_then(|text| text.parse().ok()).unwrap_or(100);
    let file = piece(None, 1 << 10, 1000);
    let chunk = first_chunk(&file);
    let source = Endless {
        start: Cursor::new(file[..chunk.start].to_vec()),
        piece: file[chunk].to_vec(),
        at: 0,
        left: megabytes << 20,
    };
    let summary = summarise(source, Path::new("endless.mcap")).unwrap();
    let messages = summary.integrity.messages;
    assert!(messages > 1000 * (megabytes - 2), "{messages}");
    let Some(long_mb) = peak_mb() else {
        println!("passed over: the system does not say what memory was taken");
        return;
    };
    println!("{megabytes} MB in {messages} messages: at most {long_mb:.0} MB of memory");
    assert!(long_mb < 60.0, "{long_mb} MB");

    // Sizes that are not there are not set aside: 2^40 bytes of a chunk that has a few hundred.
    let mut lying = piece(Some(Compression::Zstd), 900, 7);
    let chunk = first_chunk(&lying);
    for field in [chunk.start + 9 + 16, chunk.start + 1] {
        let before: [u8; 8] = lying[field..field + 8].try_into().unwrap();
        lying[field..field + 8].copy_from_slice(&(1_u64 << 40).to_le_bytes());
        read_bytes(&lying);
        lying[field..field + 8].copy_from_slice(&before);
    }
    let lying_mb = peak_mb().unwrap_or(f64::NAN);
    assert!(lying_mb < 70.0, "{lying_mb} MB");

    // A few kilobytes that unpack to 48 MB are unpacked piece by piece.
    let bomb = piece(Some(Compression::Zstd), 1 << 20, 48);
    assert!(bomb.len() < 200_000, "{}", bomb.len());
    let summary = summarise(Cursor::new(&bomb), Path::new("bomb.mcap")).unwrap();
    assert_eq!(summary.integrity.messages, 48);
    let bomb_mb = peak_mb().unwrap_or(f64::NAN);
    println!("after lying sizes {lying_mb:.0} MB, after a bomb {bomb_mb:.0} MB");
    // Writing the bomb took what it unpacks to, and so does the writer's own chunk.
    assert!(bomb_mb < 200.0, "{bomb_mb} MB");
}
