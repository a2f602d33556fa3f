//! This file holds arrays made here, and arrays others made where the recordings are at hand.

use super::*;
use hdf5_pure::FileBuilder;

fn hdf5_file(folder: &Path) -> PathBuf {
    let path = folder.join("run.h5");
    let mut builder = FileBuilder::new();
    let ramp: Vec<f64> = (0..20).map(|i| 1.5 + 0.3 * f64::from(i)).collect();
    let pairs: Vec<f64> = (0..40).map(f64::from).collect();
    let mut group = builder.create_group("sine");
    group
        .create_dataset("u")
        .with_f64_data(&ramp)
        .with_shape(&[20, 1]);
    group
        .create_dataset("both")
        .with_f64_data(&pairs)
        .with_shape(&[20, 2]);
    group
        .create_dataset("fs")
        .with_f64_data(&[250.0])
        .with_shape(&[1]);
    group
        .create_dataset("short")
        .with_i32_data(&[3, 1, 4])
        .with_shape(&[1, 3]);
    let group = group.finish();
    builder.add_group(group);
    builder.write(&path).unwrap();
    path
}

fn selection(variables: &[&str], time: TimeSource) -> Selection {
    Selection {
        group: Some("sine".into()),
        variables: variables.iter().map(|name| name.to_string()).collect(),
        time,
        units: vec![("u".into(), "N".into()), ("both[0]".into(), "ms".into())],
    }
}

#[test]
fn datasets_of_a_group_make_a_recording() {
    let folder = tempfile::tempdir().unwrap();
    let arrays = Arrays::open(&hdf5_file(folder.path())).unwrap().unwrap();
    let shapes: Vec<_> = arrays
        .entries()
        .iter()
        .map(|e| (e.name.as_str(), e.rows, e.columns))
        .collect();
    assert_eq!(
        shapes,
        [
            ("sine/both", 20, 2),
            ("sine/fs", 1, 1),
            ("sine/short", 3, 1),
            ("sine/u", 20, 1)
        ]
    );
    let rate = TimeSource::RateFrom("fs".into());
    let trace = arrays
        .recording(&selection(&["u", "both[1]"], rate))
        .unwrap();
    assert_eq!(trace.time_s[3], 3.0 / 250.0);
    assert_eq!(trace.channel("u").unwrap().unit, "N");
    assert_eq!(trace.channel("both[1]").unwrap().samples[4], 9.0);
    let stamps = TimeSource::Stamps("both[0]".into());
    let trace = arrays.recording(&selection(&["u"], stamps)).unwrap();
    assert_eq!(trace.time_s[4], 8.0 * 1e-3);
}

#[test]
fn an_array_that_matlab_laid_on_its_side_stands_up_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mat");
    let mut builder = FileBuilder::new();
    builder
        .with_userblock(512)
        .with_userblock_content(b"MATLAB 7.3 MAT-file, made here");
    let columns: Vec<f64> = (0..40).map(f64::from).collect();
    builder
        .create_dataset("both")
        .with_f64_data(&columns)
        .with_shape(&[2, 20]);
    builder.write(&path).unwrap();
    let arrays = Arrays::open(&path).unwrap().unwrap();
    assert_eq!(
        (arrays.entries()[0].rows, arrays.entries()[0].columns),
        (20, 2)
    );
    let selection = Selection {
        group: None,
        ..selection(&["both[1]"], TimeSource::RateHz(90.0))
    };
    let trace = arrays.recording(&selection).unwrap();
    assert_eq!(trace.channels[0].samples[3], 23.0);
}

#[test]
fn what_makes_no_recording_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let arrays = Arrays::open(&hdf5_file(folder.path())).unwrap().unwrap();
    let hz = TimeSource::RateHz;
    let from = |name: &str| TimeSource::RateFrom(name.into());
    let stamps = |name: &str| TimeSource::Stamps(name.into());
    for (variables, time, expected) in [
        (vec!["v"], hz(90.0), "there is no variable `sine/v`"),
        (
            vec!["both"],
            hz(90.0),
            "`sine/both` has 2; write `sine/both[0]` to `sine/both[1]`",
        ),
        (vec!["u[1]"], hz(90.0), "`sine/u` has 1"),
        (vec![], hz(90.0), "no variable is chosen"),
        (
            vec!["u", "short"],
            hz(90.0),
            "`short` has 3 samples and the time 20",
        ),
        (vec!["short"], hz(90.0), "has 3 samples, at least 16"),
        (vec!["u"], hz(-3.0), "the sampling rate is -3 Hz"),
        (
            vec!["u"],
            from("short"),
            "`short` holds 3 numbers; a rate is one",
        ),
        (
            vec!["both[1]"],
            stamps("u"),
            "`N`, the unit of `u`, is no unit of time",
        ),
    ] {
        let message = arrays
            .recording(&selection(&variables, time))
            .unwrap_err()
            .to_string();
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
}

#[test]
fn text_is_neither_and_damage_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv");
    std::fs::write(&path, "t,x\n").unwrap();
    assert!(Arrays::open(&path).unwrap().is_none());
    let whole = std::fs::read(hdf5_file(folder.path())).unwrap();
    std::fs::write(&path, &whole[..whole.len() / 3]).unwrap();
    let message = Arrays::open(&path).unwrap_err().to_string();
    assert!(
        message.contains("the HDF5 file cannot be read"),
        "{message}"
    );
    std::fs::write(&path, b"MATLAB 5.0 MAT-file, cut off").unwrap();
    let message = Arrays::open(&path).unwrap_err().to_string();
    assert!(
        message.contains("the MATLAB file cannot be read"),
        "{message}"
    );
}
