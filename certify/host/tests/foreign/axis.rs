//! This file says that a sound controller of an axis passes, and that each planted fault is refused by its name.

use std::path::{Path, PathBuf};

use rigproof_certify::axis::campaign::{Record, records};
use rigproof_certify::axis::certificate::Certificate;
use rigproof_certify::axis::description::Description;
use rigproof_certify::axis::found::Found;
use rigproof_certify::axis::law::Law;
use rigproof_certify::axis::plan::{Library, Plan, Sources};
use rigproof_certify::foreign::{Foreign, Limits};
use rigproof_certify::tool::Tool;

use crate::bench::{ROOM, compiled, foreign, limits};

/// The example in C, with what it is told: stiffness or damping.
fn pd(name: &str, told: &[&str]) -> Option<PathBuf> {
    let mut all = vec!["-Wall", "-Wextra", "-Werror"];
    all.extend(told);
    compiled(&format!("axis_{name}"), "../c/examples/pd.c", &all)
}

/// The example's plan of so many trials of 2 s, on its axis and what more of it is given.
fn plan(new: &Foreign, old: Option<&Foreign>, more: &str) -> Plan {
    let file = Path::new(ROOM).join("../c/axis.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let description = Description::parse(&text, &file).unwrap();
    let rig = std::fs::read_to_string(&description.rig).unwrap() + more;
    let library = |own: &Foreign| Library {
        name: "pd.so".to_owned(),
        sha256: own.sha256().to_owned(),
        process: limits(),
        lacks: Vec::new(),
    };
    let mut asked = description.asked;
    if old.is_none() {
        asked.regressions = [None; 2];
    }
    Plan {
        name: description.name,
        controller: library(new),
        baseline: old.map(library),
        axis: Found::read(&rig, &description.rig).unwrap(),
        asked,
        seed: 3,
        scenarios: 16,
        ticks: 2000,
    }
}

fn run(plan: &Plan, new: &Foreign, old: Option<&Foreign>) -> (Certificate, Vec<Record>) {
    let sources = Sources {
        controller: new,
        baseline: old.map(|own| own as _),
    };
    let all = records(plan, &sources, &|| {});
    let tool = Tool {
        version: "0".to_owned(),
        sha256: "0".to_owned(),
    };
    (Certificate::new(plan, &all, tool).unwrap(), all)
}

/// What a controller comes to by itself.
fn alone(library: &Path) -> Certificate {
    let limits = Limits {
        tick_ms: Some(400),
        ..limits()
    };
    let source = foreign(library, limits);
    run(&plan(&source, None, ""), &source, None).0
}

fn is_broken(certificate: &Certificate, law: Law) -> bool {
    let of = |own: &&rigproof_certify::axis::certificate::LawSummary| own.law == law;
    let own = certificate.laws.iter().find(of).unwrap();
    let name = format!("the law {} is broken", law.name());
    let is_said = certificate.reasons.iter().any(|own| own.contains(&name));
    assert_eq!(is_said, own.broken_in > 0, "{:?}", certificate.reasons);
    own.broken_in > 0
}

#[test]
fn a_stiffer_controller_passes_and_a_softer_one_is_worse_than_the_baseline() {
    let (Some(stiff), Some(soft)) = (pd("stiff", &[]), pd("soft", &["-DSTIFFNESS=1500.0"])) else {
        return;
    };
    let (stiff, soft) = (foreign(&stiff, limits()), foreign(&soft, limits()));
    let own = plan(&stiff, Some(&soft), "");
    let (certificate, all) = run(&own, &stiff, Some(&soft));
    assert_eq!(certificate.reasons, [""; 0]);
    assert!(certificate.may_go() && certificate.laws.len() == Law::ALL.len());
    assert_eq!(certificate.ended.time_over, 16);
    assert_eq!(certificate.unlike(&all).unwrap(), [""; 0]);
    // The other way about it is a regression, and no law is broken.
    let mut own = plan(&soft, Some(&stiff), "");
    own.asked.stiffness = Some(1500.0);
    let (certificate, _) = run(&own, &soft, Some(&stiff));
    let reasons = certificate.reasons.join("\n");
    assert!(
        reasons.contains("error: the mean may be worse than the baseline's by"),
        "{reasons}"
    );
    assert!(
        !certificate.may_go() && !reasons.contains("is broken"),
        "{reasons}"
    );
}

#[test]
fn a_damper_of_the_wrong_sign_gives_energy_and_runs_into_a_stop() {
    let Some(library) = pd("wrong", &["-DDAMPING=-0.2"]) else {
        return;
    };
    let certificate = alone(&library);
    assert!(is_broken(&certificate, Law::Passivity) && !certificate.may_go());
    assert!(!is_broken(&certificate, Law::Repeats) && !is_broken(&certificate, Law::EffortLimit));
    let error = certificate.metrics[0].controller.unwrap();
    assert!(error.q50 > 0.002, "{error:?}");
}

#[test]
fn a_gain_that_chatters_is_refused_for_it() {
    let Some(library) = pd("chatters", &["-DSTIFFNESS=400000.0"]) else {
        return;
    };
    let certificate = alone(&library);
    assert!(is_broken(&certificate, Law::Chatter) && !certificate.may_go());
    assert!(!is_broken(&certificate, Law::Answers) && !is_broken(&certificate, Law::EffortLimit));
}

#[test]
fn what_a_tick_does_wrong_has_its_law() {
    for (name, effort, law, how) in [
        ("beyond", "effort * 1.7 + 30", Law::EffortLimit, None),
        (
            "undefined",
            "sensed->number == 700 ? NAN : effort",
            Law::EffortLimit,
            None,
        ),
        (
            "by_process",
            "effort + 1e-9 * (getpid() % 1000)",
            Law::Repeats,
            None,
        ),
        (
            "hung",
            "effort; while (sensed->number == 40) { }",
            Law::Answers,
            Some("within 400 ms"),
        ),
        (
            "crash",
            "sensed->number == 17 ? *(volatile double *)8 : effort",
            Law::Answers,
            Some("SIGSEGV"),
        ),
        (
            "outside",
            "effort; ((double *)commanded)[2] = 1.0",
            Law::Answers,
            Some("outside its buffer"),
        ),
    ] {
        let Some(library) = faulty(name, effort) else {
            return;
        };
        let certificate = alone(&library);
        assert!(
            is_broken(&certificate, law) && !certificate.may_go(),
            "{name}"
        );
        let first = certificate.first_failure.as_deref();
        assert_eq!(first.is_some(), how.is_some(), "{name}: {first:?}");
        assert!(
            how.is_none_or(|how| first.unwrap().contains(how)),
            "{name}: {first:?}"
        );
    }
}

/// The example with another last line of its tick.
fn faulty(name: &str, effort: &str) -> Option<PathBuf> {
    let text = std::fs::read_to_string(Path::new(ROOM).join("../c/examples/pd.c")).unwrap();
    let end = "commanded->effort =";
    assert!(text.contains(end));
    let wrong = format!(
        "effort = fmax(-greatest_effort, fmin(greatest_effort, effort)); commanded->effort = {effort}; return 0; {end}"
    );
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("axis_{name}.c"));
    let text = format!(
        "#define _DEFAULT_SOURCE\n#include <unistd.h>\n{}",
        text.replace(end, &wrong)
    );
    std::fs::write(&source, text).unwrap();
    let library = format!("axis_{name}");
    compiled(&library, source.to_str().unwrap(), &["-w"])
}

#[test]
fn a_figure_that_was_changed_is_refused_also_with_a_new_digest() {
    let Some(library) = pd("forged", &["-DDAMPING=-0.2"]) else {
        return;
    };
    let source = foreign(&library, limits());
    let own = plan(&source, None, "");
    let (certificate, all) = run(&own, &source, None);
    let file = Path::new("certificate.json");
    let text = certificate.to_json().unwrap();
    assert_eq!(Certificate::parse(&text, file).unwrap(), certificate);
    let changed = text.replace(
        "\"may_go_on_the_rig\": false",
        "\"may_go_on_the_rig\": true",
    );
    assert!(Certificate::parse(&changed, file).is_err());
    // Whoever computes everything anew that follows is told by the trials.
    let mut forged = certificate.clone();
    for law in &mut forged.laws {
        (law.broken_in, law.first_broken) = (0, None);
    }
    for metric in &mut forged.metrics {
        metric.limit = None;
    }
    let forged = forged.sealed().unwrap();
    let read = Certificate::parse(&forged.to_json().unwrap(), file).unwrap();
    assert!(read.may_go());
    let wrong = read.unlike(&all).unwrap().join("\n");
    for part in ["its laws came out otherwise", "its metrics", "its verdict"] {
        assert!(wrong.contains(part), "{wrong}");
    }
}

#[test]
fn what_no_trial_runs_is_a_reason_against_by_its_name() {
    let Some(library) = pd("not_run", &[]) else {
        return;
    };
    let source = foreign(&library, limits());
    let fade = "[[effect]]\nmechanism = \"friction_fade\"\n\
        rate = { value = 0.01, unit = \"1/s\" }\ndrag_rate = { value = 0.0, unit = \"1/s\" }\n";
    let (certificate, _) = run(&plan(&source, None, fade), &source, None);
    assert_eq!(certificate.reasons.len(), 1, "{:?}", certificate.reasons);
    assert!(certificate.reasons[0].contains("`friction_fade`, which no trial runs"));
}
