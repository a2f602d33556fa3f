//! This file writes a recording as a comma-separated text file.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::Path;

use crate::error::TraceError;
use crate::header;
use crate::series::Trace;
use crate::store;

/// Writes a recording: the time first, a header `name (unit)`, a missing sample as an empty cell, and the
/// shortest digits that read back as the same number. The file appears whole or not at all.
///
/// # Errors
/// The recording cannot be written so that it reads back the same, or the system refuses.
pub fn write(path: &Path, trace: &Trace) -> Result<(), TraceError> {
    let headers = headers(trace).map_err(|problem| TraceError::recording(path, problem))?;
    store::write_aside_with(path, |file| rows(trace, &headers, file))
}

/// The bytes of the file that [`write()`] would write.
///
/// # Errors
/// Says which name, length or value could not be read back.
pub fn to_bytes(trace: &Trace) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    rows(trace, &headers(trace)?, &mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// The cells of the first line, when everything below can be written.
fn headers(trace: &Trace) -> Result<Vec<String>, String> {
    let mut headers = vec!["time (s)".to_string()];
    let mut names = BTreeSet::from(["time"]);
    for channel in &trace.channels {
        let (name, unit) = (&channel.name, &channel.unit);
        if channel.samples.len() != trace.len() {
            let (samples, stamps) = (channel.samples.len(), trace.len());
            return Err(format!(
                "the channel `{name}` has {samples} samples for {stamps} time stamps; they must be equal"
            ));
        }
        if !names.insert(name) {
            return Err(format!("two columns would be called `{name}`; rename one"));
        }
        headers.push(header::header(name, unit).ok_or_else(|| {
            format!("the channel `{name}` with unit `{unit}` would not read back; rename it")
        })?);
    }
    let columns = trace.channels.iter().map(|channel| &channel.samples);
    let infinite = std::iter::once(&trace.time_s)
        .chain(columns)
        .filter_map(|column| column.iter().position(|value| value.is_infinite()));
    match infinite.min() {
        Some(index) => Err(format!(
            "sample {} is infinite, which is no recording",
            index + 1
        )),
        None => Ok(headers),
    }
}

fn rows(trace: &Trace, headers: &[String], target: impl Write) -> io::Result<()> {
    let mut file = ::csv::WriterBuilder::new()
        .buffer_capacity(1 << 18)
        .from_writer(target);
    file.write_record(headers)?;
    let mut cells: Vec<String> = Vec::with_capacity(headers.len());
    for (index, &time_s) in trace.time_s.iter().enumerate() {
        let samples = trace.channels.iter().filter_map(|c| c.samples.get(index));
        cells.clear();
        cells.extend(
            std::iter::once(&time_s)
                .chain(samples)
                .map(|value| match value.is_nan() {
                    true => String::new(),
                    false => format!("{value:?}"),
                }),
        );
        file.write_record(&cells)?;
    }
    file.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csv::parse;
    use crate::series::Channel;
    use proptest::prelude::*;

    fn bits(values: &[f64]) -> Vec<u64> {
        // A missing sample is a missing sample, whatever its bits.
        values
            .iter()
            .map(|v| {
                if v.is_nan() {
                    f64::NAN.to_bits()
                } else {
                    v.to_bits()
                }
            })
            .collect()
    }

    prop_compose! {
        fn any_trace()(
            steps in prop::collection::vec(1e-9..1e3_f64, 16..40),
            start_s in -9e5..9e5_f64,
            names in prop::collection::btree_set("[a-zA-Z,\"µ][a-z_,\" ]{0,8}[a-z0-9]", 1..4),
            unit in prop::sample::select(vec!["", "N·m", "mm", "deg/s", "1"]),
            values in prop::collection::vec(
                prop_oneof![prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO, Just(f64::NAN)], 160),
        ) -> Trace {
            let mut time_s: Vec<f64> = steps
                .iter()
                .scan(start_s, |time_s, step| { *time_s += step; Some(*time_s) })
                .collect();
            time_s.dedup();
            let count = time_s.len();
            let channels = names.into_iter().enumerate().map(|(k, name)| Channel {
                name,
                unit: unit.to_string(),
                samples: values.iter().cycle().skip(7 * k).take(count).copied().collect(),
            });
            Trace { channels: channels.collect(), time_s }
        }
    }

    proptest! {
        #[test]
        fn a_recording_reads_back_bit_for_bit(trace in any_trace()) {
            prop_assume!(trace.len() >= crate::csv::LEAST_SAMPLES);
            let bytes = to_bytes(&trace).unwrap();
            let back = parse(bytes.as_slice(), Path::new("round.csv"), None).unwrap();
            prop_assert_eq!(bits(&back.time_s), bits(&trace.time_s));
            prop_assert_eq!(back.channels.len(), trace.channels.len());
            for (read, written) in back.channels.iter().zip(&trace.channels) {
                prop_assert_eq!((&read.name, &read.unit), (&written.name, &written.unit));
                prop_assert_eq!(bits(&read.samples), bits(&written.samples));
            }
        }
    }

    #[test]
    fn what_would_not_read_back_is_not_written() {
        let channel = |name: &str, samples: Vec<f64>| Trace {
            time_s: vec![0.1, 0.3],
            channels: vec![Channel {
                name: name.into(),
                unit: "N".into(),
                samples,
            }],
        };
        for trace in [
            channel("a\nb", vec![1.1, 2.2]),
            channel("time", vec![1.1, 2.2]),
            channel("force", vec![1.1]),
            channel("force", vec![1.1, f64::INFINITY]),
        ] {
            assert!(to_bytes(&trace).is_err(), "{trace:?}");
        }
    }
}
