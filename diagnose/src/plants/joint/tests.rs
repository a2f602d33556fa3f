//! This file claims that the diagnosis of an axis and of a bench names what was left out and nothing else.

use super::recorded::{EFFORT_NOISE, Laws, NOMINAL, QUANTUM, exact_axis, exact_bench, signals};
use super::run::JointRun;
use crate::report::Verdict;
use crate::{Diagnosis, Options, diagnose};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::{Recording, Rig};
use rigproof_trace::{Channel, Trace};
use std::path::Path;

fn rig(plant: &str, rest: &str) -> Rig {
    let effort = if plant == "axis" { "command" } else { "force" };
    let text = format!(
        "name = \"slide\"\nplant = \"{plant}\"\nmotion = \"linear\"\n[channels]\n\
         position = {{ channel = \"x\", unit = \"m\", quantum = {QUANTUM:e} }}\n\
         {effort} = {{ channel = \"f\", unit = \"N\", noise = {EFFORT_NOISE} }}\n{rest}[protocol]\ndrive = \"held\"\n"
    );
    Rig::parse(&text, Path::new("rig.toml")).unwrap()
}

const VISCOUS: &str = "[[effect]]\nmechanism = \"viscous\"\n\
    coefficient = { value = 6.1, unit = \"N·s/m\", status = \"unknown\" }\n";

fn axis() -> Rig {
    let rest = format!(
        "[parameters]\ninertia = {{ value = 1.29, unit = \"kg\", status = \"unknown\" }}\n\
         command_gain = {{ value = 1.0, unit = \"N/N\" }}\n{VISCOUS}\
         [[effect]]\nmechanism = \"spring\"\n\
         stiffness = {{ value = 39.0, unit = \"N/m\", status = \"unknown\" }}\n"
    );
    rig("axis", &rest)
}

fn recording(rig: &Rig, exact: &JointRun) -> Recording {
    let seen = signals(exact, 71);
    let channel = |name: &str, unit: &str, samples| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples,
    };
    let trace = Trace {
        time_s: seen.time_s,
        channels: vec![
            channel("x", "m", seen.position),
            channel("f", "N", seen.effort),
        ],
    };
    rig.apply(&trace, Path::new("test")).unwrap()
}

fn named(diagnosis: &Diagnosis<Rig>) -> Vec<&str> {
    diagnosis
        .report
        .effects
        .iter()
        .map(|e| e.mechanism)
        .collect()
}

const DRY: (Mechanism, &[f64]) = (Mechanism::DryOffset, &[1.73]);

/// An axis and a bench with their nominal laws and these.
fn both(left_out: Laws) -> [Diagnosis<Rig>; 2] {
    let laws = [NOMINAL, left_out].concat();
    let rig_a = axis();
    let exact = exact_axis(&laws, 15_300, true);
    let a = diagnose(
        &rig_a,
        &[&recording(&rig_a, &exact)],
        None,
        &Options::default(),
    );
    let laws = [&[(Mechanism::Viscous, &[7.3][..])][..], left_out].concat();
    let rig_b = rig("bench", VISCOUS);
    let exact = exact_bench(&laws, 15_300);
    let b = diagnose(
        &rig_b,
        &[&recording(&rig_b, &exact)],
        None,
        &Options::default(),
    );
    [a, b]
}

#[test]
fn with_nothing_left_out_the_answer_is_consistent() {
    for diagnosis in both(&[]) {
        let report = &diagnosis.report;
        assert_eq!(
            report.verdict,
            Verdict::Consistent,
            "{} {:?}",
            report.plant,
            report.floor
        );
        assert!(named(&diagnosis).is_empty());
    }
}

#[test]
fn dry_friction_left_out_is_named_measured_and_shown() {
    for diagnosis in both(&[DRY]) {
        assert_eq!(
            named(&diagnosis),
            ["dry_offset"],
            "{}",
            diagnosis.report.summary
        );
        // A bristle much shorter than the travel is dry friction: the only rival there may be.
        let rivals = &diagnosis.report.ambiguous_with[0];
        assert!(rivals.iter().all(|r| *r == "presliding"), "{rivals:?}");
        let level = &diagnosis.report.effects[0].parameters["level"];
        assert!((level.value / 1.73 - 1.0).abs() < 0.02, "{} N", level.value);
        let fit = diagnosis.report.fit.unwrap();
        let held_out = fit.held_out.unwrap();
        assert!(
            fit.improved && held_out.after < 0.1 * held_out.before,
            "{held_out:?}"
        );
    }
}

#[test]
fn a_rest_is_not_excited_and_a_reversed_drive_is_a_fault() {
    let rig = axis();
    let mut still = exact_axis(NOMINAL, 5100, true);
    still.position.fill(0.0137);
    let answer = diagnose(&rig, &[&recording(&rig, &still)], None, &Options::default());
    assert_eq!(answer.report.verdict, Verdict::NotExcited);
    let rig = rig_with_gain_known();
    let mut reversed = exact_axis(NOMINAL, 15_300, true);
    reversed.effort.iter_mut().for_each(|x| *x = -*x);
    let answer = diagnose(
        &rig,
        &[&recording(&rig, &reversed)],
        None,
        &Options::default(),
    );
    assert_eq!(
        answer.report.verdict,
        Verdict::DataFault,
        "{}",
        answer.report.summary
    );
    assert!(answer.report.summary.contains("wrong sign"));
}

/// The axis with its inertia known: then the drive's gain can be measured.
fn rig_with_gain_known() -> Rig {
    let rest = format!(
        "[parameters]\ninertia = {{ value = 1.37, unit = \"kg\" }}\n\
         command_gain = {{ value = 1.0, unit = \"N/N\" }}\n{VISCOUS}\
         [[effect]]\nmechanism = \"spring\"\n\
         stiffness = {{ value = 39.0, unit = \"N/m\", status = \"unknown\" }}\n"
    );
    rig("axis", &rest)
}

#[test]
fn recordings_of_an_axis_are_diagnosed_together() {
    let rig = axis();
    let laws = [NOMINAL, &[DRY]].concat();
    let exact = exact_axis(&laws, 15_300, true);
    let halves = [exact.part(0, 7_600), exact.part(7_600, 15_300)];
    let [one, other] = halves.map(|half| recording(&rig, &half));
    let found = diagnose(&rig, &[&one, &other], None, &Options::default());
    assert_eq!(named(&found), ["dry_offset"], "{}", found.report.summary);
    assert!(found.report.protocol[0].starts_with("2 recordings one after another"));
    let level = found.report.effects[0].parameters["level"].value;
    assert!((level / 1.73 - 1.0).abs() < 0.02, "{level} N");
    let held_out = found.report.fit.unwrap().held_out.unwrap();
    assert!(held_out.after < 0.1 * held_out.before, "{held_out:?}");
}
