//! This file holds the verb that makes a certificate's monitor: what it writes compiles, and what may not go gets none.

use std::process::Command;

use serde_json::Value;

use crate::desk::Desk;

const SOUND: &str = "[controller]\nnamed = \"sdof_with_gap\"\n[coverage]\nleast_trials = 1\n";
/// Watches with the numbers of the layout that every campaign here has.
const PROGRAM: &str = "#include \"rigproof_monitor_constants.h\"\n\
    uint32_t brakes(void) { return RIGPROOF_MONITOR_THREE_BRAKE.brakes + RIGPROOF_MONITOR_FOUR_BRAKE.brakes; }\n";

#[test]
fn a_certificate_becomes_numbers_that_compile() {
    let desk = Desk::new();
    desk.put("certify.toml", SOUND);
    desk.prints(
        "certify certify.toml --scenarios 16 --seconds 1 --out done",
        0,
    );
    let line = "certify monitor done/certificate.json --out monitor";
    let said = desk.json(&format!("{line} --json"), 0);
    let certificate: Value = serde_json::from_str(&desk.read("done/certificate.json")).unwrap();
    assert_eq!(said["digest"], certificate["digest"]);
    let trials: u64 = said["rigs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|rig| rig["trials"].as_u64().unwrap())
        .sum();
    assert_eq!(trials, 16);
    let source = desk.read("monitor/rigproof_monitor.rs");
    let header = desk.read("monitor/rigproof_monitor_constants.h");
    for rig in ["THREE_BRAKE", "FOUR_BRAKE"] {
        assert!(source.contains(&format!("pub const {rig}: Constants = Constants {{")));
        assert!(header.contains(&format!("RIGPROOF_MONITOR_{rig} = {{")));
    }
    // The same certificate makes the same numbers.
    let text = desk.prints(&line.replace("--out monitor", "--out again"), 0);
    assert!(text.starts_with("3 brakes: tip within x "), "{text}");
    assert_eq!(desk.read("again/rigproof_monitor.rs"), source);
    desk.put("monitor/program.c", PROGRAM);
    let include = concat!(env!("CARGO_MANIFEST_DIR"), "/../impl/c/include");
    let compiled = Command::new("cc")
        .args([
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-ffreestanding",
            "-c",
            "program.c",
        ])
        .arg(format!("-I{include}"))
        .current_dir(desk.path("monitor"))
        .status();
    match compiled {
        Ok(status) => assert!(status.success()),
        Err(error) => println!("no C compiler: {error}"),
    }
}

#[test]
fn what_may_not_go_gets_no_monitor() {
    let desk = Desk::new();
    desk.put(
        "certify.toml",
        &format!("{SOUND}[limits]\nswitching_per_s = 0.1\n"),
    );
    desk.prints("certify certify.toml --scenarios 8 --seconds 1 --out no", 1);
    let text = desk.prints("certify monitor no/certificate.json --out monitor", 1);
    assert!(
        text.starts_with("No monitor: by the certificate the controller must not go on the rig"),
        "{text}"
    );
    assert!(!desk.path("monitor").exists());
}
