//! Whether the diagnosis, told the reference model, finds nothing in what the optimised implementation does in every golden case, and names
//! what is changed in it.
//!
//! The runs of a case of the five-bar are diagnosed together, as recordings of one rig; of the brakes' cases a run each. `RIGPROOF_CASES=all` diagnoses every run by itself, the
//! reference's too; `RIGPROOF_CASES=path_four_brake-7` those whose name holds the word. With `RIGPROOF_KEEP=folder` the recordings and their rig descriptions stay there, so that
//! `rigproof diagnose` can be asked again.

mod bench;
mod chapter_3;
mod damper;
mod five_bar;
mod laws;
mod recording;
mod script;
mod sweep;

use rayon::prelude::*;
use rigproof_diagnose::report::{Number, Report, Verdict};

use chapter_3::Planted;
use damper::Hidden;
use recording::{Recording, diagnosed_together};
use rigproof_spec::joint::Joint;

/// What is asked for: every run, or those whose name holds a word.
fn asked() -> Option<String> {
    std::env::var("RIGPROOF_CASES").ok()
}

/// The reports on those that are asked for.
fn diagnosed(mut recordings: Vec<Recording>) -> Vec<(Recording, Report)> {
    let word = asked().filter(|word| word != "all").unwrap_or_default();
    recordings.retain(|recording| recording.name.contains(&word));
    let pairs = recordings.into_par_iter().map(|recording| {
        let report = recording.diagnosed();
        (recording, report)
    });
    pairs.collect()
}

/// Runs about which by themselves nothing can be told: too few windows are left. A controller without a gap, or with a high gain, lets joints stop
/// and go within every window; a release of the 3-brake layout is over within 0.6 s; at 0.5 rpm a brake is inside its backlash for 0.3 s and then
/// rises for as long, with a time constant that the speed's noise moves.
const TOO_SHORT: [&str; 12] = [
    "path_three_brake-2-",
    "path_three_brake-5-",
    "path_four_brake-2-",
    "path_four_brake-5-",
    "release_three_brake-1-",
    "release_three_brake-3-",
    "brake_step_a-7-",
    "brake_step_a-10-",
    "brake_step_e-10-",
    "brake_step_b-10-",
    "brake_step_c-7-",
    "brake_step_c-10-",
];

/// One run of 198 is further from its floor than three deviations of noise: 1.34 floors in 61 windows, 1.33 are allowed.
const BY_CHANCE: &str = "brake_step_a-6-impl";

fn expected(name: &str) -> Verdict {
    let is_of = |list: &[&str]| list.iter().any(|start| name.starts_with(start));
    match () {
        () if is_of(&TOO_SHORT) => Verdict::NotExcited,
        () if name == BY_CHANCE => Verdict::NoneOfLibrary,
        () => Verdict::Consistent,
    }
}

fn named(report: &Report) -> Vec<(&'static str, Option<&'static str>)> {
    let effects = report.effects.iter();
    effects.map(|e| (e.mechanism, e.joint)).collect()
}

fn said(name: &str, report: &Report) -> String {
    let floor = report.floor.as_ref().map_or(f64::NAN, |f| f.ratio_after);
    let verdict = report.verdict.name();
    format!("{name}: {verdict}, {floor:.2} floors, {:?}", named(report))
}

/// Nothing is named, and the verdict is the expected one.
fn assert_nothing(reports: &[(String, Report)], expected: fn(&str) -> Verdict) {
    for (name, report) in reports {
        println!("{}", said(name, report));
    }
    for (name, report) in reports {
        assert_eq!(named(report), [], "{}", said(name, report));
        assert_eq!(report.verdict, expected(name), "{}", said(name, report));
    }
}

#[test]
fn every_golden_case_of_the_five_bar_is_consistent() {
    let cases: Vec<_> = five_bar::cases().collect();
    let reports = cases.into_par_iter();
    let reports = reports.map(|(case, runs)| (case.to_owned(), diagnosed_together(&runs)));
    assert_nothing(&reports.collect::<Vec<_>>(), |_| Verdict::Consistent);
}

#[test]
fn every_golden_case_of_a_brake_is_consistent() {
    let recordings = bench::recordings().into_iter();
    let one_a_case = recordings.filter(|own| own.name.ends_with("-2-impl"));
    let reports = diagnosed(one_a_case.collect()).into_iter();
    let reports: Vec<_> = reports.map(|(own, report)| (own.name, report)).collect();
    assert_nothing(&reports, |_| Verdict::Consistent);
}

#[test]
fn single_runs_are_consistent_or_too_short() {
    if asked().is_none() {
        println!("passed over: 198 diagnoses, with RIGPROOF_CASES=all");
        return;
    }
    let reports = diagnosed([five_bar::recordings(), bench::recordings()].concat());
    let reports: Vec<_> = reports
        .into_iter()
        .map(|(own, report)| (own.name, report))
        .collect();
    assert_nothing(&reports, expected);
}

#[test]
fn a_brake_of_the_implementation_that_is_two_per_cent_too_strong_is_named() {
    for (recording, report) in diagnosed(bench::with_gain(1.02)) {
        println!("{}", said(&recording.name, &report));
        assert_eq!(named(&report), [("gain_error", None)], "{}", report.summary);
        let fraction = report.effects[0].parameters["fraction"].value;
        assert!((fraction - 0.02).abs() < 0.002, "{fraction}");
    }
    for (recording, report) in diagnosed(five_bar::with_gain(1.02)) {
        println!("{}", said(&recording.name, &report));
        let expected = [("gain_error", Some("E"))];
        assert_eq!(named(&report), expected, "{}", report.summary);
        let fraction = report.effects[0].parameters["fraction"].value;
        assert!((fraction - 0.02).abs() < 0.001, "{fraction}");
    }
}

/// Alone within 1 %; under scatter within its interval; together 5 % was measured, because the share of an overshoot is taken of the nominal
/// torque.
fn assert_near(name: &str, value: &Number, number: f64) {
    let is_alone = name.split('-').count() == 4;
    if name.contains("-scatter") {
        let (low, high) = (value.low95.unwrap(), value.high95.unwrap());
        assert!(low < number && number < high, "{name}: {value:?}");
        return;
    }
    let most = if is_alone { 0.01 } else { 0.06 };
    let off = value.value / number - 1.0;
    assert!(off.abs() < most, "{name}: {value:?}, {number}");
}

#[test]
fn what_the_thesis_left_out_is_found_in_its_own_experiments() {
    let of = |[drag, overshoot, play, scatter]: [bool; 4]| Planted {
        drag,
        overshoot,
        play,
        scatter,
    };
    let mut cases = vec![
        of([true, true, true, false]),
        of([false, false, false, true]),
    ];
    if asked().is_some() {
        cases.extend([
            of([false, true, false, false]),
            of([true; 4]),
            of([false; 4]),
            of([true, false, false, false]),
            of([false, false, true, false]),
        ]);
    }
    let whole = asked().is_some_and(|word| word == "all");
    let recordings = cases
        .iter()
        .map(|planted| chapter_3::recording(Joint::E, *planted, whole, 4127));
    for (recording, report) in diagnosed(recordings.collect()) {
        println!("{}; {}", said(&recording.name, &report), report.summary);
        let scatter = recording.name.contains("-scatter");
        let mut found = 0;
        for (word, mechanism, numbers) in [
            ("-drag", "viscous", &[chapter_3::DRAG][..]),
            (
                "-overshoot",
                "reversal_overshoot",
                &[chapter_3::overshoot(Joint::E), chapter_3::OVERSHOOT_TRAVEL],
            ),
            (
                "-play",
                "current_hysteresis",
                &[chapter_3::PLAY_A, chapter_3::PLAY_SHARE],
            ),
        ] {
            let mut named = report.effects.iter().filter(|e| e.status == "named");
            let effect = named.find(|e| e.mechanism == mechanism);
            let planted = recording.name.contains(word);
            // Drag of this size is lost under the scatter (decision 0122).
            let is_seen = planted && !(scatter && mechanism == "viscous");
            assert_eq!(effect.is_some(), is_seen, "{mechanism}: {}", report.summary);
            found += usize::from(is_seen);
            for (value, number) in effect
                .iter()
                .flat_map(|e| e.parameters.values())
                .zip(numbers)
            {
                assert_near(&recording.name, value, *number);
            }
        }
        let named = report.effects.iter().filter(|e| e.status == "named");
        assert_eq!(found, named.count(), "{}", report.summary);
        let spread = report.unknown.as_ref().map(|unknown| unknown.variable);
        // What else stays is drawn as a curve of its own.
        assert_eq!(spread == Some("trial"), scatter, "{spread:?}");
        if recording.name == "chapter-3-E-scatter" {
            assert_eq!(report.verdict, Verdict::NoneOfLibrary);
            let said = &report.unknown.unwrap().suggestion;
            assert!(said.contains("0.39 N·m"), "{said}");
        }
    }
}

#[test]
fn what_a_damper_under_volts_hides_is_named_with_its_number() {
    let cases = [
        (Hidden::Nothing, None),
        (
            Hidden::Gain(-0.23),
            Some(("gain_error", "fraction", Some(-0.23), "1")),
        ),
        (
            Hidden::Square(0.6),
            Some(("command_exponent", "full", Some(5.0), "V")),
        ),
        (
            Hidden::Falling(2.7),
            Some(("time_constant", "falling", Some(2.7), "1")),
        ),
        (
            Hidden::Late(0.023),
            Some(("dead_time", "delay", Some(0.023), "s")),
        ),
        (
            Hidden::Remembers(0.55, 0.46),
            // A spread of plays is a form of it that may be taken for one play of another width.
            Some(("current_hysteresis", "half_width", None, "V")),
        ),
        (
            Hidden::Drag(310.0),
            Some(("viscous", "coefficient", Some(310.0), "N·s/m")),
        ),
        // Straight up to the travel, where the law bends towards it.
        (
            Hidden::Bends(1.5e-3),
            Some(("presliding", "travel", None, "m")),
        ),
    ];
    let reports = cases.into_par_iter().map(|(hidden, expected)| {
        let report = damper::recording(hidden, 83).diagnosed();
        (hidden, expected, report)
    });
    for (hidden, expected, report) in reports.collect::<Vec<_>>() {
        println!("{}", said(&format!("{hidden:?}"), &report));
        let Some((mechanism, parameter, number, unit)) = expected else {
            assert_eq!(report.verdict, Verdict::Consistent, "{}", report.summary);
            continue;
        };
        let sure = report.effects.iter().filter(|own| own.status == "named");
        let sure: Vec<&str> = sure.map(|own| own.mechanism).collect();
        assert_eq!(sure, [mechanism], "{}", report.summary);
        let (found, its_unit) = damper::number(&report, mechanism, parameter).unwrap();
        assert_eq!(its_unit, unit, "{mechanism}");
        let is_near = |number: f64| (found / number - 1.0).abs() < 0.01;
        assert!(number.is_none_or(is_near), "{hidden:?}: {found}");
    }
}

#[test]
fn what_a_static_sweep_hides_is_named_without_a_time() {
    use sweep::Hidden;
    let cases = [
        (Hidden::Nothing, None),
        (Hidden::Bends(1.5), Some(("saturation", "limit", None))),
        (
            Hidden::Square,
            Some(("command_exponent", "exponent", Some(2.0))),
        ),
        (
            Hidden::Remembers(0.13),
            Some(("current_hysteresis", "half_width", None)),
        ),
        (
            Hidden::Drag(0.021),
            Some(("viscous", "coefficient", Some(0.021))),
        ),
        (
            Hidden::Peak(0.31, 0.23, 1.7),
            Some(("stribeck", "peak", Some(0.23))),
        ),
    ];
    for (hidden, expected) in cases {
        let report = sweep::recording(hidden, 59).diagnosed();
        println!("{}", said(&format!("{hidden:?}"), &report));
        assert_eq!(report.remarks[0].what, "swept");
        let Some((mechanism, parameter, number)) = expected else {
            assert_eq!(report.verdict, Verdict::Consistent, "{}", report.summary);
            continue;
        };
        let sure = report.effects.iter().filter(|own| own.status == "named");
        let sure: Vec<&str> = sure.map(|own| own.mechanism).collect();
        let also: &[&str] = match hidden {
            Hidden::Peak(..) => &["dry_offset"],
            _ => &[],
        };
        assert!(sure.contains(&mechanism), "{}", report.summary);
        assert!(
            sure.iter()
                .all(|own| *own == mechanism || also.contains(own)),
            "{sure:?}"
        );
        let (found, _) = damper::number(&report, mechanism, parameter).unwrap();
        let is_near = |number: f64| (found / number - 1.0).abs() < 0.1;
        assert!(number.is_none_or(is_near), "{hidden:?}: {found}");
    }
}
