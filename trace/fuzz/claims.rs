//! This file says what must hold for any bytes that a reader is given; the fuzz targets and a test feed it.

use std::io::Write;
use std::path::Path;

use rigproof_trace::Trace;
use rigproof_trace::arrays::{Arrays, Selection, TimeSource};
use rigproof_trace::csv::{self, Hints, LEAST_SAMPLES};
use rigproof_trace::rig::Rig;

/// A text recording is read or refused by name, and what is read is one.
pub fn csv(bytes: &[u8]) {
    let read = csv::parse_as(bytes, Path::new("run.csv"), None, &Hints::default());
    match read {
        Ok((trace, _)) => assert!(is_recording(&trace)),
        Err(error) => assert!(error.to_string().starts_with("run.csv")),
    }
}

/// A rig description is read or refused by name, and what is read reads back.
pub fn rig(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    match Rig::parse(text, Path::new("rig.toml")) {
        Ok(rig) => {
            let written = rig.to_toml();
            let back = Rig::parse(&written, Path::new("rig.toml"));
            assert!(back.is_ok_and(|back| back.to_toml() == written));
        }
        Err(error) => assert!(error.to_string().starts_with("rig.toml")),
    }
}

/// Every array of a file is read or refused by name, and none is longer than it says.
pub fn arrays(bytes: &[u8]) {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    let Ok(Some(arrays)) = Arrays::open(file.path()) else {
        return;
    };
    for entry in arrays.entries() {
        let variable = match entry.columns {
            1 => entry.name.clone(),
            _ => format!("{}[0]", entry.name),
        };
        let selection = Selection {
            group: None,
            variables: vec![variable],
            time: TimeSource::RateHz(750.0),
            units: Vec::new(),
        };
        if let Ok(trace) = arrays.recording(&selection) {
            assert!(is_recording(&trace) && trace.len() == entry.rows);
        }
    }
}

fn is_recording(trace: &Trace) -> bool {
    let grows = trace.time_s.is_sorted_by(|a, b| a < b);
    let equal = |samples: &[f64]| samples.len() == trace.len();
    grows && trace.len() >= LEAST_SAMPLES && trace.channels.iter().all(|c| equal(&c.samples))
}
