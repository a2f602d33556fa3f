//! This file tests that every kind of fault occurs and changes what it says.

use super::*;
use crate::plant::Plant;
use rigproof_trace::Channel;
use std::collections::BTreeSet;

const NAMES: Names<'static> = Names {
    position: "position",
    effort: "command",
    roles: ["position", "effort"],
    others: None,
};

fn recording() -> Trace {
    let time_s: Vec<f64> = (0..4000).map(|k| f64::from(k) * 1e-3).collect();
    let wave = |time_s: f64| libm::sin(5.1 * time_s + 0.3);
    let channel = |name: &str, samples: Vec<f64>| Channel {
        name: name.to_owned(),
        unit: String::new(),
        samples,
    };
    let counted = |x: f64| (x / 1e-4).round() * 1e-4;
    Trace {
        channels: vec![
            channel(
                "position",
                time_s.iter().map(|t| counted(0.7 * wave(*t))).collect(),
            ),
            channel("command", time_s.iter().map(|t| 3.1 * wave(*t)).collect()),
        ],
        time_s,
    }
}

#[test]
fn every_fault_occurs_and_changes_the_recording_where_it_says() {
    let mut seen = BTreeSet::new();
    for seed in 0..300 {
        let mut trace = recording();
        let done = spoil(
            NAMES,
            &mut trace,
            &mut Draw::new(Plant::Axis, seed, "fault"),
        );
        let whole = recording();
        assert_ne!(trace, whole, "{}", done.fault);
        assert!(
            !done.channels.is_empty() && done.from_s <= done.to_s,
            "{done:?}"
        );
        let position = &trace.channel("position").unwrap().samples;
        let before = &whole.channel("position").unwrap().samples;
        let differ = |k: &usize| position[*k] != before[*k];
        let first = (0..4000).find(differ);
        if done.channels == ["position"] && done.fault != "dropped_samples" {
            let first_s = whole.time_s[first.unwrap()];
            assert!(
                (done.from_s - first_s).abs() < 0.02 + 0.5 * (done.to_s - done.from_s),
                "{done:?} {first_s}"
            );
        }
        let steps = trace.time_s.windows(2).map(|pair| pair[1] - pair[0]);
        let odd = steps.filter(|step| (step - 1e-3).abs() > 1e-2).count();
        match done.fault.as_str() {
            "dropped_samples" => {
                let empty = position.iter().filter(|x| x.is_nan()).count();
                assert!((600..2000).contains(&empty), "{empty}");
            }
            "clock_jump" | "clock_set_forward" => assert_eq!(odd, 1),
            "dropouts" => assert_eq!(position.iter().filter(|x| **x == 0.0).count(), 8),
            "repeated_samples" => {
                let pairs = trace.channel("command").unwrap().samples.windows(2);
                let same = pairs.filter(|pair| pair[0] == pair[1]).count();
                assert!((90..190).contains(&same), "{same}");
            }
            _ => assert_eq!(odd, 0),
        }
        seen.insert(done.fault);
    }
    assert_eq!(seen.len(), KINDS.len(), "{seen:?}");
}
