//! This file holds that every verb explains itself.

use std::process::Command;

#[test]
fn every_verb_shows_an_example_and_says_what_it_does() {
    for verb in [
        &["diagnose"][..],
        &["simulate"],
        &["diff"],
        &["demo"],
        &["design"],
        &["convert"],
        &["inspect"],
        &["reproduce"],
        &["golden", "check"],
        &["golden", "regenerate"],
        &["cite"],
        &["identify"],
        &["identify", "brake"],
        &["blind"],
        &["blind", "make"],
        &["blind", "score"],
        &["blind", "trial"],
        &["certify"],
        &["certify", "merge"],
        &["controller"],
        &["controller", "try"],
        &["new"],
        &["completions"],
        &["man"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
        let answer = command.args(verb).arg("--help").output().unwrap();
        let help = String::from_utf8(answer.stdout).unwrap();
        assert_eq!(answer.status.code(), Some(0), "{verb:?}");
        let example = format!("rigproof {}", verb.join(" "));
        let (_, examples) = help.split_once("Example").unwrap();
        assert!(examples.contains(&example), "{help}");
        assert!(
            help.contains("Usage: rigproof") && help.len() > 200,
            "{help}"
        );
        assert!(!help.contains('\u{1b}'), "{verb:?}: colour in a pipe");
    }
}

/// The lines below a heading of a help, up to the next empty line.
fn below<'a>(help: &'a str, heading: &str) -> &'a str {
    let (_, rest) = help.split_once(heading).unwrap();
    rest.split_once("\n\n").map_or(rest, |(own, _)| own)
}

#[test]
fn an_option_stands_below_the_heading_that_it_belongs_to() {
    for (verb, own) in [
        ("diagnose", ["--hold-out ", "--out ", "--jobs ", "--json"]),
        (
            "simulate",
            ["--calibration ", "--out ", "--seed ", "--json"],
        ),
        ("inspect", ["--write-rig ", "--topic ", "--ascii", "--json"]),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
        let answer = command.args([verb, "--help"]).output().unwrap();
        let help = String::from_utf8(answer.stdout).unwrap();
        let (text, options) = (
            below(&help, "\nText recordings"),
            below(&help, "\nOptions:"),
        );
        assert!(text.contains("--separator") && text.contains("--decimal"));
        for option in own {
            assert!(options.contains(option), "{verb} {option}: {options}");
            assert!(!text.contains(option), "{verb} {option}: {text}");
        }
    }
}
