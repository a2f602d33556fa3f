//! This file claims that the experiment a diagnosis asks for tells its explanations apart, and that a rig can do it.

use super::super::diagnose::diagnose;
use super::super::free_run::Model;
use super::super::recorded::rig;
use super::plan::{Plan, STRONGEST_A, plans};
use super::play::{Sensors, play};
use crate::report::{Report, Verdict};
use crate::{Diagnosis, Options};
use core::f64::consts::TAU;
use rigproof_model::linkage::{inverse, limits};
use rigproof_model::rig::JointEffect;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::geometry::{angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_trace::rig::five_bar::FiveBarRecording;

const STEP_S: f64 = 1e-3;
const COUNT_RAD: f64 = TAU / 100_000.0;
const FORCE_NOISE_N: f64 = 0.037;

fn model(mechanism: Mechanism, joint: Option<Joint>, parameters: &[f64]) -> Model {
    let effect = JointEffect {
        mechanism,
        joint,
        parameters: parameters.to_vec(),
        onset_s: None,
    };
    Model {
        rig: vec![effect],
        sensors: Vec::new(),
    }
}

/// What the rig's sensors make of an experiment on it.
fn recorded(truth: &Model, layout: Layout, plan: &Plan, seed: u64) -> FiveBarRecording {
    let sensors = Sensors {
        count_rad: Some(COUNT_RAD),
        force_noise_n: Some(FORCE_NOISE_N),
    };
    let played = play(truth, layout, plan).unwrap();
    played.sensed(&rig(layout), seed).recording(layout, sensors)
}

/// A winding path of 8 s with currents that never change.
fn unchanging(layout: Layout, currents_a: [f64; 4]) -> Plan {
    let mut plan = plans(layout, &[], STEP_S).swap_remove(0);
    plan.hand_m.truncate(8000);
    plan.currents_a = currents_a.map(|current| vec![current; 8000]);
    plan
}

fn diagnosed(layout: Layout, recording: &FiveBarRecording) -> Diagnosis {
    let options = Options {
        refit: false,
        ..Options::default()
    };
    diagnose(&rig(layout), recording, None, &options)
}

fn named(report: &Report) -> Vec<String> {
    let effects = report.effects.iter();
    effects
        .map(|e| format!("{} at {}", e.mechanism, e.joint.unwrap_or("all")))
        .collect()
}

#[test]
fn the_experiment_that_is_asked_for_ends_the_ambiguity() {
    let a = Some(Joint::A);
    for (layout, mechanism, size, seed) in [
        (Layout::FourBrake, Mechanism::GainError, 0.113, 21),
        (Layout::ThreeBrake, Mechanism::DryOffset, 0.071, 22),
    ] {
        let truth = model(mechanism, a, &[size]);
        // Brake A has no backlash: at one current a wrong gain is dry friction.
        let poor = unchanging(layout, [0.47, 0.0, 0.0, 0.0]);
        let first = diagnosed(layout, &recorded(&truth, layout, &poor, seed));
        let report = &first.report;
        assert_eq!(report.verdict, Verdict::Ambiguous, "{}", report.summary);
        let next = report.next_experiment.as_ref().unwrap();
        eprintln!("{:?} {:?} {next:?}", named(report), report.ambiguous_with);
        let plan = Plan::of(first.experiment.as_ref().unwrap(), layout).unwrap();
        let second = diagnosed(layout, &recorded(&truth, layout, &plan, seed + 50));
        let report = &second.report;
        let name = format!("{} at A", mechanism.name());
        assert_eq!(named(report), [name], "{}", report.summary);
        assert_eq!(
            report.verdict,
            Verdict::Explained,
            "{:?}",
            report.ambiguous_with
        );
        assert!(report.next_experiment.is_none());
        let found = report.effects[0].parameters.values().next().unwrap().value;
        assert!((found / size - 1.0).abs() < 0.05, "{found} {size}");
    }
}

#[test]
fn no_experiment_tells_friction_at_c_from_friction_at_e_on_the_parallelogram() {
    let layout = Layout::ThreeBrake;
    let truth = model(Mechanism::DryOffset, Some(Joint::E), &[0.083]);
    let path = unchanging(layout, [0.0; 4]);
    let report = diagnosed(layout, &recorded(&truth, layout, &path, 31)).report;
    let next = report.next_experiment.unwrap();
    let twins = ["dry_offset at E", "bearing_friction at C"];
    let pair = next
        .separations
        .iter()
        .find(|pair| twins.contains(&pair.one.as_str()) && twins.contains(&pair.other.as_str()));
    assert!(!pair.unwrap().tellable, "{:?}", next.separations);
}

#[test]
fn every_experiment_stays_inside_joint_limits_currents_and_force() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let arms = arms(layout);
        let plans = plans(layout, &[Joint::A, Joint::C], STEP_S);
        assert!(plans.len() > 15);
        for plan in &plans {
            for tip in plan.hand_m.iter().step_by(7) {
                let pose = inverse::pose(&arms, *tip).unwrap();
                limits::check(&angle_ranges(layout), &pose).unwrap();
            }
            let currents = plan.currents_a.iter().flatten();
            assert!(currents.clone().all(|a| (0.0..=STRONGEST_A).contains(a)));
            let read = Plan::of(&plan.trace(layout), layout).unwrap();
            assert_eq!(read.hand_m, plan.hand_m);
            assert_eq!(read.currents_a, plan.currents_a);
        }
        // Brakes at their strongest hold the tip, and the hand does not push harder.
        let mut held = plans[0].clone();
        held.hand_m.truncate(900);
        held.currents_a = [0, 1, 2, 3].map(|place| {
            let braked = layout.brakes().contains(&Joint::ALL[place]);
            vec![if braked { 1.0 } else { 0.0 }; 900]
        });
        let [x, y] = play(&Model::of(&rig(layout)), layout, &held)
            .unwrap()
            .force_n;
        let greatest_n = x
            .iter()
            .zip(&y)
            .map(|(x, y)| x.hypot(*y))
            .fold(0.0, f64::max);
        let limit_n = greatest_desired_force_n(layout);
        assert!(
            greatest_n > 0.5 * limit_n && greatest_n < 1.0001 * limit_n,
            "{greatest_n} N"
        );
    }
}
