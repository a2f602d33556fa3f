//! This file says that friction in proportion to a brake's torque, and a limit of it, are named as that on a bench, and that the calibration which says so is obeyed.

use rigproof_blind::{Forms, Plant, make_in};
use rigproof_diagnose::{Description, Diagnosis, Options};
use rigproof_trace::Trace;
use std::path::Path;

fn diagnosed(rig: &Description, trace: &Trace) -> Diagnosis {
    let options = Options {
        refit: false,
        hold_out_share: 0.0,
        next_experiment: false,
        ..Options::default()
    };
    let recording = rig.apply(trace, Path::new("recording.csv")).unwrap();
    rig.diagnose(&[recording], None, &options).unwrap()
}

#[test]
fn a_share_of_the_brakes_torque_is_named_written_and_obeyed() {
    // Extra friction at low speed, and one more in one direction than in the other from 14.9 s on; each a share of the torque.
    for (seed, mechanism) in [(2459, "stribeck"), (2413, "direction_asymmetry")] {
        let case = make_in(Forms::Other, Plant::Bench, seed, None).unwrap();
        let rig = Description::parse(&case.rig_toml, Path::new("rig.toml")).unwrap();
        let first = diagnosed(&rig, &case.trace);
        let [effect] = &first.report.effects[..] else {
            panic!("{seed}: {}", first.report.summary);
        };
        assert_eq!(effect.mechanism, mechanism);
        let toml = first.calibration.to_toml();
        assert!(toml.contains("of = \"torque\""), "{toml}");
        let again = Description::parse(&toml, Path::new("calibration.toml")).unwrap();
        let again = diagnosed(&again, &case.trace).report;
        assert!(again.effects.is_empty(), "{seed}: {}", again.summary);
    }
}

/// The current steps from trial to trial, and a gain for each of them leaves a little less than the limit does.
#[test]
fn a_limit_of_a_brake_is_not_put_aside_for_a_gain_for_every_trial() {
    let case = make_in(Forms::Other, Plant::Bench, 2613, None).unwrap();
    let rig = Description::parse(&case.rig_toml, Path::new("rig.toml")).unwrap();
    let report = diagnosed(&rig, &case.trace).report;
    let names: Vec<&str> = report.effects.iter().map(|own| own.mechanism).collect();
    assert_eq!(names, ["saturation"], "{}", report.summary);
}
