//! This file feeds damaged files to every reader: bytes flipped, cut out, doubled and spliced. What comes back is a
//! recording or a named error.
//!
//! The same claims are fuzzed with coverage (`trace/fuzz`); this slice runs everywhere. `RIGPROOF_CAMPAIGN` sets the
//! number of damaged files for each reader.

#[path = "../../fuzz/claims.rs"]
mod claims;

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rigproof_trace::{Channel, Trace, mcap};

/// Damaged files for each reader.
const FILES: u32 = 1500;

/// One way to damage a file; places and lengths are shares of it.
#[derive(Clone, Debug)]
enum Damage {
    Flip(f64, u8),
    Cut(f64, f64),
    Double(f64, f64),
    Splice(f64, f64, usize),
    Insert(f64, Vec<u8>),
    End(f64),
}

fn damage() -> impl Strategy<Value = Damage> {
    let share = || 0.0..1.0_f64;
    prop_oneof![
        4 => (share(), any::<u8>()).prop_map(|(at, bits)| Damage::Flip(at, bits)),
        1 => (share(), share()).prop_map(|(at, part)| Damage::Cut(at, part)),
        1 => (share(), share()).prop_map(|(at, part)| Damage::Double(at, part)),
        1 => (share(), share(), any::<usize>()).prop_map(|(at, part, k)| Damage::Splice(at, part, k)),
        2 => (share(), prop::collection::vec(any::<u8>(), 1..9)).prop_map(|(at, b)| Damage::Insert(at, b)),
        1 => share().prop_map(Damage::End),
    ]
}

fn apply(bytes: &mut Vec<u8>, damage: &Damage, seeds: &[Vec<u8>]) {
    let place = |bytes: &[u8], share: f64| (share * bytes.len() as f64) as usize;
    let range = |bytes: &[u8], from: f64, part: f64| {
        let from = place(bytes, from);
        from..(from + place(bytes, part * part) / 2).min(bytes.len())
    };
    match damage {
        Damage::Flip(at, bits) => {
            let at = place(bytes, *at);
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= bits;
            }
        }
        Damage::Cut(at, part) => {
            let range = range(bytes, *at, *part);
            bytes.drain(range);
        }
        Damage::Double(at, part) => {
            let range = range(bytes, *at, *part);
            let (end, copy) = (range.end, bytes[range].to_vec());
            bytes.splice(end..end, copy);
        }
        Damage::Splice(at, part, k) => {
            let other = &seeds[k % seeds.len()];
            let (at, piece) = (place(bytes, *at), other[range(other, *part, *at)].to_vec());
            bytes.splice(at..at, piece);
        }
        Damage::Insert(at, piece) => {
            let at = place(bytes, *at);
            bytes.splice(at..at, piece.iter().copied());
        }
        Damage::End(at) => bytes.truncate(place(bytes, *at)),
    }
}

/// The files that fuzzing begins with, and those that once did harm.
fn corpus(reader: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(reader);
    let entries = fs::read_dir(folder).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

/// Feeds files to a reader as they are, then damaged.
fn feed(seeds: &[Vec<u8>], claim: fn(&[u8])) {
    assert!(seeds.len() > 2);
    for seed in seeds {
        claim(seed);
    }
    let said = std::env::var("RIGPROOF_CAMPAIGN").ok();
    let cases = said.map_or(FILES, |count| count.parse().unwrap());
    let mut runner = TestRunner::new(Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    });
    let input = (0..seeds.len(), prop::collection::vec(damage(), 1..6));
    let run = runner.run(&input, |(seed, damages)| {
        let mut bytes = seeds[seed].clone();
        for damage in &damages {
            apply(&mut bytes, damage, seeds);
        }
        claim(&bytes);
        Ok(())
    });
    run.unwrap();
}

#[test]
fn no_bytes_make_the_text_reader_panic() {
    feed(&corpus("csv"), claims::csv);
}

#[test]
fn no_bytes_make_the_rig_reader_panic() {
    feed(&corpus("rig"), claims::rig);
}

#[test]
fn no_bytes_make_the_array_readers_panic() {
    feed(&corpus("arrays"), claims::arrays);
}

#[test]
fn no_bytes_make_the_message_reader_panic() {
    let file = |units: [&str; 2]| {
        let channel = |(k, unit): (usize, &str)| Channel {
            name: format!("channel {k}"),
            unit: unit.to_owned(),
            samples: (0..20).map(|j| f64::from(j) * 0.75 - k as f64).collect(),
        };
        let trace = Trace {
            time_s: (0..20).map(|j| 0.5 + 0.25 * f64::from(j)).collect(),
            channels: units.into_iter().enumerate().map(channel).collect(),
        };
        mcap::to_bytes(&trace, &mcap::Extras::default()).unwrap()
    };
    let mut seeds = Vec::from([["mm", "N"], ["deg", "N·m"], ["V", "A"]].map(file));
    seeds.extend(corpus("mcap"));
    feed(&seeds, mcap::read_bytes);
}

#[test]
fn no_bytes_make_a_decoder_panic_or_remember() {
    feed(&corpus("messages"), mcap::read_message_bytes);
}
