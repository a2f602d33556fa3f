//! This file says what a search for worse cases is: never better than what was drawn, the same on any threads, and run again to the bit.

use std::path::Path;

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::certificate::{Certificate, records};
use rigproof_certify::controller::Source;
use rigproof_certify::declared::Declared;
use rigproof_certify::finding::Finding;
use rigproof_certify::law::Law;
use rigproof_certify::metrics::Metric;
use rigproof_certify::plan::{Plan, Sources};
use rigproof_certify::record::Record;
use rigproof_certify::search::{Searched, Target, Worst, search};
use rigproof_spec::methods::Method;

use crate::bent::after;
use crate::runs::{plan, run, tool};

fn searched(plan: &Plan, source: &dyn Source, records: &[&Record], threads: usize) -> Searched {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build()
        .unwrap()
        .install(|| search(plan, source, records))
        .unwrap()
}

#[test]
fn a_search_finds_worse_the_same_on_any_threads_and_again() {
    let plan = Plan {
        search: 40,
        baseline: None,
        ..plan()
    };
    let folder = tempfile::tempdir().unwrap();
    let chunks = run(&plan, [0, 1], folder.path(), 2);
    let records = records(&chunks);
    let source = plan.sources().unwrap().controller;
    let found = searched(&plan, source, &records, 2);
    assert_eq!(searched(&plan, source, &records, 1), found);
    assert!(found.met.is_empty(), "{:?}", found.met);
    let found = found.worst;
    let mut worse = 0;
    for worst in &found {
        let is_worse = match worst.target {
            Target::Law(_) => worst.found < worst.drawn,
            Target::Metric(_) => worst.found > worst.drawn,
            Target::Premise(_) => worst.found > worst.drawn && !worst.cells.is_empty(),
        };
        assert!(is_worse || worst.found == worst.drawn, "{worst:?}");
        println!(
            "{}: {} to {} in {}",
            worst.target.name(),
            worst.drawn,
            worst.found,
            worst.trials
        );
        worse += usize::from(is_worse);
        assert!(worst.trials <= 42);
        let read = Worst::parse(&worst.to_json().unwrap(), Path::new("worst.json")).unwrap();
        assert_eq!(&read, worst);
        assert!(read.replayed(source).unwrap().is_same);
    }
    assert!(worse >= 3, "{worse} of {}", found.len());
    let is_reached =
        |worst: &&Worst| matches!(worst.target, Target::Premise(_)) && worst.found > 0.0;
    assert!(found.iter().filter(is_reached).count() >= 1);
    assert!(
        found
            .iter()
            .any(|worst| worst.target == Target::Metric(Metric::TipForce))
    );
    let unsought = Plan {
        search: 0,
        ..plan.clone()
    };
    assert_eq!(
        search(&unsought, source, &records).unwrap(),
        Searched::default()
    );
}

/// Every scenario of a plan as it is drawn.
fn drawn(plan: &Plan, source: &dyn Source) -> Vec<Record> {
    let sources = Sources {
        controller: source,
        baseline: None,
    };
    (0..plan.scenarios)
        .map(|index| Record::of(plan, &sources, index).unwrap())
        .collect()
}

/// A controller that brakes A and E by the hand's force; forces that cannot be are left out.
fn by_force(a_per_n: f64) -> Box<dyn Source> {
    after(
        BuiltIn::of(Method::Uncontrolled),
        (),
        move |(), sensed, _| {
            let force_n = sensed.tip_force_n.norm();
            let current_a = if force_n < 30.0 {
                f64::min(a_per_n * force_n, 1.0)
            } else {
                0.0
            };
            Ok([current_a, current_a, 0.0, 0.0])
        },
    )
}

#[test]
fn a_search_breaks_a_law_that_no_drawn_scenario_breaks() {
    let mut plan = Plan {
        search: 70,
        baseline: None,
        scenarios: 8,
        ..plan()
    };
    plan.controller.declared = Declared {
        within_force: true,
        ..Declared::default()
    };
    let holds = |a_per_n: f64| {
        let records = drawn(&plan, by_force(a_per_n).as_ref());
        records
            .iter()
            .all(|own| own.fared[Law::TipForce as usize].broken == 0)
    };
    // The most that no drawn scenario breaks the law with, all but a thousandth.
    let (mut least, mut most) = (0.0, 0.5);
    assert!(holds(least) && !holds(most));
    for _ in 0..12 {
        let middle = 0.5 * (least + most);
        if holds(middle) {
            least = middle;
        } else {
            most = middle;
        }
    }
    let source = by_force(0.999 * least);
    let records = drawn(&plan, source.as_ref());
    let found = searched(
        &plan,
        source.as_ref(),
        &records.iter().collect::<Vec<_>>(),
        2,
    );
    let mut worst = found.worst.iter();
    let worst = worst.find(|worst| worst.target == Target::Law(Law::TipForce));
    let worst = worst.unwrap();
    assert!(worst.found < 0.0 && worst.drawn > 0.0, "{worst:?}");
    assert!(found.met.iter().any(|met| met.law == Law::TipForce));
}

/// A controller that asks for 5 A beyond a force, and for nothing below; forces that cannot be are left out.
fn trapped(beyond_n: f64) -> Box<dyn Source> {
    after(
        BuiltIn::of(Method::Uncontrolled),
        (),
        move |(), sensed, _| {
            let force_n = sensed.tip_force_n.norm();
            let is_beyond = force_n > beyond_n && force_n < 30.0;
            Ok([if is_beyond { 5.0 } else { 0.0 }; 4])
        },
    )
}

/// The law shows no slope, so nothing searches for it: a search for greater forces falls into the trap all the same.
#[test]
fn a_breach_that_a_search_meets_on_its_way_is_kept() {
    let mut plan = Plan {
        search: 40,
        baseline: None,
        scenarios: 8,
        ..plan()
    };
    plan.controller.declared = Declared::default();
    let limit = Law::CurrentLimit as usize;
    let is_kept = |beyond_n: f64| {
        let records = drawn(&plan, trapped(beyond_n).as_ref());
        records.iter().all(|own| own.fared[limit].broken == 0)
    };
    let (mut least, mut most) = (0.0, 30.0);
    assert!(!is_kept(least) && is_kept(most));
    for _ in 0..10 {
        let middle = 0.5 * (least + most);
        if is_kept(middle) {
            most = middle;
        } else {
            least = middle;
        }
    }
    let source = trapped(most);
    let records = drawn(&plan, source.as_ref());
    let records: Vec<&Record> = records.iter().collect();
    let met = searched(&plan, source.as_ref(), &records, 2).met;
    let own = met.iter().find(|met| met.law == Law::CurrentLimit).unwrap();
    assert!(matches!(own.target, Target::Metric(_)), "{:?}", own.target);
    // It is a finding like one that was drawn: shrunk, run again from its file, recorded, and a reason against.
    let findings = Finding::all(&plan, source.as_ref(), &records, &met).unwrap();
    let found = findings.iter().find(|found| found.law == Law::CurrentLimit);
    let found = found.unwrap();
    assert_eq!(found.searched, Some(own.target));
    assert!(
        found.scenario.ticks < own.scenario.ticks && found.tick < 100,
        "{found:?}"
    );
    let read = Finding::parse(&found.to_json().unwrap(), Path::new("finding.json")).unwrap();
    assert!(read == *found && read.is(&found.named().unwrap()).unwrap());
    assert!(read.comes_again(source.as_ref()).unwrap());
    assert!(!read.comes_again(trapped(30.0).as_ref()).unwrap());
    assert!(found.to_mcap(source.as_ref()).unwrap().len() > 1000);
    let chunks = records.iter().map(|record| (*record).clone()).collect();
    let named = vec![found.named().unwrap()];
    let certificate = Certificate::new(&plan, &[(0, chunks)].into(), named, Vec::new(), tool());
    let certificate = certificate.unwrap();
    let reason = "the law current_limit is broken in a scenario that the search for a worse";
    assert!(
        !certificate.may_go_on_the_rig
            && certificate
                .reasons
                .iter()
                .any(|own| own.starts_with(reason)),
        "{:?}",
        certificate.reasons
    );
    let text = certificate.to_json().unwrap();
    assert!(Certificate::parse(&text, Path::new("certificate.json")).is_ok());
}
