//! This file holds structures as MATLAB, Simulink and ControlDesk save them, in version 5 and 7.3.

use std::io::Write;

use super::*;
use hdf5_pure::{AttrValue, FileBuilder};

/// One element of a version 5 file.
fn element(kind: u32, bytes: &[u8], big: bool) -> Vec<u8> {
    let word = |n: u32| {
        if big {
            n.to_be_bytes()
        } else {
            n.to_le_bytes()
        }
    };
    let mut out = [word(kind), word(bytes.len() as u32)].concat();
    out.extend_from_slice(bytes);
    if kind != 15 {
        out.resize(out.len().next_multiple_of(8), 0);
    }
    out
}

/// A matrix of a class, with what stands behind its name.
fn matrix(class: u32, sizes: &[i32], name: &str, rest: &[u8], big: bool) -> Vec<u8> {
    let word = |n: i32| {
        if big {
            n.to_be_bytes()
        } else {
            n.to_le_bytes()
        }
    };
    let flags = [word(class as i32), word(0)].concat();
    let sizes: Vec<u8> = sizes.iter().flat_map(|n| word(*n)).collect();
    let parts = [
        element(6, &flags, big),
        element(5, &sizes, big),
        element(1, name.as_bytes(), big),
        rest.to_vec(),
    ];
    element(14, &parts.concat(), big)
}

fn doubles(name: &str, values: &[f64], big: bool) -> Vec<u8> {
    let bytes = values.iter().flat_map(|x| {
        if big {
            x.to_be_bytes()
        } else {
            x.to_le_bytes()
        }
    });
    let bytes: Vec<u8> = bytes.collect();
    matrix(
        6,
        &[values.len() as i32, 1],
        name,
        &element(9, &bytes, big),
        big,
    )
}

/// A structure; `fields` holds the values of one after another.
fn structure(name: &str, count: i32, names: &[&str], fields: &[Vec<u8>], big: bool) -> Vec<u8> {
    let width = if big {
        8_i32.to_be_bytes()
    } else {
        8_i32.to_le_bytes()
    };
    let mut padded = Vec::new();
    for name in names {
        padded.extend_from_slice(name.as_bytes());
        padded.resize(padded.len().next_multiple_of(8), 0);
    }
    let rest = [
        element(5, &width, big),
        element(1, &padded, big),
        fields.concat(),
    ];
    matrix(2, &[1, count], name, &rest.concat(), big)
}

/// A file as ControlDesk saves it: `run.X.Data`, `run.Y(1).Data`, …
fn version5(big: bool, deflated: bool) -> Vec<u8> {
    let ramp = |from: f64, step: f64| {
        (0..20)
            .map(|k| from + step * f64::from(k))
            .collect::<Vec<_>>()
    };
    let x = structure("", 1, &["Data"], &[doubles("", &ramp(0.5, 2e-3), big)], big);
    let small = {
        // A small element: 20 numbers of one byte would not fit, four would; MATLAB narrows what it can.
        let bytes: Vec<u8> = (0..20).map(|k| 3 * k + 1).collect();
        matrix(6, &[20, 1], "", &element(2, &bytes, big), big)
    };
    let name = matrix(4, &[1, 3], "", &element(16, b"pos", big), big);
    let y = [
        name.clone(),
        doubles("", &ramp(-7.5, 0.25), big),
        name,
        small,
    ];
    let y = structure("", 2, &["Name", "Data"], &y, big);
    let run = structure("run", 1, &["X", "Y"], &[x, y], big);
    // An opaque matrix has no dimensions: its name follows the flags.
    let flags = if big {
        [0, 0, 0, 17, 0, 0, 0, 0]
    } else {
        [17, 0, 0, 0, 0, 0, 0, 0]
    };
    let object = [
        element(6, &flags, big),
        element(1, b"ts", big),
        element(1, b"MCOS", big),
    ];
    let object = element(14, &object.concat(), big);
    let mut file = b"MATLAB 5.0 MAT-file, made here".to_vec();
    file.resize(124, b' ');
    file.extend_from_slice(if big { b"\x01\x00MI" } else { b"\x00\x01IM" });
    for variable in [run, object] {
        if deflated {
            let mut encoder =
                flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::new(6));
            encoder.write_all(&variable).unwrap();
            file.extend(element(15, &encoder.finish().unwrap(), big));
        } else {
            file.extend(variable);
        }
    }
    file
}

fn selection(variables: &[&str], time: &str) -> Selection {
    Selection {
        group: None,
        variables: variables.iter().map(|name| name.to_string()).collect(),
        time: TimeSource::Stamps(time.into()),
        units: Vec::new(),
    }
}

fn open(bytes: &[u8]) -> Result<Arrays, TraceError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mat");
    std::fs::write(&path, bytes).unwrap();
    Arrays::open(&path).map(Option::unwrap)
}

#[test]
fn structures_of_version_5_are_opened_in_both_orders_of_bytes_deflated_or_not() {
    for (big, deflated) in [(false, false), (false, true), (true, false), (true, true)] {
        let arrays = open(&version5(big, deflated)).unwrap();
        let names: Vec<&str> = arrays.entries().iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, ["run.X.Data", "run.Y[0].Data", "run.Y[1].Data"]);
        let trace = arrays
            .recording(&selection(
                &["run.Y(1).Data", "run/Y[1]/Data"],
                "run.X(1).Data",
            ))
            .unwrap();
        assert_eq!(trace.time_s[7], 0.5 + 2e-3 * 7.0);
        assert_eq!(trace.channels[0].samples[7], -7.5 + 0.25 * 7.0);
        assert_eq!(trace.channels[1].samples[7], 22.0);
        let message = arrays
            .recording(&selection(&["ts.Data"], "ts.Time"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("`ts` is an object of MATLAB, which is not read"),
            "{message}"
        );
    }
}

#[test]
fn every_cut_of_a_version_5_file_is_refused_or_shorter() {
    let whole = version5(false, false);
    let all = open(&whole).unwrap().entries().len();
    for length in 20..whole.len() {
        if let Ok(arrays) = open(&whole[..length]) {
            assert!(arrays.entries().len() <= all);
            assert!(length == 128 || arrays.entries().len() == all, "{length}");
        }
    }
}

#[test]
fn structures_of_version_7_3_are_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mat");
    let mut builder = FileBuilder::new();
    builder
        .with_userblock(512)
        .with_userblock_content(b"MATLAB 7.3 MAT-file, made here");
    let numbers = |from: f64| {
        (0..20)
            .map(|k| from + 0.25 * f64::from(k))
            .collect::<Vec<_>>()
    };
    let mut run = builder.create_group("logged");
    run.create_dataset("time")
        .with_f64_data(&numbers(3.5))
        .with_shape(&[1, 20]);
    let mut signals = run.create_group("signals");
    signals
        .create_dataset("values")
        .with_path_references(&["#refs#/a", "#refs#/b"])
        .with_shape(&[2, 1]);
    run.add_group(signals.finish());
    builder.add_group(run.finish());
    let mut refs = builder.create_group("#refs#");
    for (name, from) in [("a", -1.5), ("b", 7.25)] {
        refs.create_dataset(name)
            .with_f64_data(&numbers(from))
            .with_shape(&[1, 20]);
    }
    builder.add_group(refs.finish());
    builder
        .create_dataset("ts")
        .with_u32_data(&[3_707_764_736, 2, 1, 1, 1, 1])
        .with_shape(&[1, 6])
        .set_attr("MATLAB_object_decode", AttrValue::I32(3));
    builder.write(&path).unwrap();
    let arrays = Arrays::open(&path).unwrap().unwrap();
    let names: Vec<&str> = arrays.entries().iter().map(|e| e.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "logged.signals[0].values",
            "logged.signals[1].values",
            "logged.time"
        ]
    );
    let trace = arrays
        .recording(&selection(&["logged.signals(2).values"], "logged/time"))
        .unwrap();
    assert_eq!((trace.time_s[4], trace.channels[0].samples[4]), (4.5, 8.25));
    let advice = arrays.passed_over()[0].advice();
    assert_eq!(
        advice,
        "`ts` is an object of MATLAB, which is not read; in MATLAB, save its numbers as arrays, such as `t = ts.Time; x = ts.Data`"
    );
}

#[test]
fn an_array_that_announces_too_much_is_refused_before_it_is_read() {
    let mut file = b"MATLAB 5.0 MAT-file".to_vec();
    file.resize(124, b' ');
    file.extend_from_slice(b"\x00\x01IM");
    let zeros = vec![0; 1 << 20];
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::new(9));
    for _ in 0..40 {
        encoder.write_all(&zeros).unwrap();
    }
    file.extend(element(15, &encoder.finish().unwrap(), false));
    assert!(file.len() < 1 << 17);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.mat");
    std::fs::write(&path, &file).unwrap();
    let message = matlab::open_within(&path, 128 << 20)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("the MATLAB file cannot be read"),
        "{message}"
    );
    let lie = matrix(
        6,
        &[1 << 30, 1 << 30],
        "x",
        &element(9, &[0; 16], false),
        false,
    );
    file.truncate(128);
    file.extend(lie);
    assert!(open(&file).is_err());
}

#[test]
fn a_name_that_stands_twice_is_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mat");
    let mut file = b"MATLAB 5.0 MAT-file, made here".to_vec();
    file.resize(124, b' ');
    file.extend_from_slice(b"\x00\x01IM");
    for (name, count) in [("twice", 19), ("once", 23), ("twice", 17)] {
        file.extend(doubles(name, &vec![1.5; count], false));
    }
    std::fs::write(&path, file).unwrap();
    let arrays = Arrays::open(&path).unwrap().unwrap();
    let names: Vec<&str> = arrays.entries().iter().map(|e| e.name.as_str()).collect();
    assert_eq!(names, ["once"]);
    assert_eq!(arrays.passed_over()[0].what, Other::Repeated);
    let error = arrays.column("twice").unwrap_err().to_string();
    assert!(
        error.contains("stands in the file more than once"),
        "{error}"
    );
}
