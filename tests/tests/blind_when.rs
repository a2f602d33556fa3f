//! This file says that what changes while a recording goes on is named with its beginning: a law whose size is unknown anyway, and one that a constant speed hardly tells from another; and that a bench's force may be late.

use rigproof_blind::{Forms, Plant, make_in};
use rigproof_diagnose::report::{EffectReport, Report};
use rigproof_diagnose::{Description, Options};
use std::path::Path;

fn diagnosed(plant: Plant, seed: u64) -> Report {
    let case = make_in(Forms::Other, plant, seed, None).unwrap();
    let rig = Description::parse(&case.rig_toml, Path::new("rig.toml")).unwrap();
    let recording = rig.apply(&case.trace, Path::new("recording.csv")).unwrap();
    let options = Options {
        next_experiment: false,
        ..Options::default()
    };
    rig.diagnose(&[recording], None, &options).unwrap().report
}

fn only(report: &Report) -> &EffectReport {
    match &report.effects[..] {
        [own] => own,
        _ => panic!("{}", report.summary),
    }
}

/// Dry friction of unknown size grows by 0.0935 N·m at 6.22 s.
#[test]
fn a_law_of_unknown_size_that_changes_is_named_from_then_on() {
    let report = diagnosed(Plant::Axis, 2588);
    let effect = only(&report);
    assert_eq!(effect.mechanism, "dry_offset", "{}", report.summary);
    let onset_s = effect.onset_s.unwrap();
    assert!((onset_s - 6.22).abs() < 0.05, "{onset_s} s");
    let level = effect.parameters["level"].value;
    assert!((level / 0.09346 - 1.0).abs() < 0.01, "{level} N·m");
    let held_out = report.fit.unwrap().held_out.unwrap();
    assert!(held_out.after < 0.1 * held_out.before, "{held_out:?}");
}

/// Viscous friction begins at 12.34 s, at a speed that hardly changes: a little beside its onset, dry friction explains more.
#[test]
fn laws_that_begin_late_are_compared_each_from_its_own_onset_on() {
    let report = diagnosed(Plant::Axis, 2670);
    let effect = only(&report);
    assert_eq!(effect.mechanism, "viscous", "{}", report.summary);
    let coefficient = effect.parameters["coefficient"].value;
    assert!((coefficient / 0.009557 - 1.0).abs() < 0.01, "{coefficient}");
    let held_out = report.fit.unwrap().held_out.unwrap();
    assert!(held_out.after < 0.01 * held_out.before, "{held_out:?}");
}

/// No drive and no brake: the force of a bench is recorded 8.1 ms late.
#[test]
fn a_force_that_is_late_is_no_bristle() {
    let report = diagnosed(Plant::Bench, 2669);
    let effect = only(&report);
    assert_eq!(effect.mechanism, "channel_skew", "{}", report.summary);
    let delay_s = effect.parameters["delay"].value;
    assert!((delay_s - 0.00813).abs() < 0.0005, "{delay_s} s");
}
