//! This file is a forger: certificates that say something else, everything that follows computed anew, against checks of all trials and of a sample.

use std::path::Path;

use rigproof_certify::certificate::{Certificate, records};
use rigproof_certify::cluster::{examples, named};
use rigproof_certify::digest;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal::Chunks;
use rigproof_certify::law::Law;
use rigproof_certify::plan::Plan;
use rigproof_certify::recheck::{Checked, Means, recheck};
use rigproof_certify::search::{Worst, search};
use rigproof_certify::summary::laws;
use serde_json::Value;

use crate::runs::{plan, run, tool};

/// The random numbers of the forger, by SplitMix64.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % end as u64) as usize
    }
}

/// A short campaign whose gap is broken, with a search, a finding and worse cases.
fn small() -> Plan {
    let mut plan = Plan {
        scenarios: 20,
        ticks: 60,
        search: 4,
        ..plan()
    };
    plan.controller.declared.gap_m = Some(0.02);
    plan
}

fn honest(plan: &Plan, chunks: &Chunks) -> Certificate {
    let sources = plan.sources().unwrap();
    let searched = search(plan, sources.controller, &records(chunks)).unwrap();
    let found = Finding::all(plan, sources.controller, &records(chunks), &searched.met).unwrap();
    let found = found.iter().map(|found| found.named().unwrap());
    let worst = searched.worst.iter().map(Worst::named);
    let worst = worst.map(Result::unwrap).collect();
    let bare = Certificate::new(plan, chunks, found.collect(), worst, tool()).unwrap();
    let examples = examples(plan, sources.controller, &bare.clusters).unwrap();
    bare.with_examples(named(&examples).unwrap()).unwrap()
}

fn read(certificate: &Certificate) -> Result<Certificate, String> {
    let text = certificate.to_json().unwrap();
    Certificate::parse(&text, Path::new("certificate.json")).map_err(|error| error.to_string())
}

/// What a check says; a certificate that is not even read is refused too.
fn checked(forged: &Certificate, kept: Option<&Chunks>, sample: u64, seed: u64) -> Checked {
    let nothing = |wrong: String| Checked {
        again: 0,
        share: 0.0,
        is_proof: false,
        is_rebuilt: false,
        wrong: vec![wrong],
    };
    let read = match read(forged) {
        Ok(read) => read,
        Err(wrong) => return nothing(wrong),
    };
    let Some(sources) = read.plan.sources() else {
        return nothing("its controller is not at hand".to_owned());
    };
    let means = Means {
        sources,
        kept,
        sample,
        seed,
    };
    recheck(&read, &means).unwrap_or_else(|error| nothing(error.to_string()))
}

/// The places of all leaves and lists of a value, by JSON pointer.
fn places(value: &Value, at: String, all: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                places(value, format!("{at}/{key}"), all);
            }
        }
        Value::Array(list) => {
            all.push(at.clone());
            for (index, value) in list.iter().enumerate() {
                places(value, format!("{at}/{index}"), all);
            }
        }
        _ => all.push(at),
    }
}

/// Says something else at one place.
fn otherwise(value: &mut Value, dice: &mut Dice) {
    match value {
        Value::Bool(is) => *is = !*is,
        Value::Number(number) => {
            let number = number.clone();
            *value = match (number.as_u64(), number.as_f64(), dice.below(4)) {
                (_, _, 0) => Value::Null,
                (Some(whole), _, 1) => (whole / 2).into(),
                (Some(whole), ..) => (whole + 1 + dice.below(3) as u64).into(),
                (None, Some(real), 1) if real != 0.0 => (-real).into(),
                (None, Some(real), 2) if real != 0.0 => (real * 0.93).into(),
                (None, real, _) => (real.unwrap_or(1.0) + 1e-9).into(),
            };
        }
        Value::String(text) if text.len() >= 16 && text.bytes().all(|b| b.is_ascii_hexdigit()) => {
            *text = digest::of_bytes(text.as_bytes())[..text.len().min(64)].to_owned();
        }
        Value::String(text) => text.push('x'),
        Value::Array(list) => match (dice.below(4), list.len()) {
            (0, 1..) => list.clear(),
            (1, 2..) => list.swap(0, 1),
            (2, 1..) => list.push(list[0].clone()),
            _ => drop(list.pop()),
        },
        Value::Null => *value = 1.into(),
        Value::Object(_) => {}
    }
}

/// One semantic change, or two, and all that follows computed anew; `None` where that is no certificate or says the same.
fn forged(honest: &Certificate, dice: &mut Dice) -> Option<Certificate> {
    let mut value = serde_json::to_value(honest).unwrap();
    let mut all = Vec::new();
    for key in [
        "plan",
        "ended",
        "samples",
        "laws",
        "ties",
        "metrics",
        "worst",
        "findings",
        "clusters",
        "requirements",
        "visited",
        "chunks",
        "not_looked_at",
    ] {
        places(&value[key], format!("/{key}"), &mut all);
    }
    for _ in 0..=dice.below(2) {
        let place = &all[dice.below(all.len())];
        otherwise(value.pointer_mut(place)?, dice);
    }
    let forged: Certificate = serde_json::from_value(value).ok()?;
    let forged = forged.sealed().unwrap();
    (forged != *honest).then_some(forged)
}

/// What an expert in the form does: breaks no law any more, in one place after another, with all that follows.
fn emptied(honest: &Certificate) -> Certificate {
    let mut forged = honest.clone();
    for law in &mut forged.laws {
        (law.broken_in, law.first_broken) = (0, None);
        law.worst_margin = law.worst_margin.map(f64::abs);
    }
    forged.findings.clear();
    forged.clusters.clear();
    forged.sealed().unwrap()
}

#[test]
fn five_hundred_semantic_changes_fall_to_a_check_of_all_trials() {
    let (plan, folder) = (small(), tempfile::tempdir().unwrap());
    let chunks = run(&plan, [0, 1], folder.path(), 2);
    let honest = honest(&plan, &chunks);
    assert!(!honest.may_go() && !honest.findings.is_empty() && !honest.worst.is_empty());
    let own = checked(&honest, None, 99, 3);
    assert!(own.is_proof && own.wrong.is_empty(), "{:?}", own.wrong);
    let mut dice = Dice(41);
    let (mut at_once, mut by_running) = (0, 0);
    while at_once + by_running < 500 {
        let Some(forged) = forged(&honest, &mut dice) else {
            continue;
        };
        let found = checked(&forged, None, 99, 3);
        assert!(!found.wrong.is_empty(), "{}", difference(&honest, &forged));
        match found.is_proof {
            true => by_running += 1,
            false => at_once += 1,
        }
    }
    println!("refused: {at_once} when read, {by_running} by running all scenarios again");
    assert!(by_running > 100 && at_once > 100, "{at_once}, {by_running}");
    let fell = checked(&emptied(&honest), None, 99, 3);
    assert!(
        fell.wrong.iter().any(|wrong| wrong.contains("law gap")),
        "{:?}",
        fell.wrong
    );
    assert!(!fell.may_go(&emptied(&honest)));
}

fn difference(one: &Certificate, other: &Certificate) -> String {
    let (one, other) = (one.to_json().unwrap(), other.to_json().unwrap());
    let lines = one.lines().zip(other.lines());
    let differ = lines.filter(|(one, other)| one != other).take(4);
    format!("{:?}", differ.collect::<Vec<_>>())
}

#[test]
fn chunks_cover_the_plan_and_no_more() {
    let (plan, folder) = (small(), tempfile::tempdir().unwrap());
    let honest = honest(&plan, &run(&plan, [0, 1], folder.path(), 2));
    for scenarios in [100_000_000, 25, 16, 0] {
        let mut forged = honest.clone();
        forged.plan.scenarios = scenarios;
        assert!(read(&forged.sealed().unwrap()).is_err(), "{scenarios}");
    }
    let mut more = honest.clone();
    more.chunks.push(more.chunks[0].clone());
    let refused = read(&more.sealed().unwrap()).unwrap_err();
    assert!(refused.contains("records of 4 chunks"), "{refused}");
    // A name that leads out of the folder is none of a finding.
    let mut away = honest;
    away.findings[0].file = "../other/finding-gap.json".to_owned();
    assert!(read(&away.sealed().unwrap()).is_err());
}

/// A campaign of 80 chunks, of which a sample of 64 scenarios runs 8.
fn large() -> (Plan, Chunks, Certificate) {
    let (mut plan, folder) = (small(), tempfile::tempdir().unwrap());
    (plan.scenarios, plan.ticks, plan.search) = (640, 25, 0);
    plan.baseline = None;
    let chunks = run(&plan, [0, 1], folder.path(), 2);
    let honest = Certificate::new(&plan, &chunks, Vec::new(), Vec::new(), tool()).unwrap();
    (plan, chunks, honest)
}

#[test]
fn a_figure_that_is_not_of_the_records_falls_to_any_sample() {
    let (_, chunks, honest) = large();
    let own = checked(&honest, Some(&chunks), 64, 5);
    assert!(own.wrong.is_empty() && own.is_rebuilt && !own.is_proof);
    assert_eq!((own.again, own.share), (64, 0.1));
    let mut dice = Dice(43);
    let mut figures = 0;
    while figures < 60 {
        let Some(forged) = forged(&honest, &mut dice) else {
            continue;
        };
        // Another plan is told by its records, below, and by the plan in the journal.
        if forged.plan != honest.plan {
            continue;
        }
        figures += 1;
        let found = checked(&forged, Some(&chunks), 64, 5);
        assert!(!found.wrong.is_empty(), "{}", difference(&honest, &forged));
    }
    let fell = checked(&emptied(&honest), Some(&chunks), 64, 5);
    assert!(!fell.wrong.is_empty());
}

/// Chance that a draw of `some` out of `all` meets none of `forged`.
fn missed(all: u64, some: u64, forged: u64) -> f64 {
    let one = |k| (all - forged - k) as f64 / (all - k) as f64;
    (0..some).map(one).product()
}

#[test]
fn records_that_were_forged_fall_to_a_sample_as_often_as_it_promises() {
    let (plan, chunks, _) = large();
    for forged_chunks in [4_u64, 16] {
        let (mut seen, rounds) = (0, 60);
        for round in 0..rounds {
            let mut dice = Dice(round);
            let mut forged = chunks.clone();
            let mut places: Vec<u64> = (0..80).collect();
            for _ in 0..forged_chunks {
                let place = places.swap_remove(dice.below(places.len()));
                for record in forged.get_mut(&place).unwrap() {
                    record.ticks -= 1;
                }
            }
            // All figures, hashes and the digest follow from the forged records.
            let certificate = Certificate::new(&plan, &forged, Vec::new(), Vec::new(), tool());
            let found = checked(&certificate.unwrap(), Some(&forged), 64, round * 7 + 1);
            seen += u64::from(!found.wrong.is_empty());
        }
        let promised = 1.0 - missed(80, 8, forged_chunks);
        let sigma = (promised * (1.0 - promised) / rounds as f64).sqrt();
        let share = seen as f64 / rounds as f64;
        println!("{forged_chunks} of 80 chunks forged: seen {share:.2}, promised {promised:.2}");
        assert!(share > promised - 3.0 * sigma, "{share}, {promised}");
    }
}

#[test]
fn without_the_records_a_sample_refuses_what_it_contradicts() {
    let (plan, chunks, honest) = large();
    let broken = laws(&plan, &records(&chunks));
    let gap = broken.iter().find(|law| law.law == Law::Gap).unwrap();
    assert!(gap.broken_in > 64, "{}", gap.broken_in);
    assert!(checked(&honest, None, 64, 9).wrong.is_empty());
    let found = checked(&emptied(&honest), None, 64, 9);
    assert!(!found.is_rebuilt);
    assert!(
        found
            .wrong
            .iter()
            .any(|wrong| wrong.contains("law gap cannot be"))
    );
    let mut better = honest.clone();
    let own = better
        .metrics
        .iter_mut()
        .find_map(|metric| metric.controller.as_mut());
    let own = own.unwrap();
    own.greatest = own.q50;
    own.q95 = own.q50;
    let found = checked(&better.sealed().unwrap(), None, 64, 9);
    assert!(
        found.wrong.iter().any(|wrong| wrong.contains("metric")),
        "{:?}",
        found.wrong
    );
}
