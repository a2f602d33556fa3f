//! This file says that premises are counted where they are met, that what is met too rarely is refused, and that every trial ends in one way.

use std::path::Path;

use rigproof_certify::certificate::{Certificate, records};
use rigproof_certify::law::Law;
use rigproof_certify::metrics::Metric;
use rigproof_certify::plan::Plan;
use rigproof_certify::record::Record;
use rigproof_certify::requirement::Asked;
use rigproof_certify::scenario::FaultKind;
use rigproof_certify::search::Target;
use rigproof_certify::trial::{Ran, run as ran};
use rigproof_certify::way::Way;
use rigproof_impl::path::Path as _;
use rigproof_impl::vector::Vector;

use crate::runs::{plan, run, tool};

/// The names of the cells that a trial's states and faults say that it visited, told apart from what counts them.
fn visited(plan: &Plan, index: u64, ran: &Ran) -> Vec<String> {
    let (scenario, mut names) = (plan.scenario(index), Vec::new());
    let mut after = 0;
    for (tick, state) in (0_u32..).zip(&ran.states) {
        let fault = scenario
            .faults
            .iter()
            .find(|fault| (fault.from_tick..fault.from_tick + fault.ticks).contains(&tick));
        let fault = match fault.map(|fault| fault.kind) {
            Some(FaultKind::Missed(_) | FaultKind::Stale) => "number",
            Some(FaultKind::Jumped(_)) => "counts",
            Some(_) => "force sensor",
            None if after > 0 => "just after",
            None => "no fault",
        };
        after = match fault {
            "no fault" | "just after" => i32::max(after - 1, 0),
            _ => 100,
        };
        let [x, y] = state.tip_m;
        let place = [["left near", "left far"], ["right near", "right far"]];
        let place = place[usize::from(x >= 0.0)][usize::from(y >= 0.37)];
        let of = |size: f64, ends: [f64; 2]| ends.into_iter().filter(|end| size >= *end).count();
        let [next, own] = [tick as usize + 1, tick as usize].map(|tick| ran.states.get(tick));
        let (Some(own), Some(_)) = (own, next) else {
            continue;
        };
        let speed = ["still", "slow", "fast"][of(speed_m_s(&scenario, own), [0.02, 0.15])];
        let [fx, fy] = state.force_n;
        let force = ["light", "middle", "strong"][of(fx.hypot(fy), [2.0, 10.0])];
        names.push(format!("{place}, {speed}, {force}, {fault}"));
    }
    names.sort();
    names.dedup();
    names
}

/// The tip's speed by the reference's forward kinematics, from where it is a microsecond later.
fn speed_m_s(
    scenario: &rigproof_certify::scenario::Scenario,
    state: &rigproof_certify::trial::State,
) -> f64 {
    let arms = rigproof_spec::geometry::arms(scenario.rig.layout());
    let tip = |after_s: f64| {
        let [a, b] = [0, 1].map(|k| state.theta_rad[k] + after_s * state.rates_rad_s[k]);
        let pose = rigproof_model::linkage::forward::pose(&arms, a, b).unwrap();
        [pose.tip_m[0], pose.tip_m[1]]
    };
    let ([x, y], [then_x, then_y]) = (tip(0.0), tip(1e-6));
    ((then_x - x) / 1e-6).hypot((then_y - y) / 1e-6)
}

#[test]
fn premises_are_counted_where_they_are_met() {
    let plan = Plan {
        baseline: None,
        ..plan()
    };
    let sources = plan.sources().unwrap();
    let declared = plan.controller.declared;
    let gap_m = declared.gap_m.unwrap();
    let (mut inside, mut faulty) = (0, 0);
    for index in 0..12 {
        let record = Record::of(&plan, &sources, index).unwrap();
        let ran = ran(&plan.scenario(index), sources.controller, &declared, true).unwrap();
        let names = visited(&plan, index, &ran);
        let answers = &record.met[Law::Answers as usize];
        assert_eq!(answers.samples(), u64::from(record.ticks));
        let own: Vec<String> = rigproof_certify::coverage::Cell::all()
            .filter(|cell| answers.has(*cell))
            .map(|cell| cell.name())
            .collect();
        let missing: Vec<&String> = names.iter().filter(|name| !own.contains(name)).collect();
        assert!(missing.is_empty(), "{index}: {missing:?}");
        // The last sample has no state after it.
        assert!(own.len() <= names.len() + 1, "{own:?} {names:?}");
        // Inside the gap by the true tip; the law goes by the encoders, so that a few samples at its edge differ.
        let way = Way::new(&plan.scenario(index).task).unwrap();
        let is_inside = |tip: [f64; 2]| way.path.nearest(Vector::from(tip)).distance_m() <= gap_m;
        inside += ran.states.iter().filter(|s| is_inside(s.tip_m)).count() as i64;
        inside -= record.met[Law::Gap as usize].samples() as i64;
        let safe = record.met[Law::Safe as usize].samples();
        assert_eq!(safe, record.fared[Law::Safe as usize].samples);
        faulty += safe;
        for law in Law::ALL {
            let [met, fared] = [
                record.met[law as usize].samples(),
                record.fared[law as usize].samples,
            ];
            assert!(met <= fared, "{}: {met} {fared}", law.name());
        }
    }
    assert!(faulty > 100 && inside.abs() < 500, "{faulty} {inside}");
}

#[test]
fn what_is_met_too_rarely_is_a_reason_against_and_every_trial_ends_once() {
    let of = |least_met: u64| {
        let folder = tempfile::tempdir().unwrap();
        let plan = Plan {
            least_met,
            ..plan()
        };
        let chunks = run(&plan, [0, 1], folder.path(), 2);
        Certificate::new(&plan, &chunks, Vec::new(), Vec::new(), tool()).unwrap()
    };
    let few = of(1);
    let gap = few.laws.iter().find(|law| law.law == Law::Gap).unwrap();
    assert!(gap.met.trials > 3 && gap.met.trials < 44, "{gap:?}");
    let of_gap = |own: &Certificate| own.reasons.iter().any(|why| why.contains("law gap"));
    assert!(!of_gap(&few), "{:?}", few.reasons);
    let own = few
        .requirements
        .iter()
        .find(|own| own.by == Target::Law(Law::Gap));
    assert!(own.unwrap().holds);
    assert!(gap.met.samples < gap.samples && gap.met.cells < gap.met.of_cells);
    assert_eq!(gap.met.never.len() as u64, gap.met.of_cells - gap.met.cells);
    let by_place: u64 = gap.met.parts.iter().take(4).map(|part| part.samples).sum();
    assert_eq!(by_place, gap.met.samples);
    let visited = &few.visited;
    assert_eq!(visited.never.len() as u64 + visited.visited, visited.cells);
    assert!(visited.visited > 20 && !visited.never.is_empty());
    let ended = [Some(few.ended.controller), few.ended.baseline];
    for own in ended.into_iter().flatten() {
        assert_eq!(
            own.each().iter().sum::<u64>(),
            few.plan.scenarios,
            "{own:?}"
        );
    }
    let many = of(44);
    assert!(!many.may_go());
    let reason = many
        .reasons
        .iter()
        .find(|reason| reason.contains("law gap"));
    let met = gap.met.trials;
    let words = format!("was met in {met} trials, and at least 44 are asked for");
    assert!(reason.unwrap().contains(&words), "{reason:?}");
    let gap = many
        .requirements
        .iter()
        .find(|own| own.by == Target::Law(Law::Gap));
    assert!(!gap.unwrap().holds);
}

#[test]
fn a_law_that_no_layout_can_break_is_not_looked_at() {
    use rigproof_certify::scenario::Rig;
    let of = |rigs: &[Rig]| Plan {
        rigs: rigs.to_vec(),
        ..plan()
    };
    let four = of(&[Rig::FourBrake]).not_looked_at(Law::BrakedJoints);
    assert!(four.unwrap().contains("has a brake"));
    let both = of(&[Rig::ThreeBrake, Rig::FourBrake]);
    assert_eq!(both.not_looked_at(Law::BrakedJoints), None);
}

#[test]
fn what_a_laboratory_asks_for_stands_in_the_table_and_needs_something_that_is_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let mut plan = plan();
    let chunks = run(&plan, [0, 1], folder.path(), 2);
    let asked = |says: &str, by: Target| Asked {
        says: says.to_owned(),
        by,
    };
    plan.limits[Metric::TipForce as usize] = Some(15.0);
    plan.requirements = vec![
        asked("a light hand", Target::Metric(Metric::TipForce)),
        asked("never pushes back", Target::Law(Law::Passivity)),
        asked("short", Target::Metric(Metric::Finish)),
    ];
    let of = Certificate::new(&plan, &chunks, Vec::new(), Vec::new(), tool()).unwrap();
    let [light, passive, short] = [0, 1, 2].map(|k| &of.requirements[k]);
    assert!(
        light.holds && passive.holds && !short.holds,
        "{:?}",
        of.requirements
    );
    let force = &of.metrics[Metric::TipForce as usize];
    let limit = &force.limits[0];
    assert_eq!(light.margin, Some(limit.most - limit.value.unwrap()));
    assert!(
        limit.holds && limit.words.contains("allows 15 N"),
        "{}",
        limit.words
    );
    // The worst single trial stands beside the limit.
    let worst = force.worst_scenario.unwrap();
    let all = records(&chunks);
    let own = all[worst as usize].measured[Metric::TipForce as usize];
    assert_eq!(own, Some(force.controller.unwrap().greatest));
    let reason = of.reasons.iter().find(|reason| reason.contains("“short”"));
    // The trials are so short that no lock was called for: that is the other reason.
    assert!(
        reason.is_some() && of.reasons.len() == 2,
        "{:?}",
        of.reasons
    );
    assert!(of.reasons[0].contains("law lock was held against no sample"));
    let refused = |of: Certificate| {
        let text = of.to_json().unwrap();
        Certificate::parse(&text, Path::new("certificate.json")).is_err()
    };
    assert!(!refused(of.clone()));
    let mut forged = of;
    forged.requirements[2].holds = true;
    forged.digest.clear();
    forged.digest = rigproof_certify::digest::of_bytes(forged.to_json().unwrap().as_bytes());
    assert!(refused(forged));
}

#[test]
fn failures_are_gathered_by_place_fault_and_a_number_of_the_plant() {
    use rigproof_certify::cluster::{clusters, examples};
    use rigproof_certify::coverage::{Cell, Met};
    let mut plan = plan();
    plan.scenarios = 400;
    plan.ticks = 2;
    let sources = plan.sources().unwrap();
    let mut all: Vec<Record> = (0..plan.scenarios)
        .map(|index| Record::of(&plan, &sources, index).unwrap())
        .collect();
    // What broke it is written into the records: the gap where the payload is above 0.35 kg, the count of brakes for a hasty hand or not.
    let cell = |name: &str| {
        let found = Cell::all().find(|cell| cell.name() == name).unwrap();
        u8::try_from(found.index()).unwrap()
    };
    let [left, right] = [
        "left far, slow, light, no fault",
        "right near, fast, strong, just after",
    ]
    .map(cell);
    let mut heavy = 0;
    for record in &mut all {
        let payload_kg = plan.scenario(record.index).plant.payload_kg;
        let mut breaks = |law: Law, cell: u8| {
            let fared = &mut record.fared[law as usize];
            (fared.broken, fared.first, fared.worst) = (1, Some(1), -0.5);
            let met: serde_json::Value = serde_json::to_value(&record.met[law as usize]).unwrap();
            let mut parts = met.as_array().unwrap().clone();
            parts[2] = cell.into();
            let met: Met = serde_json::from_value(parts.into()).unwrap();
            record.met[law as usize] = met;
        };
        if payload_kg > 0.35 {
            heavy += 1;
            breaks(Law::Gap, left);
        }
        if record.index % 40 == 3 {
            breaks(Law::BrakeCount, right);
        }
    }
    let found = clusters(&plan, &all.iter().collect::<Vec<_>>());
    assert_eq!(found.len(), 2);
    let [gap, count] = [&found[0], &found[1]];
    assert_eq!(
        (gap.law, gap.trials, count.law, count.trials),
        (Law::Gap, heavy, Law::BrakeCount, 10)
    );
    assert_eq!(
        (gap.place.as_str(), gap.fault.as_str()),
        ("left far", "no fault")
    );
    assert_eq!(
        (count.place.as_str(), count.fault.as_str()),
        ("right near", "just after")
    );
    let share = heavy as f64 / (heavy + 10) as f64;
    assert!((gap.share - share).abs() < 1e-12);
    let what = &gap.common[0].what;
    assert!(
        what.starts_with("payload at least +0.35"),
        "{:?}",
        gap.common
    );
    assert!(gap.common[0].others < 0.01);
    assert!(count.common.is_empty(), "{:?}", count.common);
    // What does not break again has no example.
    let none = examples(&plan, sources.controller, &found).unwrap();
    assert!(none.iter().all(Option::is_none));
}
