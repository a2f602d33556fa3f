//! This file holds what a person may hand to `diagnose` and `simulate` by mistake: one line, exit code 3, and
//! nothing half-written.

use crate::desk::Desk;

/// A desk with a short recording of its rig.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.put(
        "rig.toml",
        "name = \"slide\"\nplant = \"axis\"\nmotion = \"linear\"\n\n[channels]\n\
         position = { channel = \"x\", unit = \"mm\", quantum = 0.01 }\n\
         command = { channel = \"u\", unit = \"V\" }\n\n[parameters]\n\
         inertia = { value = 1.7, unit = \"kg\" }\ncommand_gain = { value = 35.5, unit = \"N/V\" }\n",
    );
    desk.put("run.csv", &recording("x", 400));
    desk
}

fn recording(position: &str, samples: usize) -> String {
    let rows: String = (0..samples)
        .map(|k| format!("{},{}e-2,{}e-1\n", 3.5 + k as f64 * 1e-3, k % 13, k % 7))
        .collect();
    format!("t_s,{position} (mm),u (V)\n{rows}")
}

/// Runs a line that is refused, and looks that nothing is left behind.
fn refused(desk: &Desk, line: &str, expected: &str) {
    let before = desk.names(".");
    let answer = desk.rigproof(line);
    let message = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(3), "{line}: {message}");
    assert!(
        message.starts_with("error: ") && message.lines().count() == 1,
        "{message}"
    );
    assert!(message.contains(expected), "{message} lacks {expected}");
    assert!(answer.stdout.is_empty());
    assert_eq!(desk.names("."), before, "{line}");
}

#[test]
fn a_recording_that_does_not_suit_is_refused() {
    let desk = desk();
    desk.put("other.csv", &recording("y", 40));
    desk.put("backward.csv", &recording("x", 40).replace("3.52,", "3.5,"));
    desk.put("text.toml", "name = ");
    std::fs::create_dir(desk.path("folder")).unwrap();
    for verb in ["diagnose", "simulate"] {
        for (rest, expected) in [
            (
                "other.csv --rig rig.toml",
                "the channel `x` of the rig `slide` is missing",
            ),
            (
                "backward.csv --rig rig.toml",
                "line 22, column 1 `t_s`: the time stamp 3.5 s",
            ),
            ("none.csv --rig rig.toml", "there is no such file"),
            ("run.csv --rig none.toml", "there is no such file"),
            ("run.csv --rig folder", "it is a folder"),
            ("run.csv --rig text.toml", "text.toml, line 1"),
            (
                "run.csv --rig rig.toml --from-s 3.89",
                "10 samples lie between --from-s and --to-s, at least 16 are needed",
            ),
            (
                "run.csv --rig rig.toml --from-s 4.5 --to-s 4",
                "0 samples lie between",
            ),
        ] {
            refused(&desk, &format!("{verb} {rest}"), expected);
        }
    }
    let folder = "folder --rig rig.toml";
    refused(&desk, &format!("simulate {folder}"), "it is a folder");
    refused(&desk, &format!("diagnose {folder}"), "no recording is in");
    refused(
        &desk,
        "diagnose run.csv --rig rig.toml --hold-out other.csv",
        "`x`",
    );
}

#[test]
fn a_folder_that_holds_somebody_elses_files_stays_as_it_is() {
    let desk = desk();
    std::fs::create_dir(desk.path("mine")).unwrap();
    desk.put("mine/notes.txt", "mine");
    desk.put("notes.txt", "mine");
    for verb in [
        "diagnose run.csv --rig rig.toml --out mine",
        "demo --out mine",
        "blind make --plant axis --seed 3 --out mine",
    ] {
        refused(&desk, verb, "`notes.txt`, which this program did not write");
    }
    refused(
        &desk,
        "diagnose run.csv --rig rig.toml --out notes.txt",
        "a file stands where",
    );
    refused(
        &desk,
        "diagnose run.csv --rig rig.toml --out none/found",
        "no such file or folder",
    );
    assert_eq!(desk.names("mine"), ["notes.txt"]);
}

#[test]
fn what_is_read_is_not_replaced() {
    let desk = desk();
    std::fs::create_dir(desk.path("mine")).unwrap();
    for name in ["run.csv", "rig.toml"] {
        desk.put(&format!("mine/{name}"), &desk.read(name));
    }
    desk.put("mine/.rigproof", "run.csv\nrig.toml");
    for line in [
        "diagnose mine/run.csv --rig rig.toml --out mine",
        "diagnose run.csv --rig mine/rig.toml --out ./mine",
        "diagnose run.csv --rig rig.toml --hold-out mine/run.csv --out mine",
        "diagnose mine --rig rig.toml --out mine",
        "simulate mine/run.csv --rig rig.toml --out mine/run.csv",
        "simulate run.csv --rig mine/rig.toml --out mine/../mine/rig.toml",
        "convert mine/run.csv mine/run.csv",
        "identify brake mine/run.csv --rig mine/rig.toml --out mine/rig.toml",
        "blind make --plant rig --seed 3 --experiment mine/run.csv --out mine",
    ] {
        refused(&desk, line, "would replace");
    }
    assert_eq!(desk.names("mine"), [".rigproof", "rig.toml", "run.csv"]);
    for name in ["run.csv", "rig.toml"] {
        assert_eq!(desk.read(&format!("mine/{name}")), desk.read(name));
    }
}

#[test]
fn a_wrong_command_line_has_an_exit_code_of_its_own() {
    let desk = desk();
    for line in [
        "diagnose run.csv",
        "diagnose run.csv --rig rig.toml --hold-out-share 0.9",
        "diagnose run.csv --rig rig.toml --hold-out run.csv --hold-out-share 0.2",
        "simulate --rig rig.toml",
        "blind make --plant arm --seed 1 --out case",
        "blind make --plant axis --seed 1 --stratum easy --out case",
        "blind trial --seeds 9..9",
        "blind trial --seeds 9",
    ] {
        let answer = desk.rigproof(line);
        assert_eq!(answer.status.code(), Some(2), "{line}");
    }
    assert_eq!(desk.names("."), ["rig.toml", "run.csv"]);
}

#[test]
fn a_folder_without_recordings_is_refused() {
    let desk = desk();
    std::fs::create_dir(desk.path("runs")).unwrap();
    desk.put("runs/notes.md", "on Tuesday");
    let line = "diagnose runs --rig rig.toml --out out";
    refused(&desk, line, "no recording is in this folder");
}
