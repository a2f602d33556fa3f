//! This file holds the verb that says whether a controller may go on the rig.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::desk::{Desk, assert_shape_of};
use serde_json::Value;

const SOUND: &str =
    "[controller]\nnamed = \"sdof_with_gap\"\n[baseline]\nnamed = \"proportional_low\"\n";
const SCHEMA: &str = include_str!("../../../docs/certificate.schema.json");

#[test]
fn a_sound_controller_may_go_and_its_certificate_is_checked() {
    let desk = Desk::new();
    desk.put("certify.toml", SOUND);
    let line = "certify certify.toml --scenarios 24 --seconds 1 --out done";
    let text = desk.prints(line, 0);
    assert!(
        desk.read("done/certificate.html")
            .contains("may go on the rig, as far as 24 simulated trials can say")
    );
    assert!(
        text.starts_with("May go on the rig: no law was broken in 24 scenarios"),
        "{text}"
    );
    for words in [
        "Not looked at",
        "influence:",
        "Proved",
        "the baseline:",
        "came to the path's end",
        "of 180 cells visited",
        "exact sign test",
        "certificate.json",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let page = desk.read("done/certificate.html");
    for words in [
        "How often each law was met, and where",
        "cells that no trial visited",
        "What is asked for, and what stands for it",
        "A gap surrounding the desired path within which no control action is taken.",
        "No limit was given",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let certificate: Value = serde_json::from_str(&desk.read("done/certificate.json")).unwrap();
    assert_shape_of(&certificate, SCHEMA);
    let ended = certificate["ended"]["controller"].as_object().unwrap();
    let ended: u64 = ended.values().map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(ended, 24);
    assert_eq!(desk.json(&format!("{line} --json"), 0), certificate);
    let checked = desk.json(
        "certify --check done/certificate.json --sample 16 --json",
        0,
    );
    assert_eq!(checked["same_build"], true);
    assert_eq!(checked["wrong"].as_array().unwrap().len(), 0);
    let changed = desk
        .read("done/certificate.json")
        .replace("\"seed\": 1,", "\"seed\": 2,");
    desk.put("changed.json", &changed);
    let answer = desk.rigproof("certify --check changed.json");
    assert_eq!(answer.status.code(), Some(3));
    assert!(
        String::from_utf8(answer.stderr)
            .unwrap()
            .contains("it was changed after it was written")
    );
}

#[test]
fn limits_that_are_broken_are_said_and_end_with_one() {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        &format!("{SOUND}[limits]\nswitching_per_s = 0.5\n"),
    );
    let text = desk.prints(
        "certify certify.toml --scenarios 16 --seconds 1 --out no",
        1,
    );
    assert!(
        text.starts_with("Must NOT go on the rig:\n  switching_per_s: 95 of 100 trials come to "),
        "{text}"
    );
    let allowed = "1/s, where certify.toml allows 0.5 1/s";
    assert_eq!(text.matches(allowed).count(), 2, "{text}");
    let page = desk.read("no/certificate.html");
    assert!(page.contains(allowed) && page.contains("limits-table"));
    // One limit that holds is shown too, with its worst trial.
    desk.put(
        "certify.toml",
        &format!(
            "{SOUND}[limits]\nfinish_s = 1e9\nswitching_per_s = 1000\n[[requirement]]\nsays = \"not restless\"\nmetric = \"switching_per_s\"\n"
        ),
    );
    let text = desk.prints(
        "certify certify.toml --scenarios 16 --seconds 1 --out some",
        1,
    );
    assert!(
        text.contains("within its limit: switching_per_s: 95 of 100 trials come to")
            && text.contains("BEYOND ITS LIMIT: finish_s")
            && text.contains("✔ “not restless”: switching_per_s, 16 trials"),
        "{text}"
    );
    desk.prints("certify --check no/certificate.json", 0);
}

#[test]
fn parts_merge_to_the_certificate_of_the_whole() {
    let desk = Desk::new();
    desk.put("certify.toml", SOUND);
    let line = "certify certify.toml --scenarios 40 --seconds 0.3 --seed 7";
    desk.prints(&format!("{line} --out whole --jobs 1"), 0);
    for part in 1..=3 {
        let text = desk.prints(&format!("{line} --shard {part}/3 --out part-{part}"), 0);
        assert!(
            text.contains(&format!("Part {part} of 3 is done")),
            "{text}"
        );
    }
    desk.prints("certify merge part-3 part-1 part-2 --out merged", 0);
    assert!(desk.read("merged/certificate.json") == desk.read("whole/certificate.json"));
    let answer = desk.rigproof("certify merge part-3 part-1 --out less");
    assert_eq!(answer.status.code(), Some(3));
}

#[test]
fn a_campaign_that_is_killed_goes_on_to_the_same_certificate() {
    let desk = Desk::new();
    desk.put("certify.toml", SOUND);
    let line = "certify certify.toml --scenarios 160 --seconds 2 --jobs 2";
    desk.prints(&format!("{line} --out whole"), 0);
    let words: Vec<String> = format!("{line} --out killed")
        .split_whitespace()
        .map(str::to_owned)
        .collect();
    let journal = desk.path("killed/journal.jsonl");
    let mut killed = 0;
    for _ in 0..3 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_rigproof"))
            .args(&words)
            .current_dir(desk.path(""))
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let size = || std::fs::metadata(&journal).map_or(0, |data| data.len());
        let before = size();
        // Killed as soon as something was done.
        while size() <= before.max(1000) && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        killed += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(killed > 0);
    assert!(!desk.path("killed/certificate.json").exists() || killed < 3);
    desk.prints(&format!("{line} --out killed"), 0);
    assert!(desk.read("killed/certificate.json") == desk.read("whole/certificate.json"));
}

#[test]
fn wrong_descriptions_are_refused_with_their_place() {
    let desk = Desk::new();
    for (text, words) in [
        (
            "[controller]\nnamed = \"sdof\"\ngap = 3\n",
            "certify.toml, line 3, column 1: `gap` is no key of `controller`",
        ),
        (
            "[controller]\nkind = \"proportional\"\ngain_n_s_per_m = -3\n",
            "give a number from 0 to 1000000",
        ),
        ("name = \"x\"\n", "add a table [controller]"),
    ] {
        desk.put("certify.toml", text);
        let answer = desk.rigproof("certify certify.toml");
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(3), "{message}");
        assert!(message.contains(words), "{message}");
    }
    for line in [
        "certify",
        "certify certify.toml --shard 3/2",
        "certify certify.toml --seconds 0",
    ] {
        assert_eq!(desk.rigproof(line).status.code(), Some(2), "{line}");
    }
}

/// The example of a compiled controller brakes whatever its sensors say.
#[cfg(target_os = "linux")]
#[test]
fn a_compiled_controller_that_brakes_on_a_fault_is_refused_and_shown_again() {
    let desk = Desk::new();
    let damper = std::path::Path::new(crate::controller::ROOM).join("examples/damper.c");
    if crate::controller::compiled(&damper, &desk.path("damper.so")).is_none() {
        return;
    }
    desk.put("damper.toml", "[declares]\nmost_brakes = 4\n");
    let given = "--controller damper.so";
    let line = format!("certify damper.toml {given} --scenarios 16 --seconds 1 --out out");
    let text = desk.prints(&line, 1);
    assert!(
        text.starts_with("Must NOT go on the rig:\n  the law safe is broken"),
        "{text}"
    );
    let replay = "certify --replay out/finding-safe.json";
    assert!(
        text.contains(&format!("rigproof {replay} {given}")),
        "{text}"
    );
    let again = desk.prints(&format!("{replay} {given}"), 1);
    assert!(again.starts_with("The law safe is broken again"), "{again}");
    let checked = desk.prints(&format!("certify --check out/certificate.json {given}"), 0);
    assert!(checked.starts_with("The certificate holds"), "{checked}");
    assert_eq!(desk.rigproof(replay).status.code(), Some(2));
    // What it was limited to is in the file.
    let limited = desk.rigproof(&format!("{replay} {given} --tick-ms 7"));
    assert_eq!(limited.status.code(), Some(2));
    // Another library is another controller.
    let mut bytes = std::fs::read(desk.path("damper.so")).unwrap();
    bytes.push(0);
    std::fs::write(desk.path("other.so"), bytes).unwrap();
    let other = desk.rigproof(&format!("{replay} --controller other.so"));
    assert_eq!(other.status.code(), Some(3));
    let message = String::from_utf8(other.stderr).unwrap();
    assert!(message.contains("is another controller"), "{message}");
}

/// What breaks is named, also where no sample is, and an old finding does not stay beside a new certificate.
#[cfg(target_os = "linux")]
#[test]
fn how_a_compiled_controller_broke_is_said_and_an_old_finding_goes() {
    let desk = Desk::new();
    let examples = std::path::Path::new(crate::controller::ROOM).join("examples");
    let text = |name: &str| std::fs::read_to_string(examples.join(name)).unwrap();
    let source = text("guarded.c");
    desk.put("damping.h", &text("damping.h"));
    let at_the_end = "rigproof_controller_shutdown(void)\n{\n";
    assert!(source.contains(at_the_end));
    let breaks = source.replace(
        at_the_end,
        &format!("{at_the_end}    *(volatile int *)0 = 1;\n"),
    );
    desk.put("guarded.c", &source);
    desk.put("breaks.c", &breaks);
    for name in ["guarded", "breaks"] {
        let built = (
            desk.path(&format!("{name}.c")),
            desk.path(&format!("{name}.so")),
        );
        if crate::controller::compiled(&built.0, &built.1).is_none() {
            return;
        }
    }
    desk.put(
        "guarded.toml",
        "[declares]\nmost_brakes = 1\nlocks = false\n",
    );
    let line = "certify guarded.toml --scenarios 8 --seconds 0.3";
    let text = desk.prints(&format!("{line} --controller breaks.so --out breaks"), 1);
    let how = "the controller's process ended: in shutdown: signal 11";
    assert!(
        text.contains("the law answers is broken in 8 scenarios") && text.contains(how),
        "{text}"
    );
    let certificate: Value = serde_json::from_str(&desk.read("breaks/certificate.json")).unwrap();
    assert_shape_of(&certificate, SCHEMA);
    let failure = certificate["findings"][0]["failure"].as_str().unwrap();
    assert!(failure.starts_with(how), "{failure}");
    desk.prints(
        "certify --check breaks/certificate.json --controller breaks.so",
        0,
    );
    for part in 1..=2 {
        let part = format!("--shard {part}/2 --out part-{part}");
        desk.prints(&format!("{line} --controller guarded.so {part}"), 0);
    }
    let text = desk.prints(
        "certify merge part-1 part-2 --controller guarded.so --out breaks",
        0,
    );
    assert!(
        text.starts_with("May go on the rig") && text.contains("How the trials ended"),
        "{text}"
    );
    let names = desk.names("breaks");
    assert_eq!(
        names,
        ["certificate.html", "certificate.json", "journal.jsonl"]
    );
}

/// A campaign of a few short trials, searched and signed with `lab.pem`, and how it is checked.
const SEARCHED: &str =
    "certify certify.toml --scenarios 24 --seconds 0.5 --search 12 --sign lab.pem --out out";
const CHECK: &str = "certify --check out/certificate.json --sample 8";

fn searched_and_signed() -> (Desk, String) {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
    desk.prints("certify key lab.pem", 0);
    let text = desk.prints(SEARCHED, 0);
    (desk, text)
}

#[test]
fn a_certificate_is_searched_and_its_worst_cases_are_run_again() {
    let (desk, text) = searched_and_signed();
    let said = "Worse cases that a search found; it proves nothing";
    assert!(text.contains(said), "{text}");
    let certificate: Value = serde_json::from_str(&desk.read("out/certificate.json")).unwrap();
    assert_shape_of(&certificate, SCHEMA);
    let file = certificate["worst"][0]["file"].as_str().unwrap().to_owned();
    let again = desk.prints(&format!("certify --replay out/{file}"), 0);
    assert!(again.contains("to the bit what was found"), "{again}");
    desk.prints(CHECK, 0);
    let worst = desk.read(&format!("out/{file}"));
    let changed = worst.replacen("\"trials\"", " \"trials\"", 1);
    desk.put(&format!("out/{file}"), &changed);
    desk.prints(CHECK, 1);
}

#[test]
fn a_certificate_is_signed_and_checked_with_its_key() {
    let (desk, _) = searched_and_signed();
    desk.prints("certify key other.pem", 0);
    assert_eq!(desk.rigproof("certify key lab.pem").status.code(), Some(3));
    let checked = desk.prints(&format!("{CHECK} --public-key lab.pem.pub"), 0);
    let said = "It is signed by the owner of this key";
    assert!(checked.contains(said), "{checked}");
    assert!(
        desk.prints(CHECK, 0)
            .contains("not looked at: give --public-key")
    );
    let by_another = desk.prints(&format!("{CHECK} --public-key other.pem.pub"), 1);
    let said = "The certificate does NOT hold:\n  The signature is not";
    assert!(by_another.starts_with(said), "{by_another}");
    // Other programs verify it too.
    let openssl = Command::new("openssl")
        .args(["pkeyutl", "-verify", "-pubin", "-inkey", "lab.pem.pub"])
        .args(["-rawin", "-in", "out/certificate.json"])
        .args(["-sigfile", "out/certificate.json.sig"])
        .current_dir(desk.path(""))
        .output();
    match openssl {
        Ok(answer) => assert!(answer.status.success(), "{answer:?}"),
        Err(_) => println!("no openssl: the signature was not verified by another program"),
    }
    let mut signature = std::fs::read(desk.path("out/certificate.json.sig")).unwrap();
    signature[17] ^= 1;
    std::fs::write(desk.path("out/certificate.json.sig"), signature).unwrap();
    desk.prints(&format!("{CHECK} --public-key lab.pem.pub"), 1);
    desk.prints("certify sign out/certificate.json --key other.pem", 0);
    desk.prints(&format!("{CHECK} --public-key other.pem.pub"), 0);
    let no_key = desk.rigproof("certify certify.toml --sign certify.toml --out none");
    assert_eq!(no_key.status.code(), Some(3));
    // A certificate that is not signed has no signature beside it.
    desk.prints(&SEARCHED.replace(" --sign lab.pem", ""), 0);
    assert!(!desk.path("out/certificate.json.sig").exists());
    let unsigned = desk.rigproof(&format!("{CHECK} --public-key lab.pem.pub"));
    assert_eq!(unsigned.status.code(), Some(3));
}

#[test]
fn a_calibration_is_the_plant_or_is_refused_by_what_it_names() {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        "[controller]\nnamed = \"proportional_low\"\n",
    );
    let channel = |name: &str, unit: &str| {
        format!("{name} = {{ channel = \"{name}\", unit = \"{unit}\" }}\n")
    };
    let mut text =
        "name = \"a rig\"\nplant = \"rig\"\nlayout = \"three_brake\"\n[channels]\n".to_owned();
    for (name, unit) in [
        ("theta_a", "rad"),
        ("theta_b", "rad"),
        ("force_x", "N"),
        ("force_y", "N"),
    ] {
        text += &channel(name, unit);
    }
    for name in ["current_a", "current_e", "current_b"] {
        text += &channel(name, "A");
    }
    let with = |effect: &str| format!("{text}[[effect]]\njoint = \"E\"\n{effect}");
    desk.put("found.toml", &with("mechanism = \"dry_offset\"\nlevel = { value = 0.05, unit = \"N·m\", low95 = 0.04, high95 = 0.07 }\n"));
    desk.put(
        "late.toml",
        &with("mechanism = \"dead_time\"\ndelay = { value = 3, unit = \"ms\" }\n"),
    );
    desk.put(
        "hot.toml",
        &with("mechanism = \"thermal_fade\"\nper_joule = { value = 0.003, unit = \"1/J\" }\ncooling = { value = 30, unit = \"s\" }\n"),
    );
    let line = "certify certify.toml --scenarios 24 --seconds 1 --out out --calibration";
    let printed = desk.prints(&format!("{line} found.toml"), 0);
    assert!(
        printed.contains("The plant is drawn from the calibration found.toml: 1 of its mechanisms"),
        "{printed}"
    );
    let certificate: Value = serde_json::from_str(&desk.read("out/certificate.json")).unwrap();
    assert_shape_of(&certificate, SCHEMA);
    assert_eq!(
        certificate["plan"]["rigs"],
        serde_json::json!(["three_brake"])
    );
    desk.prints("certify --check out/certificate.json --sample 8", 0);
    // What acts between command and brake runs too, and the commands are late then.
    let late = line.replace("--out out", "--out late");
    let other = desk.json(&format!("{late} late.toml --json"), 0);
    assert_ne!(other["metrics"], certificate["metrics"]);
    for (file, part) in [
        ("hot.toml", "has no `thermal_fade` at joint E"),
        ("certify.toml", "no calibration of a five-bar"),
    ] {
        let answer = desk.rigproof(&format!("{line} {file}"));
        let message = String::from_utf8(answer.stderr).unwrap();
        assert!(
            answer.status.code() == Some(3) && message.contains(part),
            "{message}"
        );
    }
}

#[test]
fn a_worst_trial_far_off_the_path_is_named_in_the_verdict() {
    let desk = Desk::new();
    // Nothing guides: an adversary takes the tip far away, and no limit was given.
    desk.put("certify.toml", "[controller]\nnamed = \"uncontrolled\"\n");
    let text = desk.prints(
        "certify certify.toml --scenarios 60 --seconds 2 --out far",
        0,
    );
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("May go on the rig"));
    let caution = lines.next().unwrap();
    assert!(
        caution.starts_with("  But in trial ") && caution.contains("mm off the path in the mean"),
        "{text}"
    );
    let page = desk.read("far/certificate.html");
    assert!(page.contains("look at the worst trial") && page.contains("tone-doubt"));
    assert!(!page.contains("verdict tone-good"));
}

#[test]
#[cfg(target_os = "linux")]
fn failures_are_gathered_by_what_they_have_in_common() {
    let desk = Desk::new();
    let damper = std::path::Path::new(crate::controller::ROOM).join("examples/damper.c");
    if crate::controller::compiled(&damper, &desk.path("damper.so")).is_none() {
        return;
    }
    // It brakes, and promises not to.
    desk.put("certify.toml", "[declares]\nmost_brakes = 0\n");
    let line = "certify certify.toml --controller damper.so --scenarios 24 --seconds 0.5 --out no";
    let certificate = desk.json(&format!("{line} --json"), 1);
    assert_shape_of(&certificate, SCHEMA);
    let clusters = certificate["clusters"].as_array().unwrap();
    assert!(!clusters.is_empty() && clusters.len() <= 8);
    let trials: Vec<u64> = clusters
        .iter()
        .map(|own| own["trials"].as_u64().unwrap())
        .collect();
    assert!(trials.is_sorted_by(|one, next| one >= next), "{trials:?}");
    let file = clusters[0]["example"]["file"].as_str().unwrap();
    assert_eq!(file, "cluster-1.json");
    desk.prints(
        &format!("certify --replay no/{file} --controller damper.so"),
        1,
    );
    let page = desk.read("no/certificate.html");
    assert!(page.contains("What the failures have in common"));
}
