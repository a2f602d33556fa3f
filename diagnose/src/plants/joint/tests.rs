//! This file claims that the diagnosis of an axis and of a bench names what was left out and
//! nothing else.

use super::align::align;
use super::recorded::{
    EFFORT_NOISE, Laws, NOMINAL, QUANTUM, exact_axis, exact_axis_with, exact_bench, signals, trace,
};
use super::run::JointRun;
use crate::report::Verdict;
use crate::{Diagnosis, Options, diagnose};
use rigproof_model::axis::Transmission;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::{Recording, Rig};
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
    let trace = trace(seen, &[]);
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

/// Diagnoses an axis and a bench with their nominal laws and these.
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
        let fit = diagnosis.report.fit.as_ref().unwrap();
        let held_out = fit.held_out.unwrap();
        assert!(
            fit.improved && held_out.after < 0.1 * held_out.before,
            "{held_out:?}"
        );
        // Where windows count it is the level to either side, and the old model lacks it with its sign.
        let curves = &diagnosis.curves;
        let [own] = curves.contributed.as_slice() else {
            panic!("{:?}", curves.contributed);
        };
        assert_eq!(own.name, "dry_offset");
        let windows = own.effort.iter().zip(&curves.residual_before);
        let counted = windows.zip(&curves.window_counts).filter(|(_, c)| **c);
        let counted: Vec<(&f64, &f64)> = counted.map(|(pair, _)| pair).collect();
        let apart = counted
            .iter()
            .map(|(effort, _)| (effort.abs() / level.value - 1.0).abs());
        let mut apart: Vec<f64> = apart.collect();
        apart.sort_by(f64::total_cmp);
        // A few windows of the axis hold a part of a reversal.
        let typical = apart[apart.len() * 9 / 10];
        assert!(typical < 0.03, "{typical}");
        let together: f64 = counted
            .iter()
            .map(|(effort, before)| *effort * *before)
            .sum();
        assert!(counted.len() > 100 && together > 0.0, "{together}");
    }
}

#[test]
fn a_friction_that_is_stated_too_large_is_the_friction_and_not_a_gain() {
    let stated = "[parameters]\ninertia = { value = 1.29, unit = \"kg\", status = \"unknown\" }\n\
         command_gain = { value = 1.0, unit = \"N/N\" }\n\
         [[effect]]\nmechanism = \"dry_offset\"\nlevel = { value = 2.6, unit = \"N\" }\n\
         [[effect]]\nmechanism = \"spring\"\nstiffness = { value = 41.7, unit = \"N/m\" }\n";
    let rig = rig("axis", &[stated, VISCOUS].concat());
    let exact = exact_axis(&[NOMINAL, &[DRY]].concat(), 15_300, true);
    let diagnosis = diagnose(&rig, &[&recording(&rig, &exact)], None, &Options::default());
    let report = &diagnosis.report;
    assert_eq!(named(&diagnosis), ["dry_offset"], "{}", report.summary);
    let more = report.effects[0].parameters["level"].value;
    assert!((more - (1.73 - 2.6)).abs() < 0.05, "{more} N");
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

/// The axis with its inertia known, so that the gain of its drive is identifiable.
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

/// Diagnoses a recording that continues as `after` from sample `from` on.
fn held_out_of(rig: &Rig, before: &JointRun, after: &JointRun, from: usize) -> Diagnosis<Rig> {
    let mut run = before.clone();
    for (own, other) in [
        (&mut run.position, &after.position),
        (&mut run.effort, &after.effort),
    ] {
        own[from..].copy_from_slice(&other[from..]);
    }
    diagnose(rig, &[&recording(rig, &run)], None, &Options::default())
}

#[test]
fn a_held_out_part_that_goes_another_way_is_said_with_when() {
    let axis = axis();
    let exact = exact_axis(NOMINAL, 15_300, true);
    // The held-out quarter begins at sample 11 475. A change at 13 000 therefore lies outside every
    // fitted window.
    let (from, time_s) = (13_000, 13_000.0 * 1.1e-3);
    let mut rezeroed = exact.clone();
    rezeroed.position.iter_mut().for_each(|x| *x -= 0.031);
    let mut cut_off = exact.clone();
    cut_off.effort.fill(0.0);
    let bench = rig("bench", VISCOUS);
    let metered = exact_bench(&[(Mechanism::Viscous, &[7.3])], 15_300);
    let mut amplified = metered.clone();
    amplified.effort.iter_mut().for_each(|f| *f *= 1.13);
    for (rig, before, after) in [
        (&axis, &exact, &rezeroed),
        (&axis, &exact, &cut_off),
        (&bench, &metered, &amplified),
    ] {
        let found = held_out_of(rig, before, after, from).report;
        if found.verdict == Verdict::DataFault {
            continue;
        }
        assert_eq!(found.verdict, Verdict::Consistent, "{}", found.summary);
        let agreement = found.fit.unwrap().agreement.unwrap();
        assert!(!agreement.agrees, "{agreement:?}");
        let departs_s = agreement.departs_s.unwrap();
        assert!(
            (time_s - 0.01..time_s + 0.5).contains(&departs_s),
            "{departs_s} {agreement:?} {}",
            found.summary
        );
        assert!(
            found.summary.contains("does not agree"),
            "{}",
            found.summary
        );
    }
    for report in both(&[])
        .map(|own| own.report)
        .iter()
        .chain(&both(&[DRY]).map(|own| own.report))
    {
        let agreement = report.fit.as_ref().unwrap().agreement.as_ref().unwrap();
        assert!(agreement.agrees, "{} {agreement:?}", report.plant);
    }
}

#[test]
fn the_numbers_that_are_written_predict_no_worse_than_those_of_the_windows() {
    let axis = axis();
    let exact = exact_axis(&[NOMINAL, &[DRY]].concat(), 15_300, true);
    // A push that no channel records, and lost counts: a free run crosses both.
    let mut pushed = exact.clone();
    for (k, x) in pushed.position.iter_mut().enumerate() {
        let since_s = (k as f64 - 5_000.0) * 1.1e-3;
        *x += if since_s > 0.0 {
            0.05 * since_s * libm::exp(-3.0 * since_s)
        } else {
            0.0
        };
    }
    let mut lost = exact.clone();
    lost.position
        .iter_mut()
        .skip(6_000)
        .for_each(|x| *x -= 0.0071);
    for run in [&exact, &pushed, &lost] {
        let found = diagnose(&axis, &[&recording(&axis, run)], None, &Options::default());
        let Some(fit) = found.report.fit else {
            assert_eq!(found.report.verdict, Verdict::DataFault);
            continue;
        };
        let (held_out, windows) = (fit.held_out.unwrap(), fit.held_out_without_refit.unwrap());
        assert!(held_out.after <= windows, "{} {windows}", held_out.after);
        let written = &found.calibration.provenance["fit"];
        assert_eq!(
            held_out.after < windows,
            written.starts_with("output-error"),
            "{written}"
        );
    }
}

/// The effort of a servo is computed from the position: it stands and moves with it, also where both
/// only dwell on counts.
#[test]
fn a_servo_s_effort_is_no_witness_of_repeated_samples() {
    let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 4000);
    let mut seen = signals(&run, 71);
    let coarse = 300.0 * QUANTUM;
    seen.position_quantum = Some(coarse);
    for x in &mut seen.position {
        *x = coarse * (*x / coarse).round();
    }
    seen.effort = seen.position.iter().map(|x| 3.0 * (0.1 - x)).collect();
    let said = align(&seen).unwrap_err().reason;
    assert!(said.contains("repeat the one before"), "{said}");
    seen.goal = Some(vec![0.1; seen.position.len()]);
    let run = align(&seen).unwrap();
    assert!(run.remarks.is_empty(), "{:?}", run.remarks);
}

#[test]
fn cogging_with_two_periods_is_a_ripple_with_each_of_them() {
    let cogs: Laws = &[
        (Mechanism::Ripple, &[0.91, -0.67, 0.11]),
        (Mechanism::Ripple, &[0.37, 0.52, 0.043]),
    ];
    for diagnosis in both(cogs) {
        assert_eq!(named(&diagnosis), ["ripple", "ripple"]);
        let effects = diagnosis.report.effects.iter();
        let mut periods: Vec<f64> = effects.map(|own| own.parameters["period"].value).collect();
        periods.sort_by(f64::total_cmp);
        for (found, hidden) in periods.iter().zip([0.043, 0.11]) {
            assert!((found / hidden - 1.0).abs() < 2e-3, "{periods:?}");
        }
        assert_eq!(diagnosis.report.verdict, Verdict::Explained);
    }
}

#[test]
fn four_causes_are_named_together() {
    let four: Laws = &[
        DRY,
        (Mechanism::ConstantBias, &[0.63]),
        (Mechanism::Ripple, &[0.91, -0.67, 0.11]),
        (Mechanism::NonlinearSpring, &[17.0]),
    ];
    let laws = [&[(Mechanism::Viscous, &[7.3][..])][..], four].concat();
    let bench = rig("bench", VISCOUS);
    let recording = recording(&bench, &exact_bench(&laws, 7_650));
    let options = Options {
        refit: false,
        next_experiment: false,
        ..Options::default()
    };
    let diagnosis = diagnose(&bench, &[&recording], None, &options);
    let mut names = named(&diagnosis);
    names.sort_unstable();
    let hidden = ["constant_bias", "dry_offset", "nonlinear_spring", "ripple"];
    assert_eq!(names, hidden);
    assert_eq!(diagnosis.report.verdict, Verdict::Explained);
}

#[test]
fn friction_by_the_square_of_the_load_is_named_with_its_exponent() {
    let mut transmission = Transmission::default();
    transmission.add_friction(&[0.021, 2.0]);
    let rig = axis();
    let exact = exact_axis_with(NOMINAL, transmission, 15_300, true);
    let found = diagnose(&rig, &[&recording(&rig, &exact)], None, &Options::default());
    assert_eq!(named(&found), ["load_friction"], "{}", found.report.summary);
    let numbers = &found.report.effects[0].parameters;
    for (name, hidden) in [("share", 0.021), ("exponent", 2.0)] {
        let value = numbers[name].value;
        assert!((value / hidden - 1.0).abs() < 0.02, "{name} {value}");
    }
}

/// An axis that a bristle holds moves little of what its inertia alone would: that is no wrong
/// channel.
#[test]
fn a_nominal_model_that_explains_nothing_is_no_fault_where_a_cause_explains_it() {
    let free = rig(
        "axis",
        "[parameters]\ninertia = { value = 1.37, unit = \"kg\", status = \"known\" }\n\
         command_gain = { value = 1.0, unit = \"N/N\" }\n",
    );
    let bristle: Laws = &[(Mechanism::Presliding, &[12.3, 0.31])];
    let exact = exact_axis(bristle, 15_300, true);
    let found = diagnose(
        &free,
        &[&recording(&free, &exact)],
        None,
        &Options::default(),
    );
    let left = found.report.floor.as_ref().unwrap().measured_before;
    let effort = exact.effort.iter().map(|e| e * e).sum::<f64>() / exact.effort.len() as f64;
    assert!(left > effort.sqrt(), "{left} of {effort}");
    assert_eq!(named(&found), ["presliding"], "{}", found.report.summary);
}

#[test]
fn what_is_too_small_to_be_named_is_said_to_be_most_like_it() {
    // Less than 0.3 % of the effort counts as something that no model is exact to.
    for diagnosis in both(&[(Mechanism::DryOffset, &[0.025])]) {
        let report = &diagnosis.report;
        assert_eq!(report.verdict, Verdict::NoneOfLibrary, "{}", report.summary);
        let said = report.likest().unwrap();
        assert!(said.contains("(dry_offset)"), "{said}");
    }
    let [named, ..] = both(&[DRY]);
    assert_eq!(named.report.likest(), None);
}

/// What shakes an axis in time is not in the library. Under it the inertia is not determined, and the
/// stated one is as likely as any.
#[test]
fn an_inertia_that_is_not_determined_is_taken_as_stated() {
    let rig = axis();
    let mut exact = exact_axis(NOMINAL, 15_300, true);
    for (k, effort) in exact.effort.iter_mut().enumerate() {
        let time_s = k as f64 * exact.step_s;
        *effort += 31.0 * libm::sin(3.3 * time_s + 2.0 * libm::sin(0.7 * time_s));
    }
    let found = diagnose(&rig, &[&recording(&rig, &exact)], None, &Options::default());
    let report = &found.report;
    assert_eq!(report.verdict, Verdict::NoneOfLibrary, "{}", report.summary);
    let mut said = report.remarks.iter().map(|own| own.what);
    assert!(said.any(|own| own == "inertia_as_stated"));
}
