//! This file claims what a user of the room relies on: seeds, seals and rig descriptions.

use proptest::prelude::*;
use rigproof_blind::{
    Forms, Outcome, Plant, Stratum, Table, Tally, judge, make, make_in, open, score,
};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::Rig;
use rigproof_trace::rig::five_bar::FiveBar;
use std::path::Path;

fn plant() -> impl Strategy<Value = Plant> {
    prop_oneof![Just(Plant::Axis), Just(Plant::Bench)]
}

/// Bits, so that an empty cell equals an empty cell.
fn bits(trace: &rigproof_trace::Trace) -> Vec<(String, String, Vec<u64>)> {
    let bits = |samples: &[f64]| samples.iter().map(|x| x.to_bits()).collect();
    let mut all = vec![("t".to_owned(), "s".to_owned(), bits(&trace.time_s))];
    all.extend(
        trace
            .channels
            .iter()
            .map(|c| (c.name.clone(), c.unit.clone(), bits(&c.samples))),
    );
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn a_seed_makes_the_same_case_twice_and_another_seed_another(plant in plant(), seed: u64) {
        let first = make(plant, seed, None).unwrap();
        let second = make(plant, seed, None).unwrap();
        prop_assert_eq!(bits(&first.trace), bits(&second.trace));
        prop_assert_eq!(&first.rig_toml, &second.rig_toml);
        prop_assert_eq!(&first.sealed, &second.sealed);
        let other = make(plant, seed ^ 0x55, None).unwrap();
        prop_assert_ne!(bits(&first.trace), bits(&other.trace));
    }

    #[test]
    fn the_seal_hides_and_keeps_the_answer(plant in plant(), seed: u64) {
        let case = make(plant, seed, None).unwrap();
        let answer = open(&case.sealed).unwrap();
        prop_assert_eq!(answer.seed, seed);
        prop_assert_eq!(answer.stratum, Stratum::of_seed(plant, seed));
        prop_assert!(case.sealed.contains(&case.commitment));
        for mechanism in Mechanism::ALL {
            prop_assert!(!case.sealed.contains(mechanism.name()));
        }
        // Nothing hidden is nominal physics.
        for effect in &answer.effects {
            let line = format!("mechanism = \"{}\"", effect.mechanism);
            prop_assert!(!case.rig_toml.contains(&line), "{}", line);
        }
    }

    #[test]
    fn the_rig_description_reads_and_fits_the_recording(plant in plant(), seed: u64) {
        let case = make(plant, seed, Some(Stratum::Single)).unwrap();
        let origin = Path::new("case.toml");
        let rig = Rig::parse(&case.rig_toml, origin).unwrap();
        prop_assert_eq!(&rig.name, &format!("blind {} {seed}", plant.name()));
        let recording = rig.apply(&case.trace, origin).unwrap();
        prop_assert_eq!(recording.time_s.len(), case.trace.len());
    }
}

#[test]
fn every_seed_of_two_blocks_makes_a_case() {
    let mut table = Table::default();
    for plant in [Plant::Axis, Plant::Bench] {
        for seed in 0..40 {
            let case = make(plant, seed, None).unwrap();
            let answer = open(&case.sealed).unwrap();
            assert_eq!(answer.fault.is_some(), answer.stratum == Stratum::DataFault);
            let hidden = match answer.stratum {
                Stratum::Nothing | Stratum::DataFault => 0,
                Stratum::Masked => 2,
                _ => 1,
            };
            assert_eq!(answer.effects.len(), hidden);
            let seconds = *case.trace.time_s.last().unwrap();
            for effect in &answer.effects {
                assert_eq!(
                    effect.onset_s.is_some(),
                    answer.stratum == Stratum::LateOnset
                );
                if let Some(onset_s) = effect.onset_s {
                    assert!(onset_s > 0.32 * seconds && onset_s < 0.68 * seconds);
                }
            }
            // A diagnosis that says nothing scores on the cases that hide nothing.
            let silent = serde_json::json!({"verdict": "consistent", "effects": []});
            table.add(plant, seed, score(&answer, &silent).unwrap());
        }
    }
    for row in table.rows() {
        let right = matches!(row.stratum, "nothing" | "too_small");
        match row.stratum {
            "all" => assert_eq!((row.n, row.exact.count), (80, 20)),
            _ => assert_eq!(row.exact.count, if right { row.n } else { 0 }, "{row:?}"),
        }
    }
}

/// One block of seeds: every stratum of the five-bar, each case made twice.
#[test]
fn a_block_of_five_bar_seeds_holds_every_stratum_and_repeats() {
    let origin = Path::new("case.toml");
    let mut strata = std::collections::BTreeSet::new();
    let mut rows = Table::default();
    for seed in 20..40 {
        let case = make(Plant::Rig, seed, None).unwrap();
        let answer = open(&case.sealed).unwrap();
        strata.insert(answer.stratum);
        assert_eq!(answer.stratum, Stratum::of_seed(Plant::Rig, seed));
        assert_eq!(answer.fault.is_some(), answer.stratum == Stratum::DataFault);
        for effect in &answer.effects {
            assert!(!case.sealed.contains(&effect.mechanism));
            let late = answer.stratum == Stratum::LateOnset;
            assert_eq!(effect.onset_s.is_some(), late);
        }
        assert!(FiveBar::describes(&case.rig_toml, origin).unwrap());
        let rig = FiveBar::parse(&case.rig_toml, origin).unwrap();
        assert_eq!(rig.to_toml(), case.rig_toml);
        let recording = rig.apply(&case.trace, origin).unwrap();
        assert!(
            recording
                .theta
                .iter()
                .all(|theta| theta.quantum.unwrap() < 7e-5)
        );
        let currents = recording.currents.iter().flatten().count();
        assert_eq!(currents, rig.layout.brakes().len());
        if seed % 5 == 0 {
            let again = make(Plant::Rig, seed, None).unwrap();
            assert_eq!(bits(&again.trace), bits(&case.trace));
            assert_eq!(again.sealed, case.sealed);
        }
        // A diagnosis that says nothing is right where nothing can be said.
        let silent = serde_json::json!({"verdict": "consistent", "effects": []});
        let score = score(&answer, &silent).unwrap();
        let right = matches!(answer.stratum, Stratum::Nothing | Stratum::TooSmall);
        assert_eq!((score.exact, score.is_miss()), (right, !right));
        rows.add(Plant::Rig, seed, score);
    }
    let drawn = Stratum::ALL
        .into_iter()
        .filter(|stratum| stratum.of_twenty(Plant::Rig) > 0);
    assert_eq!(strata.len(), drawn.count());
    assert!(rows.protocol().contains("rig: 20 cases, seeds 20 to 39"));
}

#[test]
fn strata_of_the_five_bar_are_refused_elsewhere() {
    let refusal = make(Plant::Axis, 3, Some(Stratum::InLoop)).unwrap_err();
    assert!(refusal.to_string().contains("\"in_loop\""), "{refusal}");
}

/// In other forms a seed makes the same case twice, its description reads, a silent report is right where nothing is hidden and a report with the right
/// names is right wherever there is a name.
#[test]
fn cases_in_other_forms_repeat_read_and_are_judged() {
    let origin = Path::new("case.toml");
    let mut tally = Tally::default();
    for (plant, seeds) in [
        (Plant::Axis, 0..20),
        (Plant::Bench, 0..20),
        (Plant::Rig, 0..4),
    ] {
        for seed in seeds {
            let case = make_in(Forms::Other, plant, seed, None).unwrap();
            let answer = open(&case.sealed).unwrap();
            assert_eq!(
                answer.stratum,
                Stratum::of_seed_in(Forms::Other, plant, seed)
            );
            match plant {
                Plant::Rig => assert!(FiveBar::parse(&case.rig_toml, origin).is_ok()),
                _ => assert!(
                    Rig::parse(&case.rig_toml, origin)
                        .unwrap()
                        .apply(&case.trace, origin)
                        .is_ok()
                ),
            }
            if seed % 10 == 3 {
                let again = make_in(Forms::Other, plant, seed, None).unwrap();
                assert_eq!(bits(&again.trace), bits(&case.trace));
                assert_eq!((again.sealed, again.rig_toml), (case.sealed, case.rig_toml));
            }
            let silent = serde_json::json!({"verdict": "consistent", "effects": []});
            let silent = judge(&answer, &silent).unwrap().outcome;
            assert!(matches!(
                silent,
                Outcome::Right | Outcome::Silent | Outcome::Unseen
            ));
            assert_eq!(silent == Outcome::Right, answer.effects.is_empty());
            let named = answer.effects.iter().filter_map(|effect| {
                let right = effect.right.first()?;
                Some(serde_json::json!({"mechanism": right, "joint": effect.joint, "probability": 0.9}))
            });
            let named: Vec<_> = named.collect();
            let verdict = if named.is_empty() {
                "none_of_library"
            } else {
                "explained"
            };
            let told = judge(
                &answer,
                &serde_json::json!({"verdict": verdict, "effects": named}),
            )
            .unwrap();
            assert_eq!(told.outcome, Outcome::Right, "{told:?}");
            tally.add(plant, seed, told);
        }
    }
    assert!(tally.to_string().contains("bench: 20 cases, seeds 0 to 19"));
    assert_eq!(tally.calibration().len(), 1);
}
