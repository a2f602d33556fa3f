//! This file says that what the experiments find is accounted for, and that their findings can be relied on.

use std::collections::BTreeSet;

use rigproof_experiments::{Experiment, Finding, Verdict, all};

fn findings() -> Vec<(Experiment, Finding)> {
    let of = |experiment: Experiment| {
        let outcome = (experiment.run)().unwrap();
        outcome
            .findings
            .into_iter()
            .map(move |finding| (experiment, finding))
    };
    all().into_iter().flat_map(of).collect()
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
    for (experiment, finding) in findings() {
        let id = experiment.id;
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
    for (experiment, finding) in findings() {
        if finding.account.is_some() {
            assert_eq!(
                finding.verdict,
                Verdict::Disagrees,
                "{}: {finding:?}",
                experiment.id
            );
        }
    }
}

#[test]
fn an_experiment_comes_out_the_same_twice() {
    for experiment in all() {
        // As text, in which a missing number is equal to itself.
        let run = || format!("{:?}", (experiment.run)());
        assert!(run() == run(), "{}", experiment.id);
    }
}
