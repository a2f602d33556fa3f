//! Whether the diagnosis, told the reference model, finds nothing in what the optimised implementation does in every golden case, and names
//! what is changed in it.
//!
//! By default a run of every kind is diagnosed; `RIGPROOF_CAMPAIGN=all` diagnoses every run of every case. With `RIGPROOF_KEEP=folder`
//! the recordings and their rig descriptions stay there, so that `rigproof diagnose` can be asked again.

mod bench;
mod chapter_3;
mod five_bar;
mod laws;
mod recording;
mod script;

use rayon::prelude::*;
use rigproof_diagnose::report::{Report, Verdict};

use chapter_3::Planted;
use recording::Recording;
use rigproof_spec::joint::Joint;

/// What is asked for: every run, or those whose name holds a word.
fn asked() -> Option<String> {
    std::env::var("RIGPROOF_CAMPAIGN").ok()
}

/// Everything that is to be diagnosed: recordings of the implementation, and of the reference under the same inputs.
fn recordings() -> Vec<Recording> {
    let all = asked().is_some();
    let word = asked().filter(|word| word != "all").unwrap_or_default();
    let mut recordings = [five_bar::recordings(all), bench::recordings(all)].concat();
    recordings.retain(|recording| recording.name.contains(&word));
    recordings
}

fn said(recording: &Recording, report: &Report) -> String {
    let effects = report.effects.iter();
    let named: Vec<_> = effects.map(|e| (e.mechanism, e.joint)).collect();
    let floor = report.floor.as_ref().map_or(f64::NAN, |f| f.ratio_after);
    format!(
        "{}: {}, {floor:.2} times the floor, {named:?}; {}",
        recording.name,
        report.verdict.name(),
        report.protocol.get(2).map_or("", String::as_str),
    )
}

#[test]
fn nothing_is_found_in_any_golden_case() {
    let reports: Vec<(Recording, Report)> = recordings()
        .into_par_iter()
        .map(|recording| {
            let report = recording.diagnosed();
            (recording, report)
        })
        .collect();
    let mut wrong = Vec::new();
    for (recording, report) in &reports {
        println!("{}", said(recording, report));
        let quiet = report.effects.is_empty() && report.ambiguous_with.is_empty();
        if report.verdict != Verdict::Consistent || !quiet {
            wrong.push(said(recording, report));
        }
    }
    assert!(reports.len() > 8, "{} recordings", reports.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_brake_that_is_two_per_cent_too_strong_is_named() {
    let mut cases = five_bar::with_gain(1.02, &[1, 6, 8, 9]);
    cases.extend(bench::with_gain(1.02));
    cases.into_par_iter().for_each(|recording| {
        let report = recording.diagnosed();
        println!(
            "{} {:?}",
            said(&recording, &report),
            report.effects.first().map(|e| (&e.parameters, e.z))
        );
    });
}

#[test]
fn what_the_thesis_left_out_is_found_in_its_own_experiments() {
    let of = |drag, overshoot, play, scatter| Planted {
        drag,
        overshoot,
        play,
        scatter,
    };
    let cases = [
        of(false, false, false, false),
        of(true, false, false, false),
        of(false, true, false, false),
        of(false, false, true, false),
        of(true, true, true, false),
        of(false, false, false, true),
        of(true, true, true, true),
    ];
    let joint = Joint::E;
    cases.into_par_iter().for_each(|planted| {
        let recording = chapter_3::recording(joint, planted, asked().is_some(), 4127);
        let report = recording.diagnosed();
        println!(
            "{planted:?}: {}, {:#?}",
            said(&recording, &report),
            report.summary
        );
        for e in &report.effects {
            println!(
                "   {planted:?} {} {:?} z {} share {}",
                e.mechanism, e.parameters, e.z, e.share_explained
            );
        }
        println!(
            "   {planted:?} amb {:?} small {:?} withdrawn {:?} floor {:?} unknown {:?}",
            report.ambiguous_with,
            report.too_small_to_name,
            report.withdrawn,
            report.floor,
            report.unknown.as_ref().map(|u| (u.variable, u.share))
        );
        for e in &report.not_seen {
            println!("   {planted:?} {e:?}");
        }
    });
}
