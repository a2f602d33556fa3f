//! This file says that no claim of the proofs stands outside their ledger.

use std::fs;

use serde_json::Value;

use crate::tidy::assert_tidy;
use crate::tidy::rust::claim_names;
use crate::tidy::workspace::root;

#[test]
fn every_claim_and_harness_has_its_line_in_the_ledger() {
    let claims = claim_names();
    assert!(claims.len() > 19, "only {} claims are read", claims.len());
    assert_tidy("claims outside the ledger", outside(&claims, &ledger()));
}

#[test]
fn every_planted_mutant_is_refuted_in_the_ledger() {
    let mutants: toml::Table = read("proofs/mutants.toml").parse().unwrap();
    let names: Vec<String> = mutants["mutant"]
        .as_array()
        .unwrap()
        .iter()
        .map(|mutant| mutant["name"].as_str().unwrap().to_owned())
        .collect();
    assert!(names.len() > 19, "only {} mutants are planted", names.len());
    assert_tidy("mutants that live", living(&names, &ledger()));
}

#[test]
fn every_false_claim_is_refuted_in_the_ledger() {
    let ledger = ledger();
    let false_claims = ledger["false_claims"].as_array().unwrap();
    assert!(
        false_claims.len() > 1,
        "{} false claims",
        false_claims.len()
    );
    assert_tidy("false claims that are believed", believed(false_claims));
}

/// False claims that some engine did not refute.
fn believed(false_claims: &[Value]) -> Vec<String> {
    let refuted = |entry: &&Value| {
        let verdicts = entry["verdicts"].as_array().unwrap();
        let says_no = |verdict: &Value| verdict["word"] == "REFUTED";
        !verdicts.is_empty() && verdicts.iter().all(says_no)
    };
    let believed = false_claims.iter().filter(|entry| !refuted(entry));
    believed
        .map(|entry| {
            format!(
                "proofs/ledger.json: {} is false and not refuted",
                entry["claim"]
            )
        })
        .collect()
}

#[test]
fn a_ledger_without_a_line_is_noticed() {
    let ledger: Value = serde_json::from_str(
        r#"{"claims": [{"claim": "here", "verdicts": [{"word": "PROVED"}]}, {"claim": "broken", "verdicts": [{"word": "REFUTED"}]}],
            "mutants": [{"mutant": "dead", "engine": "smt"}, {"mutant": "alive", "engine": null}]}"#,
    )
    .unwrap();
    let names =
        |names: &[&str]| -> Vec<String> { names.iter().map(|&name| name.to_owned()).collect() };
    assert_eq!(outside(&names(&["here"]), &ledger).len(), 0);
    assert_eq!(
        outside(&names(&["here", "elsewhere", "broken"]), &ledger).len(),
        2
    );
    assert_eq!(believed(ledger["claims"].as_array().unwrap()).len(), 1);
    assert_eq!(living(&names(&["dead"]), &ledger).len(), 0);
    assert_eq!(
        living(&names(&["dead", "alive", "unknown"]), &ledger).len(),
        2
    );
}

/// Claims that the ledger does not name, or that it says are refuted.
fn outside(claims: &[String], ledger: &Value) -> Vec<String> {
    let fine = |name: &String| {
        let entry = ledger["claims"]
            .as_array()
            .unwrap()
            .iter()
            .find(|entry| entry["claim"] == **name);
        entry.is_some_and(|entry| {
            let verdicts = entry["verdicts"].as_array().unwrap();
            verdicts.iter().all(|verdict| verdict["word"] != "REFUTED")
        })
    };
    let absent = claims.iter().filter(|name| !fine(name));
    absent
        .map(|name| {
            format!("proofs/ledger.json: `{name}` does not stand there unrefuted: run `prove`")
        })
        .collect()
}

/// Mutants that the ledger does not say are refuted.
fn living(mutants: &[String], ledger: &Value) -> Vec<String> {
    let refuted = |name: &String| {
        let entries = ledger["mutants"].as_array().unwrap();
        entries
            .iter()
            .any(|entry| entry["mutant"] == **name && entry["engine"].is_string())
    };
    let alive = mutants.iter().filter(|name| !refuted(name));
    alive
        .map(|name| {
            format!("proofs/mutants.toml: `{name}` is not refuted in the ledger: run `prove`")
        })
        .collect()
}

fn ledger() -> Value {
    serde_json::from_str(&read("proofs/ledger.json")).unwrap()
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}
