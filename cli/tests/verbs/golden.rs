//! This file holds what `rigproof golden` finds and writes.

use std::fs;
use std::path::Path;

use crate::desk::Desk;

/// A case that is computed in a moment.
const CASE: &str = "brake_current_a";

/// A desk with a copy of the checked-in case.
fn desk() -> Desk {
    let desk = Desk::new();
    let checked_in = Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden/cases");
    let folder = desk.path("golden/cases").join(CASE);
    fs::create_dir_all(&folder).unwrap();
    for name in ["manifest.toml", "input.csv", "expected.csv"] {
        fs::copy(checked_in.join(CASE).join(name), folder.join(name)).unwrap();
    }
    desk
}

fn file(name: &str) -> String {
    format!("golden/cases/{CASE}/{name}")
}

#[test]
fn a_checked_in_case_is_what_the_model_computes() {
    let desk = desk();
    let printed = desk.prints(&format!("golden check {CASE}"), 0);
    assert!(
        printed.contains("1 cases, 2 runs: each is what the model computes"),
        "{printed}"
    );
    let report = desk.json(&format!("golden check {CASE} --json"), 0);
    assert_eq!(report["checked"][0], CASE);
    assert_eq!(report["differences"].as_array().unwrap().len(), 0);
}

#[test]
fn a_changed_digit_is_found_named_and_mended() {
    let desk = desk();
    let good = desk.read(&file("expected.csv"));
    // Row 71 below the heading: its fourth cell is the torque.
    let line = good.lines().nth(71).unwrap();
    let torque = line.split(',').nth(3).unwrap();
    let last = torque.find('e').unwrap() - 1;
    let digit = torque.as_bytes()[last];
    let other = if digit == b'7' { "3" } else { "7" };
    let wrong = format!("{}{other}{}", &torque[..last], &torque[last + 1..]);
    let changed = line.replacen(torque, &wrong, 1);
    desk.put(&file("expected.csv"), &good.replacen(line, &changed, 1));

    let report = desk.json(&format!("golden check {CASE} --json"), 1);
    let differences = report["differences"].as_array().unwrap();
    assert_eq!(differences.len(), 2, "{report}");
    let hash = differences[0]["problem"].as_str().unwrap();
    assert!(hash.starts_with("its sha256 is "), "{report}");
    let cell = &differences[1]["cell"];
    assert_eq!(cell["column"], "torque");
    assert_eq!(cell["unit"], "N·m");
    assert_eq!(cell["row"], 71);
    assert_eq!(cell["found"], wrong.as_str());
    assert_eq!(cell["computed"], torque);
    let printed = desk.prints(&format!("golden check {CASE}"), 1);
    let row =
        format!("row 71 (run 1), column `torque`: {wrong} N·m here, {torque} N·m as computed");
    assert!(printed.contains(&row), "{printed}");
    let command = format!("rigproof golden regenerate {CASE}");
    assert!(printed.contains(&command), "{printed}");

    let written = desk.json(&format!("golden regenerate {CASE} --json"), 0);
    let written = written["written"].as_array().unwrap();
    assert_eq!(written[..], [format!("{CASE}/expected.csv")]);
    assert_eq!(desk.read(&file("expected.csv")), good);
    desk.prints(&format!("golden check {CASE}"), 0);
}

#[test]
fn a_manifest_that_says_something_else_is_a_difference_and_a_damaged_one_an_error() {
    let desk = desk();
    let good = desk.read(&file("manifest.toml"));
    desk.put(
        &file("manifest.toml"),
        &good.replacen("reaches = 0.95", "reaches = 0.25", 1),
    );
    let printed = desk.prints(&format!("golden check {CASE}"), 1);
    assert!(
        printed.contains("`shows = { reaches = 0.25 }` here"),
        "{printed}"
    );

    desk.put(
        &file("manifest.toml"),
        &good.replacen("reaches = 0.95", "reaches = 1.95", 1),
    );
    let printed = desk.prints(&format!("golden check {CASE}"), 1);
    assert!(
        printed.contains("does not show that the current comes up"),
        "{printed}"
    );

    for (damaged, expected) in [
        (good.replacen("unit = \"s\"", "unit = ", 1), "line 5: "),
        (good.replacen("purpose", "porpoise", 1), "porpoise"),
    ] {
        desk.put(&file("manifest.toml"), &damaged);
        let answer = desk.rigproof(&format!("golden check {CASE}"));
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(
            message.contains("manifest.toml: ") && message.contains(expected),
            "{message}"
        );
        assert!(message.contains("rigproof golden regenerate"), "{message}");
        assert_eq!(message.lines().count(), 1);
    }
}

#[test]
fn a_missing_file_a_missing_folder_and_an_unknown_case_are_told_apart() {
    let desk = desk();
    fs::remove_file(desk.path(&file("input.csv"))).unwrap();
    let printed = desk.prints(&format!("golden check {CASE}"), 1);
    assert!(
        printed.contains("input.csv: the file is missing"),
        "{printed}"
    );
    let printed = desk.prints("golden check brake_current_b", 1);
    assert!(
        printed.contains("brake_current_b/manifest.toml: the file is missing"),
        "{printed}"
    );
    for (line, code, expected) in [
        (
            "golden check --cases elsewhere",
            3,
            "there is no folder `elsewhere`",
        ),
        (
            "golden regenerate --cases elsewhere",
            3,
            "name the folder with --cases",
        ),
        (
            "golden check brake_curent_a",
            2,
            "did you mean `brake_current_a`?",
        ),
        ("golden regenerate step", 2, "`step` is no golden case"),
    ] {
        let answer = desk.rigproof(line);
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(code), "{message}");
        assert!(message.contains(expected), "{message}");
    }
    assert!(!desk.path("elsewhere").exists());
}
