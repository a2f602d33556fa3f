//! This file holds that every verb explains itself.

use std::process::Command;

#[test]
fn every_verb_shows_an_example_and_says_what_it_does() {
    for verb in [
        &["diagnose"][..],
        &["simulate"],
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
