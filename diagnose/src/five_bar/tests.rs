//! This file claims that the diagnosis of the five-bar names what was left out, where it was left out, and nothing else.

use super::diagnose::diagnose;
use super::recorded::{DRAG, LeftOut, nothing, recording, rig};
use crate::report::{Report, Verdict};
use crate::{Diagnosis, Options};
use rigproof_spec::layout::Layout;

const SECONDS: f64 = 16.0;

fn diagnosed(layout: Layout, seed: u64, left_out: LeftOut) -> Diagnosis {
    let recording = recording(layout, SECONDS, seed, left_out);
    diagnose(&rig(layout), &recording, None, &Options::default())
}

fn named(report: &Report) -> Vec<(&'static str, Option<&'static str>)> {
    let effects = report.effects.iter();
    effects.map(|e| (e.mechanism, e.joint)).collect()
}

#[test]
fn a_recording_of_the_model_itself_is_consistent() {
    for (layout, seed) in [(Layout::FourBrake, 3), (Layout::ThreeBrake, 5)] {
        let report = diagnosed(layout, seed, &nothing).report;
        let floor = report.floor.as_ref().unwrap();
        assert_eq!(
            report.verdict,
            Verdict::Consistent,
            "{layout:?}: {:?}, {} times the floor, {:?}",
            named(&report),
            floor.ratio_after,
            report.protocol
        );
    }
}

#[test]
fn drag_at_one_joint_is_named_there_with_its_coefficient() {
    for (layout, seed, place, letter) in [
        (Layout::FourBrake, 7, 1, "E"),
        (Layout::FourBrake, 8, 3, "C"),
        (Layout::ThreeBrake, 9, 0, "A"),
    ] {
        let drag = |_: &_, rates: [f64; 4], _: f64| {
            let mut torques = [0.0; 4];
            torques[place] = -DRAG * rates[place];
            torques
        };
        let report = diagnosed(layout, seed, &drag).report;
        assert_eq!(
            named(&report),
            [("viscous", Some(letter))],
            "{layout:?}: {}",
            report.summary
        );
        let found = report.effects[0].parameters["coefficient"].value;
        assert!((found / DRAG - 1.0).abs() < 0.05, "{found} {DRAG}");
        assert!(report.fit.unwrap().improved);
    }
}
