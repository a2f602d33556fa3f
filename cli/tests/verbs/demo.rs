//! This file holds the demonstration, which needs no file: hide, diagnose, open the seal.

use crate::desk::{Desk, assert_shape};

#[test]
fn the_hidden_causes_are_named_and_the_model_is_calibrated() {
    let desk = Desk::new();
    let shown = desk.json("demo --out shown --json", 0);
    let report = &shown["report"];
    assert_shape(report);
    assert_eq!(report["verdict"], "explained");
    let mechanisms = |effects: &serde_json::Value| -> Vec<String> {
        let effects = effects.as_array().unwrap().iter();
        let mut names: Vec<String> = effects
            .map(|effect| effect["mechanism"].as_str().unwrap().to_owned())
            .collect();
        names.sort();
        names
    };
    let named = mechanisms(&report["effects"]);
    assert_eq!(named.len(), 2);
    assert_eq!(named, mechanisms(&shown["answer"]["effects"]));
    let held_out = &report["fit"]["held_out"];
    let nrmse = |when: &str| held_out[when].as_f64().unwrap();
    assert!(
        nrmse("nrmse_after") < 0.05 * nrmse("nrmse_before"),
        "{held_out}"
    );

    assert_eq!(
        desk.names("shown"),
        [
            ".rigproof",
            "answer.sealed",
            "before-after.svg",
            "calibration.toml",
            "recording.csv",
            "report.html",
            "report.json",
            "residual.svg",
            "rig.toml",
        ]
    );
    let written: serde_json::Value = serde_json::from_str(&desk.read("shown/report.json")).unwrap();
    assert_eq!(&written, report);
    let commitment = shown["commitment"].as_str().unwrap();
    assert!(desk.read("shown/answer.sealed").contains(commitment));
    // The files alone tell the same: the rig and the recording are what was diagnosed.
    let scored = desk.json(
        "blind score shown/answer.sealed shown/report.json --json",
        0,
    );
    assert_eq!(scored["score"], shown["score"]);
    assert_eq!(scored["score"]["exact"], true);
    let numbers = scored["score"]["parameters"].as_array().unwrap();
    assert!(numbers.len() > 3, "{scored}");
    for number in numbers {
        assert_eq!(number["covered"], true, "{number}");
    }
    let with = "simulate shown/recording.csv --rig shown/rig.toml --json";
    let rms = |line: &str| desk.json(line, 0)["rms"].as_f64().unwrap();
    let calibrated = rms(&format!("{with} --calibration shown/calibration.toml"));
    assert!(calibrated < 0.05 * rms(with), "{calibrated}");
}

#[test]
fn the_commitment_is_printed_before_anything_is_named() {
    let desk = Desk::new();
    let text = desk.prints("demo", 0);
    assert!(text.lines().count() <= 18, "{text}");
    assert!(!text.contains('\u{1b}'), "{text}");
    let sealed: serde_json::Value =
        serde_json::from_str(&desk.read("rigproof-demo/answer.sealed")).unwrap();
    in_order(
        &text,
        &[
            sealed["commitment"].as_str().unwrap(),
            "Cause found: the model leaves out",
            "viscous friction: coefficient",
            " on held-out data",
            "rigproof-demo/report.html",
            "The seal is opened. Hidden were:",
            "viscous: coefficient",
            "Every name is right",
            "4 of 4 intervals hold the hidden number",
        ],
    );
    let whole = desk.prints("demo --verbose", 0);
    in_order(
        &whole,
        &[
            sealed["commitment"].as_str().unwrap(),
            "explained: the model left out",
            "Where the model is wrong",
            "What the model left out",
            "held-out data",
            "The seal is opened.",
            "Hidden (masked)",
            "Named (explained)",
            "rigproof-demo/before-after.svg",
        ],
    );
}

/// Each of the words stands in the text, one after another.
fn in_order(text: &str, words: &[&str]) {
    let mut from = 0;
    for word in words {
        let place = text[from..].find(word);
        from += place.unwrap_or_else(|| panic!("{word} is missing: {text}"));
    }
}
