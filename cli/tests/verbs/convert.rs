//! This file holds what `rigproof convert` makes of recordings, the public ones where they are at hand.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rigproof_trace::csv;
use rigproof_trace::rig::{Plant, Rig};

fn convert(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
    command.arg("convert").args(arguments).output().unwrap()
}

/// A public recording, or `None` with a printed line where there is none.
pub fn public(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let data = std::env::var_os("RIGPROOF_DATA").map_or(root.join("../shared/data"), PathBuf::from);
    let path = data.join(name);
    if path.exists() {
        return Some(path);
    }
    println!("passed over: the recording {name} is not at hand, see docs/recordings.md");
    None
}

fn rig(name: &str) -> Rig {
    Rig::read(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../rigs")
            .join(name),
    )
    .unwrap()
}

#[test]
fn text_is_normalised_and_described_as_json() {
    let folder = tempfile::tempdir().unwrap();
    let (input, output) = (folder.path().join("in.csv"), folder.path().join("out.csv"));
    let rows: String = (0..20)
        .map(|i| format!("{},{}.5,7\r\n", -3 * i, 10 * i))
        .collect();
    fs::write(
        &input,
        format!("# by hand\r\ntheta_A,stamp,spare\r\n{rows}"),
    )
    .unwrap();
    let answer = convert(&[
        input.to_str().unwrap(),
        output.to_str().unwrap(),
        "--variables=theta_A",
        "--time-from=stamp",
        "--unit=stamp=ms",
        "--unit=theta_A=deg",
        "--json",
    ]);
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let said: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(said["samples"], 20);
    assert_eq!(
        said["channels"],
        serde_json::json!([{ "name": "theta_A", "unit": "deg" }])
    );
    let text = fs::read_to_string(&output).unwrap();
    assert!(
        text.starts_with("time (s),theta_A (deg)\n0.0005,0.0\n0.0105,-3.0\n"),
        "{text}"
    );
}

#[test]
fn the_bouc_wen_benchmark_suits_its_rig() {
    let Some(input) = public("boucwen/test.h5") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("multisine.csv");
    let answer = convert(&[
        input.to_str().unwrap(),
        output.to_str().unwrap(),
        "--group=multisine",
        "--variables=u,y",
        "--rate-from=fs",
        "--unit=u=N",
        "--unit=y=m",
    ]);
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let recording = rig("bouc-wen.toml").read_recording(&output).unwrap();
    assert_eq!(
        (recording.plant, recording.time_s.len()),
        (Plant::Axis, 8192)
    );
    assert!((recording.time_s[750] - 1.0).abs() < 1e-12);
    assert_eq!(recording.position.samples[0], 0.0001899147452880088);
    assert_eq!(recording.drive.unwrap().samples[1], 26.257577184709955);
}

#[test]
fn columns_of_a_matlab_file_agree_with_the_published_text() {
    let (Some(input), Some(text)) = (
        public("mr_damper/data_simulation_4.4_MRdamper.mat"),
        public("mr_damper/data_simulation_4.4_MRdamper.csv"),
    ) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("damper.csv");
    let answer = convert(&[
        input.to_str().unwrap(),
        output.to_str().unwrap(),
        "--variables=dist,forc,forc1[1]",
        "--time-from=forc1[0]",
        "--unit=forc=N",
    ]);
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let (converted, text) = (csv::read(&output).unwrap(), csv::read(&text).unwrap());
    for (from_matlab, published) in [("dist", "dist_mm_raw"), ("forc", "forc_N_raw")] {
        let published = &text.channel(published).unwrap().samples;
        let channel = &converted.channel(from_matlab).unwrap().samples;
        let apart = rigproof_trace::compare::compare(published, channel).unwrap();
        // The text was printed with seven digits.
        assert!(
            apart.pairs == 1501 && apart.maximum < 1e-4,
            "{from_matlab}: {apart:?}"
        );
    }
    let first = converted.channel("forc1[1]").unwrap().samples[0];
    assert!((first + 39.70854796).abs() < 1e-8, "{first}");
}

#[test]
fn the_public_text_recordings_suit_their_rigs() {
    for (rig_name, file, samples) in [
        ("emps.toml", "emps/DATA_EMPS.csv", 24841),
        ("emps.toml", "emps/DATA_EMPS_PULSES.csv", 24841),
        (
            "mr-damper.toml",
            "mr_damper/data_simulation_4.1_MRdamper.csv",
            3001,
        ),
        ("mr-damper.toml", "mr_damper/ensaio.A.1.csv", 1501),
    ] {
        let rig = rig(rig_name);
        let Some(path) = public(file) else {
            return;
        };
        let recording = rig.read_recording(&path).unwrap();
        assert_eq!(recording.time_s.len(), samples, "{file}");
        if let Some(force) = recording.force {
            // Force and speed have the same sense: their product is positive on the whole.
            let motion: Vec<f64> = recording
                .position
                .samples
                .windows(2)
                .map(|x| x[1] - x[0])
                .collect();
            let mean = force.samples.iter().sum::<f64>() / samples as f64;
            let work: f64 = motion
                .iter()
                .zip(&force.samples)
                .map(|(dx, f)| dx * (f - mean))
                .sum();
            assert!(work > 0.0, "{file}");
        }
    }
}

#[test]
fn a_rig_handed_another_plants_recording_says_so() {
    let Some(path) = public("emps/DATA_EMPS.csv") else {
        return;
    };
    let rig = Rig {
        channels: rigproof_trace::rig::Channels {
            time: None,
            ..rig("mr-damper.toml").channels
        },
        ..rig("mr-damper.toml")
    };
    let message = rig.read_recording(&path).unwrap_err().to_string();
    assert!(
        message.contains("it is the recording of another plant"),
        "{message}"
    );
}

#[test]
fn every_rig_reads_back_from_what_is_written() {
    for name in ["emps.toml", "mr-damper.toml", "bouc-wen.toml", "sweep.toml"] {
        let rig = rig(name);
        assert_eq!(Rig::parse(&rig.to_toml(), Path::new(name)).unwrap(), rig);
    }
}
