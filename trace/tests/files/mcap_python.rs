//! This file holds that Python's packages read what we write and that we read what they write, to the last bit.
//!
//! It makes a virtual environment in the target folder and fetches `mcap`, `mcap-ros2-support` and `rosbags` into it;
//! where that cannot be done it says so and passes over itself.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use rigproof_trace::csv::TimeColumn;
use rigproof_trace::mcap::{self, Between, Extras, Selection, Wanted};
use rigproof_trace::{Channel, Trace};

/// The interpreter of an environment that has the packages, or `None` with a printed line. It is made once, whichever
/// test comes first.
fn python() -> Option<PathBuf> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    PYTHON.get_or_init(environment).clone()
}

fn environment() -> Option<PathBuf> {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let python = home.join("bin").join("python");
    let ready = |python: &Path| {
        let imports = "import mcap, mcap_ros2, rosbags";
        let answer = Command::new(python).args(["-c", imports]).output();
        answer.is_ok_and(|answer| answer.status.success())
    };
    if !ready(&python) {
        // What cannot be made shows in what is not there afterwards.
        let _ = Command::new("python3")
            .args(["-m", "venv"])
            .arg(&home)
            .output();
        let packages = ["mcap==1.*", "mcap-ros2-support==0.6.*", "rosbags==0.11.*"];
        let _ = Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--retries", "1"])
            .args(packages)
            .output();
    }
    if ready(&python) {
        return Some(python);
    }
    println!("passed over: Python with mcap, mcap-ros2-support and rosbags is not at hand");
    None
}

fn script(python: &Path, name: &str, argument: &Path) -> String {
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/python")
        .join(name);
    let answer: Output = Command::new(python)
        .arg(script)
        .arg(argument)
        .output()
        .unwrap();
    assert!(
        answer.status.success(),
        "{}",
        String::from_utf8_lossy(&answer.stderr)
    );
    String::from_utf8(answer.stdout).unwrap()
}

fn bits(value: f64) -> String {
    format!("{:016x}", value.to_bits())
}

#[test]
fn python_reads_what_we_write_sample_for_sample() {
    let Some(python) = python() else {
        return;
    };
    let channel = |name: &str, unit: &str, factor: f64| Channel {
        name: name.into(),
        unit: unit.into(),
        samples: (0..700)
            .map(|k| factor / (1.3 + 0.7 * f64::from(k)))
            .collect(),
    };
    let mut trace = Trace {
        time_s: (0..700).map(|k| 3.2 + 0.0037 * f64::from(k)).collect(),
        channels: vec![
            channel("elbow", "rad", 0.9),
            channel("torque_nm", "N·m", -0.31),
        ],
    };
    trace.channels[1].samples[5] = f64::NAN;
    let extras = Extras {
        attachments: vec![(
            "rig.toml".into(),
            "application/toml".into(),
            b"name = 1".to_vec(),
        )],
        texts: [("seed".to_string(), "4711".to_string())].into(),
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    mcap::write(&path, &trace, &extras).unwrap();
    let said = script(&python, "read.py", &path);
    let lines = |start: &str| -> Vec<Vec<String>> {
        let words = |line: &str| line.split('\t').map(str::to_string).collect::<Vec<_>>();
        said.lines()
            .map(words)
            .filter(|words| words[0] == start)
            .collect()
    };
    let (rows, joints, wrench) = (lines("/rigproof/run"), lines("joints"), lines("wrench"));
    assert_eq!((rows.len(), joints.len(), wrench.len()), (700, 700, 700));
    for row in 0..700 {
        let [elbow, torque] = [0, 1].map(|k| trace.channels[k].samples[row]);
        let time_s = trace.time_s[row];
        let log_time = ((time_s * 1e9).round() as u64).to_string();
        let mut expected = vec![
            "/rigproof/run".to_string(),
            log_time.clone(),
            log_time.clone(),
        ];
        expected.push(format!("time_s={}", bits(time_s)));
        expected.push(format!("elbow_rad={}", bits(elbow)));
        if !torque.is_nan() {
            expected.push(format!("torque_nm={}", bits(torque)));
        }
        assert_eq!(rows[row], expected);
        assert_eq!(joints[row][1..4], [log_time, "elbow".into(), bits(elbow)]);
        if !torque.is_nan() {
            assert_eq!(joints[row][4], bits(torque));
            assert_eq!(wrench[row][6], bits(torque));
        }
    }
    assert_eq!(lines("extras")[0][1..], ["rig.toml", "4711"]);
}

/// What the script says it wrote: times, ns, and angles.
fn times_and_angles(said: &str) -> Vec<(i64, f64)> {
    let row = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        (words[0].parse().unwrap(), words[2].parse().unwrap())
    };
    said.lines().map(row).collect()
}

#[test]
fn we_read_what_python_writes_sample_for_sample() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let said = script(&python, "write.py", folder.path());
    let truth = times_and_angles(&said);
    assert_eq!(truth.len(), 50);
    let wanted = |address: &str| Wanted {
        address: address.into(),
        between: Between::Line,
    };
    let second_ns = 1_749_315_324_000_000_000;
    for name in [
        "ros2.mcap",
        "lz4.mcap",
        "zstd.mcap",
        "plain.mcap",
        "unchunked.mcap",
        "bare.mcap",
        "bag/bag.mcap",
    ] {
        for (time, late_ns) in [(None, 1_200_000), (Some("header.stamp"), 0)] {
            let selection = Selection {
                channels: vec![
                    wanted("/joint_states.position[name=elbow]"),
                    wanted("joint_states.position[name=wrist]"),
                ],
                time: time.map(|name: &str| TimeColumn {
                    name: name.into(),
                    unit: String::new(),
                }),
            };
            let reading = mcap::read(&folder.path().join(name), &selection);
            let reading = reading.unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(
                reading.integrity.is_whole(),
                "{name}: {:?}",
                reading.integrity
            );
            assert_eq!(reading.trace.len(), 50, "{name}");
            for (row, (time_ns, elbow)) in truth.iter().enumerate() {
                let time_s = (time_ns + late_ns - second_ns) as f64 / 1e9;
                assert_eq!(bits(reading.trace.time_s[row]), bits(time_s), "{name}");
                assert_eq!(
                    bits(reading.trace.channels[0].samples[row]),
                    bits(*elbow),
                    "{name}"
                );
                assert_eq!(
                    reading.trace.channels[1].samples[row],
                    -(row as f64),
                    "{name}"
                );
            }
            let said = reading.protocol.join("\n");
            assert!(said.contains("counted from 1749315324 s"), "{name}: {said}");
            assert_eq!(
                time.is_none(),
                said.contains("1.200 ms after its own stamps"),
                "{name}: {said}"
            );
        }
    }
}
