//! This file says that a campaign comes out the same however it is run: on any threads, in parts, after being killed.

use std::fs;
use std::path::Path;

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::campaign::{self, merge};
use rigproof_certify::certificate::{Certificate, Tool};
use rigproof_certify::journal::{Chunks, FILE, Shard};
use rigproof_certify::plan::{FORM, Plan, Subject};
use rigproof_spec::methods::Method;

use crate::five::BOTH;

pub fn plan() -> Plan {
    Plan {
        form: FORM,
        name: "a test".to_owned(),
        controller: Subject::built_in(BuiltIn::of(Method::SdofWithGap)),
        baseline: Some(Subject::built_in(BuiltIn::of(Method::ProportionalLow))),
        rigs: BOTH.to_vec(),
        seed: 23,
        scenarios: 44,
        ticks: 300,
        limits: [None; 5],
        regressions: [None; 5],
    }
}

pub fn run(plan: &Plan, shard: Shard, folder: &Path, threads: usize) -> Chunks {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    let sources = plan.sources().unwrap();
    pool.install(|| campaign::run(plan, &sources, shard, folder, &|_| ()))
        .unwrap()
}

pub fn certificate(plan: &Plan, chunks: &Chunks) -> String {
    let tool = Tool {
        version: "0.1.0".to_owned(),
        sha256: "00".repeat(32),
    };
    Certificate::new(plan, chunks, Vec::new(), tool)
        .unwrap()
        .to_json()
        .unwrap()
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let of = |threads: usize| {
        let chunks = run(
            &plan,
            [0, 1],
            &folder.path().join(threads.to_string()),
            threads,
        );
        certificate(&plan, &chunks)
    };
    assert_eq!(of(1), of(2));
}

#[test]
fn merged_parts_are_the_whole_bit_for_bit() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let whole = run(&plan, [0, 1], &folder.path().join("whole"), 2);
    let parts: Vec<_> = (0..3)
        .map(|part| folder.path().join(part.to_string()))
        .collect();
    for (part, folder) in (0..).zip(&parts) {
        run(&plan, [part, 3], folder, 2);
    }
    let (merged_plan, merged) = merge(&parts).unwrap();
    assert_eq!(
        certificate(&merged_plan, &merged),
        certificate(&plan, &whole)
    );
    let missing = merge(&parts[..2]).unwrap_err().to_string();
    assert!(missing.contains("are missing"), "{missing}");
    let other = folder.path().join("other");
    run(&Plan { seed: 24, ..plan }, [2, 3], &other, 2);
    let mixed = merge(&[parts[0].clone(), parts[1].clone(), other]).unwrap_err();
    assert!(mixed.to_string().contains("plan differs"), "{mixed}");
}

#[test]
fn a_journal_that_ends_anywhere_goes_on_to_the_same_bytes() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    let whole = run(&plan, [0, 1], &folder.path().join("whole"), 2);
    let expected = certificate(&plan, &whole);
    let journal = fs::read(folder.path().join("whole").join(FILE)).unwrap();
    for cut in [
        0,
        7,
        journal.len() / 3,
        journal.len() / 2,
        journal.len() - 1,
        journal.len(),
    ] {
        let killed = folder.path().join(format!("killed-{cut}"));
        fs::create_dir(&killed).unwrap();
        fs::write(killed.join(FILE), &journal[..cut]).unwrap();
        assert_eq!(
            certificate(&plan, &run(&plan, [0, 1], &killed, 2)),
            expected,
            "{cut}"
        );
    }
}

#[test]
fn a_folder_of_another_campaign_is_left_alone() {
    let (plan, folder) = (plan(), tempfile::tempdir().unwrap());
    run(
        &Plan {
            scenarios: 8,
            ..plan.clone()
        },
        [0, 1],
        folder.path(),
        2,
    );
    let before = fs::read(folder.path().join(FILE)).unwrap();
    let sources = plan.sources().unwrap();
    let refused = campaign::run(&plan, &sources, [0, 1], folder.path(), &|_| ()).unwrap_err();
    assert!(
        refused.to_string().contains("another campaign"),
        "{refused}"
    );
    assert_eq!(fs::read(folder.path().join(FILE)).unwrap(), before);
}
