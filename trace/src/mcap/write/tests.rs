//! This file holds what a recording is after it went through a file and back.

use std::io::Cursor;

use proptest::prelude::*;

use super::*;
use crate::csv;
use crate::mcap::{Between, Selection, Wanted, read_from};
use crate::series::Channel;

fn bits(values: &[f64]) -> Vec<u64> {
    // A missing sample is a missing sample, whatever its bits.
    let plain = |value: &f64| if value.is_nan() { f64::NAN } else { *value };
    values.iter().map(|value| plain(value).to_bits()).collect()
}

fn back(bytes: &[u8], selection: &Selection) -> Trace {
    let reading = read_from(Cursor::new(bytes), Path::new("run.mcap"), selection).unwrap();
    assert!(reading.integrity.is_whole(), "{:?}", reading.integrity);
    reading.trace
}

fn run(count: usize) -> Trace {
    let channel = |name: &str, unit: &str, factor: f64| Channel {
        name: name.into(),
        unit: unit.into(),
        samples: (0..count)
            .map(|k| factor * (0.37 + 0.11 * k as f64))
            .collect(),
    };
    Trace {
        time_s: (0..count).map(|k| -0.713 + 0.0021 * k as f64).collect(),
        channels: vec![
            channel("elbow", "deg", 1.3),
            channel("torque", "N·m", -0.7),
            channel("elbow speed", "deg/s", 2.9),
        ],
    }
}

prop_compose! {
    fn any_trace()(
        steps in prop::collection::vec(1e-9..1e3_f64, 16..40),
        // From a million seconds on stamps count from an epoch.
        start_s in -1e5..9e5_f64,
        names in prop::collection::btree_set("[a-zA-Z,\"µ][a-z_,\" ]{0,8}[a-z0-9]", 1..5),
        units in prop::collection::vec(prop::sample::select(vec!["", "N·m", "mm", "deg/s", "N"]), 5),
        values in prop::collection::vec(
            prop_oneof![prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO, Just(f64::NAN)], 160),
    ) -> Trace {
        let mut time_s: Vec<f64> = steps
            .iter()
            .scan(start_s, |time_s, step| { *time_s += step; Some(*time_s) })
            .collect();
        time_s.dedup();
        let count = time_s.len();
        let channels = names.into_iter().zip(units).enumerate().map(|(k, (name, unit))| Channel {
            name,
            unit: unit.to_string(),
            // The first sample is there: a channel that is missing throughout is not in the file.
            samples: std::iter::once(1.7 + k as f64)
                .chain(values.iter().cycle().skip(7 * k).take(count - 1).copied())
                .collect(),
        });
        Trace { channels: channels.collect(), time_s }
    }
}

proptest! {
    #[test]
    fn text_to_mcap_to_text_keeps_every_bit(trace in any_trace()) {
        prop_assume!(trace.len() >= csv::LEAST_SAMPLES);
        let text = csv::to_bytes(&trace).unwrap();
        let first = csv::parse(text.as_slice(), Path::new("in.csv"), None).unwrap();
        let bytes = to_bytes(&first, &Extras::default()).unwrap();
        let second = back(&bytes, &Selection::default());
        prop_assert_eq!(bits(&second.time_s), bits(&first.time_s));
        prop_assert_eq!(second.channels.len(), first.channels.len());
        for (read, written) in second.channels.iter().zip(&first.channels) {
            prop_assert_eq!((&read.name, &read.unit), (&written.name, &written.unit));
            prop_assert_eq!(bits(&read.samples), bits(&written.samples));
        }
        prop_assert_eq!(csv::to_bytes(&second).unwrap(), text);
    }
}

#[test]
fn joints_and_wrenches_are_in_si_units_and_addressed_by_name() {
    let trace = run(40);
    let bytes = to_bytes(&trace, &Extras::default()).unwrap();
    let wanted = |address: &str| Wanted {
        address: address.into(),
        between: Between::Line,
    };
    let selection = Selection {
        channels: vec![
            wanted("/joint_states.position[name=elbow]"),
            wanted("joint_states.velocity[0]"),
            wanted("/wrench.wrench.torque.z"),
            wanted("torque"),
        ],
        time: None,
    };
    let read = back(&bytes, &selection);
    assert_eq!(read.len(), 40);
    let per_deg = std::f64::consts::PI / 180.0;
    for row in [0, 17, 39] {
        let [elbow, torque, speed] = [0, 1, 2].map(|k| trace.channels[k].samples[row]);
        let found = |k: usize| read.channels[k].samples[row];
        assert!((found(0) - elbow * per_deg).abs() < 1e-15);
        assert!((found(1) - speed * per_deg).abs() < 1e-15);
        assert_eq!(found(2), torque);
        assert!((found(3) - torque).abs() < 1e-8 || found(3).is_nan());
        // Log time counts from a whole second before the first stamp.
        assert!((read.time_s[row] - (trace.time_s[row] + 1.0)).abs() < 1e-9);
    }
}

#[test]
fn what_would_not_read_back_is_not_written() {
    let mut infinite = run(20);
    infinite.channels[1].samples[3] = f64::INFINITY;
    let mut short = run(20);
    short.channels[2].samples.pop();
    let mut backward = run(20);
    backward.time_s.swap(4, 5);
    let mut late = run(20);
    late.time_s[19] = 2.2e9;
    for (trace, expected) in [
        (infinite, "`torque` holds an infinite value"),
        (short, "`elbow speed` has 19 samples and the time 20"),
        (backward, "time does not grow"),
        (late, "2200000000 s does not fit"),
    ] {
        let message = to_bytes(&trace, &Extras::default()).unwrap_err();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_file_says_where_it_comes_from() {
    let extras = Extras {
        attachments: vec![(
            "rig.toml".into(),
            "application/toml".into(),
            b"name = \"slide\"".to_vec(),
        )],
        texts: BTreeMap::from([("seed".to_string(), "41".to_string())]),
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    write(&path, &run(40), &extras).unwrap();
    let summary = crate::mcap::summary(&path).unwrap();
    assert_eq!(summary.metadata, ["rigproof"]);
    assert_eq!(summary.attachments.len(), 1);
    assert_eq!(summary.attachments[0].0, "rig.toml");
    let sums = [
        summary.integrity.chunks,
        summary.integrity.data,
        summary.integrity.summary,
    ];
    assert_eq!(sums, [crate::mcap::Check::Verified; 3]);
    assert_eq!(summary.topics.len(), 3);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let raw = std::fs::read(&path).unwrap();
    assert!(raw.windows(4).any(|bytes| bytes == b"seed"));
}
