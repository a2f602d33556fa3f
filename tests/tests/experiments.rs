//! This file says that what the experiments find is accounted for, and that what they leave behind can be relied on.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use rayon::prelude::*;
use rigproof_experiments::{Experiment, Finding, Outcome, Verdict, all};

/// Every experiment with what it left behind; run once for all tests.
fn outcomes() -> &'static [(Experiment, Outcome)] {
    static OUTCOMES: OnceLock<Vec<(Experiment, Outcome)>> = OnceLock::new();
    OUTCOMES.get_or_init(run)
}

fn run() -> Vec<(Experiment, Outcome)> {
    let experiments = all();
    let one = |experiment: &Experiment| {
        let outcome = (experiment.run)();
        let outcome = outcome.unwrap_or_else(|error| panic!("{}: {error}", experiment.id));
        (*experiment, outcome)
    };
    experiments.par_iter().with_max_len(1).map(one).collect()
}

fn findings() -> impl Iterator<Item = (&'static str, &'static Finding)> {
    let of = |(experiment, outcome): &'static (Experiment, Outcome)| {
        outcome
            .findings
            .iter()
            .map(|finding| (experiment.id, finding))
    };
    outcomes().iter().flat_map(of)
}

fn ids(file: &str, kind: &str) -> BTreeSet<String> {
    let path = format!("{}/../spec/thesis/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    let table: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let records = table[kind].as_array().unwrap();
    records
        .iter()
        .map(|record| record["id"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_disagreement_with_the_text_is_accounted_for_by_an_erratum_or_a_gap() {
    let known: BTreeSet<String> = ids("errata", "erratum")
        .union(&ids("gaps", "gap"))
        .cloned()
        .collect();
    let mut verdicts = [0; 3];
    for (id, finding) in findings() {
        verdicts[finding.verdict as usize] += 1;
        match finding.account {
            Some(account) => assert!(
                known.contains(account),
                "{id}: `{account}` is in neither file"
            ),
            None => assert_ne!(finding.verdict, Verdict::Disagrees, "{id}: {finding:?}"),
        }
    }
    println!("agree, disagree, cannot be compared: {verdicts:?}");
    assert!(verdicts.iter().all(|count| *count > 0), "{verdicts:?}");
}

#[test]
fn an_account_does_not_outlive_its_disagreement() {
    for (id, finding) in findings() {
        if finding.account.is_some() {
            assert_eq!(finding.verdict, Verdict::Disagrees, "{id}: {finding:?}");
        }
    }
}

#[test]
fn an_experiment_comes_out_the_same_twice() {
    for ((experiment, first), (_, second)) in outcomes().iter().zip(run()) {
        // As text, in which a missing number is equal to itself.
        assert!(
            format!("{first:?}") == format!("{second:?}"),
            "{}",
            experiment.id
        );
    }
}

#[test]
fn every_experiment_leaves_tables_pictures_and_findings_that_can_be_written() {
    for (experiment, outcome) in outcomes() {
        let id = experiment.id;
        assert!(!outcome.tables.is_empty(), "{id} writes no table");
        assert!(!outcome.findings.is_empty(), "{id} finds nothing");
        for table in &outcome.tables {
            let bytes = table
                .to_csv()
                .unwrap_or_else(|error| panic!("{id}: {error}"));
            assert!(bytes.iter().filter(|b| **b == b'\n').count() > 1, "{id}");
        }
        let panels = outcome.pictures.iter().flat_map(|picture| {
            assert!(!picture.panels.is_empty(), "{id}: {}", picture.name);
            &picture.panels
        });
        for curve in panels.flat_map(|panel| &panel.curves) {
            assert_eq!(curve.x.len(), curve.y.len(), "{id}: {}", curve.name);
            let finite = curve
                .x
                .iter()
                .zip(&curve.y)
                .filter(|(x, y)| x.is_finite() && y.is_finite());
            assert!(finite.count() > 1, "{id}: {}", curve.name);
        }
        for finding in &outcome.findings {
            assert!(!finding.because.is_empty(), "{id}: {}", finding.statement);
        }
    }
}
