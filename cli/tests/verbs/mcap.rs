//! This file holds what the verbs do with MCAP files.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn rigproof(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
    command.args(arguments).output().unwrap()
}

fn words(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A run of a slide with viscous drag, as text.
fn run(path: &Path) {
    let rows = (0..900).map(|k| {
        let time_s = 0.3 + 0.001 * f64::from(k);
        let angle = libm::sin(7.0 * time_s) / 3.0;
        let force = 2.9 * 7.0 / 3.0 * libm::cos(7.0 * time_s);
        format!("{time_s:?},{angle:?},{force:?}\n")
    });
    let rows: String = rows.collect();
    fs::write(path, format!("time (s),x (m),load cell (N)\n{rows}")).unwrap();
}

const RIG: &str = r#"
name = "damper"
plant = "bench"
motion = "linear"
[channels]
position = { channel = "POSITION", unit = "m", quantum = 1e-6 }
force = { channel = "FORCE", unit = "N", quantum = 1e-4 }
[[effect]]
mechanism = "viscous"
coefficient = { value = 2.9, unit = "N·s/m" }
"#;

#[test]
fn text_goes_to_mcap_and_back_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    run(Path::new(&path("in.csv")));
    fs::write(path("rig.toml"), RIG).unwrap();
    for (from, to) in [
        ("in.csv", "once.csv"),
        ("once.csv", "run.MCAP"),
        ("run.MCAP", "twice.csv"),
    ] {
        let mut arguments = vec!["convert".to_string(), path(from), path(to)];
        if to.ends_with("MCAP") {
            arguments.extend(["--attach".to_string(), path("rig.toml")]);
        }
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let answer = rigproof(&arguments);
        assert_eq!(answer.status.code(), Some(0), "{answer:?}");
        let said = words(&answer.stderr);
        assert_eq!(
            from.ends_with("MCAP"),
            said.contains("check sums: chunks verified"),
            "{said}"
        );
    }
    assert_eq!(
        fs::read(path("once.csv")).unwrap(),
        fs::read(path("twice.csv")).unwrap()
    );
    let listed = rigproof(&["convert", "--list", &path("run.MCAP")]);
    let listed = words(&listed.stdout);
    for expected in [
        "/rigproof/run.load_cell_n (N)  900 samples",
        "/joint_states.position[name=x]",
        "/wrench.wrench.force.x",
    ] {
        assert!(listed.contains(expected), "{listed}");
    }
    let position = "/joint_states.position[name=x]";
    let taken = rigproof(&[
        "convert",
        &path("run.MCAP"),
        &path("position.csv"),
        "--variables",
        position,
        "--unit",
        &format!("{position}=m"),
    ]);
    assert_eq!(taken.status.code(), Some(0), "{taken:?}");
    let text = fs::read_to_string(path("position.csv")).unwrap();
    assert!(text.contains(&format!("{position} (m)")), "{text:.200}");
    let refused = rigproof(&[
        "convert",
        &path("in.csv"),
        &path("out.csv"),
        "--attach",
        &path("rig.toml"),
    ]);
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn a_verb_reads_a_recording_whatever_it_is_called() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    run(Path::new(&path("in.csv")));
    let made = rigproof(&["convert", &path("in.csv"), &path("run.mcap")]);
    assert_eq!(made.status.code(), Some(0), "{made:?}");
    fs::rename(path("run.mcap"), path("run.csv")).unwrap();
    let mut answers = Vec::new();
    for (recording, position, force) in [
        ("in.csv", "x", "load cell"),
        ("run.csv", "x", "load cell"),
        (
            "run.csv",
            "/joint_states.position[name=x]",
            "/wrench.wrench.force.x",
        ),
    ] {
        let rig = RIG.replace("POSITION", position).replace("FORCE", force);
        fs::write(path("rig.toml"), rig).unwrap();
        let answer = rigproof(&[
            "simulate",
            &path(recording),
            "--rig",
            &path("rig.toml"),
            "--json",
        ]);
        assert_eq!(answer.status.code(), Some(0), "{answer:?}");
        let mut said: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
        let is_text = said["read_as"].is_object();
        assert_eq!(is_text, recording == "in.csv", "{said}");
        for key in ["recording", "rig", "inputs", "file", "read_as"] {
            said.as_object_mut().unwrap().remove(key);
        }
        answers.push(said);
    }
    assert_eq!(answers[0], answers[1]);
    assert!(answers[2].is_object());
}

#[test]
fn golden_runs_are_exported_to_look_at() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("golden").display().to_string();
    let answer = rigproof(&["golden", "export", &target, "brake_step_a"]);
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let file = format!("{target}/brake_step_a-2.mcap");
    let listed = words(&rigproof(&["convert", "--list", &file]).stdout);
    assert!(listed.contains("/rigproof/run.torque_nm (N·m)"), "{listed}");
    assert!(
        listed.contains("check sums: chunks verified, data verified, summary verified"),
        "{listed}"
    );
}

#[test]
fn the_layout_shows_topics_that_we_write() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/foxglove-layout.json");
    let layout: serde_json::Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    let panels = layout["configById"].as_object().unwrap();
    let mut shown = 0;
    for (name, panel) in panels {
        assert!(
            layout["layout"].to_string().contains(name.as_str()),
            "{name}"
        );
        let paths = panel["paths"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|path| &path["value"]);
        for path in paths
            .chain([&panel["topicPath"]])
            .filter_map(|path| path.as_str())
        {
            let known = ["/joint_states.", "/wrench.wrench.", "/rigproof/run"];
            assert!(known.iter().any(|topic| path.starts_with(topic)), "{path}");
            shown += 1;
        }
    }
    assert_eq!((panels.len(), shown), (4, 6));
}
