//! This file says that friction in proportion to a brake's torque is named as that on a bench, and that the calibration which says so is obeyed.

use rigproof_blind::{Forms, Plant, make_in};
use rigproof_diagnose::{Description, Options};
use std::path::Path;

#[test]
fn a_share_of_the_brakes_torque_is_named_written_and_obeyed() {
    // Extra friction at low speed, and one more in one direction than in the other from 14.9 s on; each a share of the torque.
    for (seed, mechanism) in [(2459, "stribeck"), (2413, "direction_asymmetry")] {
        let case = make_in(Forms::Other, Plant::Bench, seed, None).unwrap();
        let rig = Description::parse(&case.rig_toml, Path::new("rig.toml")).unwrap();
        let options = Options {
            refit: false,
            hold_out_share: 0.0,
            next_experiment: false,
            ..Options::default()
        };
        let diagnosed = |rig: &Description| {
            let recording = rig.apply(&case.trace, Path::new("recording.csv")).unwrap();
            rig.diagnose(&[recording], None, &options).unwrap()
        };
        let first = diagnosed(&rig);
        let [effect] = &first.report.effects[..] else {
            panic!("{seed}: {}", first.report.summary);
        };
        assert_eq!(effect.mechanism, mechanism);
        let toml = first.calibration.to_toml();
        assert!(toml.contains("of = \"torque\""), "{toml}");
        let again = Description::parse(&toml, Path::new("calibration.toml")).unwrap();
        let again = diagnosed(&again).report;
        assert!(again.effects.is_empty(), "{seed}: {}", again.summary);
    }
}
