//! This program measures a monitor: false alarms in hours of use of rigs that are as certified, and how soon concealed changes are found.
//!
//! `watched false HOURS`, `watched found RIGS HALVES`, `watched both HOURS RIGS HALVES`, `watched far USES` and `watched all HOURS RIGS HALVES USES TRIALS`, each for both layouts and the low proportional
//! gain of table 6.1; the last says how far the statistics go in uses of the certificate's scenarios as they are drawn, with adversaries and faults.
//! `looks INDEX` and `tops USES` say which looks at the numbers of uses of the certificate's scenarios found one beyond its end.
//! A last word `three` or `four` asks for one layout only.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a program that measures stops at the first surprise, and prints"
)]

use rayon::prelude::*;
use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::hand::Hand;
use rigproof_certify::left_out::LeftOut;
use rigproof_certify::monitor::drill::{Concealed, Drilled, run};
use rigproof_certify::monitor::{Made, constants, made};
use rigproof_certify::plan::{FORM, Plan, Subject};
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::tool::Tool;
use rigproof_impl::monitor::constants::{Constants, WATCHED};
use rigproof_impl::monitor::{Alarm, Monitor};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::Method;

/// Samples of one use: ninety seconds.
const USE_TICKS: u32 = 90_000;
/// When a change comes: after a minute of use.
const CHANGE_TICKS: u32 = 60_000;
/// Trials of the certificate.
const TRIALS: u64 = 1000;
/// Sets the rigs in use apart from those of the certificate.
const SEED_OF_USE: u64 = 20_261_126;

fn plan(rig: Rig, trials: u64) -> Plan {
    Plan {
        form: FORM,
        name: "watched".to_owned(),
        controller: Subject::built_in(BuiltIn::of(Method::ProportionalLow)),
        baseline: None,
        rigs: vec![rig],
        seed: 1,
        scenarios: trials,
        ticks: 10_000,
        calibration: None,
        search: 0,
        limits: [None; 5],
        regressions: [None; 5],
        least_met: 1,
        requirements: Vec::new(),
    }
}

/// A monitor from the plan's trials; its certificate is taken as given.
fn monitor(plan: &Plan) -> Made {
    let tool = Tool {
        version: String::new(),
        sha256: String::new(),
    };
    let mut none = Certificate::new(plan, &Default::default(), vec![], vec![], tool).unwrap();
    // What is measured is the monitor; whether laws were met was judged elsewhere.
    none.laws.clear();
    none.requirements.clear();
    none.metrics.clear();
    let source = plan.controller.source().unwrap();
    made(&none, source, plan.scenarios).unwrap().pop().unwrap()
}

/// A rig in use: an operator's hand, back and forth along the path, with sensors that work.
fn in_use(plan: &Plan, index: u64) -> Option<Scenario> {
    let mut scenario = Scenario::drawn(SEED_OF_USE, index, &plan.rigs, USE_TICKS);
    scenario.faults.clear();
    let is_use = matches!(scenario.hand, Hand::Operator { .. });
    is_use.then_some(scenario)
}

fn false_alarms(plan: &Plan, made: &Made, hours: f64) {
    let source = plan.controller.source().unwrap();
    let most = (hours * 3600.0 / 90.0) as u64 * 4;
    let all = (0..most).into_par_iter().filter_map(|index| {
        let scenario = in_use(plan, index)?;
        Some((
            index,
            run(&scenario, source, &made.constants, None, |_| {})?,
        ))
    });
    let all: Vec<(u64, Drilled)> = all.collect();
    let (mut ticks, mut alarms) = (0_u64, Vec::new());
    for (index, drilled) in &all {
        if ticks as f64 >= hours * 3.6e6 {
            break;
        }
        ticks += u64::from(drilled.ticks);
        alarms.extend(drilled.alarm.map(|(alarm, tick)| (index, alarm, tick)));
    }
    // Where no trial was, an alarm is right.
    let is_right = |alarm: &Alarm| {
        matches!(
            alarm,
            Alarm::Place | Alarm::Speed | Alarm::Force | Alarm::Cell
        )
    };
    let right = alarms
        .iter()
        .filter(|(_, alarm, _)| is_right(alarm))
        .count();
    println!(
        "{:?}: {:.2} h of use, {right} alarms outside of what was covered, {} false alarms: {alarms:?}",
        made.rig,
        ticks as f64 / 3.6e6,
        alarms.len() - right
    );
}

fn found(plan: &Plan, made: &Made, rigs: u64, halves: f64) {
    let source = plan.controller.source().unwrap();
    for mechanism in [
        Mechanism::GainError,
        Mechanism::DryOffset,
        Mechanism::ConstantBias,
    ] {
        for joint in Joint::ALL {
            let place = joint as usize;
            let is_bias = mechanism == Mechanism::ConstantBias;
            let is_braked = plan.rigs[0].layout().brakes().contains(&joint);
            if !is_braked || (is_bias && !matches!(joint, Joint::A | Joint::B)) {
                continue;
            }
            let number = match mechanism {
                Mechanism::GainError => place,
                Mechanism::DryOffset => 4 + place,
                _ => 8 + place / 2,
            };
            let half = made.constants.high[number];
            let all = (0..rigs).into_par_iter().filter_map(|index| {
                let scenario = in_use(plan, index)?;
                let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
                let concealed = Concealed {
                    effect: LeftOut {
                        mechanism,
                        joint: Some(joint),
                        parameters: vec![sign * halves * half],
                    },
                    from_tick: CHANGE_TICKS,
                    is_driven: mechanism == Mechanism::GainError,
                };
                let drilled = run(&scenario, source, &made.constants, Some(&concealed), |_| {})?;
                Some((drilled.is_found(&concealed)?, drilled))
            });
            let all: Vec<(bool, Drilled)> = all.collect();
            let mut times: Vec<u32> = all
                .iter()
                .filter(|own| own.0)
                .map(|own| own.1.excited_at_alarm)
                .collect();
            times.sort_unstable();
            let named = all.iter().filter(|own| match own.1.alarm {
                Some((Alarm::Gain(at) | Alarm::Friction(at) | Alarm::Bias(at), _)) => at == joint,
                _ => false,
            });
            println!(
                "{:?} {} {}: {} of {} found within 2 s, median {:?} ms; {} named the joint",
                made.rig,
                mechanism.name(),
                joint.letter(),
                times.len(),
                all.len(),
                times.get(times.len() / 2),
                named.count()
            );
        }
    }
}

/// How far the statistics went in a use, in standard deviations: as long as it was covered, and after.
struct Far {
    index: u64,
    is_adversary: bool,
    faults: usize,
    covered: f64,
    after: f64,
    at: (u32, usize),
    left_at: Option<u32>,
}

/// How far they go in the use of this number.
fn far_in(plan: &Plan, index: u64, open: &Constants, closed: &Constants) -> Option<Far> {
    let source = plan.controller.source().unwrap();
    let mut scenario = plan.scenario(index);
    scenario.ticks = USE_TICKS;
    let mut own = Far {
        index,
        is_adversary: matches!(scenario.hand, Hand::Adversary { .. }),
        faults: scenario.faults.len(),
        covered: 0.0,
        after: 0.0,
        at: (0, 0),
        left_at: None,
    };
    let (mut tick, mut outside) = (0, 0);
    run(&scenario, source, open, None, |monitor| {
        tick += 1;
        outside = if is_covered(monitor, closed) {
            0
        } else {
            outside + 1
        };
        if outside >= closed.hold {
            own.left_at.get_or_insert(tick);
        }
        let ends = open.low.iter().zip(&open.high);
        for (place, (number, (low, high))) in
            monitor.estimate().numbers().iter().zip(ends).enumerate()
        {
            let sigmas = number.beyond(*low, *high, 0.0) / number.variance.sqrt();
            if sigmas > own.covered.max(own.after) {
                own.at = (tick, place);
            }
            let most = if own.left_at.is_some() {
                &mut own.after
            } else {
                &mut own.covered
            };
            *most = most.max(sigmas);
        }
    })?;
    Some(own)
}

fn far(plan: &Plan, made: &Made, uses: u64) {
    let open = constants(plan, made.rig).unwrap();
    let all = (0..uses)
        .into_par_iter()
        .filter_map(|index| far_in(plan, index, &open, &made.constants));
    let mut all: Vec<Far> = all.collect();
    all.sort_by(|one, other| {
        other
            .covered
            .max(other.after)
            .total_cmp(&one.covered.max(one.after))
    });
    for (is_adversary, is_faulty) in [(false, false), (false, true), (true, false), (true, true)] {
        let own = all
            .iter()
            .filter(|own| own.is_adversary == is_adversary && (own.faults > 0) == is_faulty);
        let (mut count, mut left, mut covered, mut after) = (0, 0, 0.0_f64, 0.0_f64);
        for one in own {
            count += 1;
            left += usize::from(one.left_at.is_some());
            covered = covered.max(one.covered);
            after = after.max(one.after);
        }
        println!(
            "{:?} far: adversary {is_adversary}, faults {is_faulty}: {count} uses, most {covered:.2} while covered; {left} left it, most {after:.2} after",
            made.rig
        );
    }
    for one in all.iter().take(12) {
        println!(
            "use {}: adversary {}, {} faults, {:.2} covered, {:.2} after, number {} at sample {}, left at {:?}",
            one.index,
            one.is_adversary,
            one.faults,
            one.covered,
            one.after,
            one.at.1,
            one.at.0,
            one.left_at
        );
    }
}

/// Whether the last good sample lay where trials were.
fn is_covered(monitor: &Monitor, of: &Constants) -> bool {
    let seen = monitor.seen();
    let ([x, y], [left, right, near, far]) = (seen.tip_m, of.tip_m);
    [x, y] == [0.0; 2]
        || (left..=right).contains(&x)
            && (near..=far).contains(&y)
            && seen.speed_squared <= of.speed_m_s * of.speed_m_s
            && seen.force_squared <= of.force_n * of.force_n
            && of.cells >> seen.cell & 1 == 1
}

/// What every look of a use came to that found a number beyond its ends, standard deviations.
fn looks(plan: &Plan, rig: Rig, index: u64) {
    let source = plan.controller.source().unwrap();
    let open = constants(plan, rig).unwrap();
    let scenario = Scenario {
        ticks: USE_TICKS,
        ..plan.scenario(index)
    };
    println!(
        "{:?} {:?} {:?}",
        scenario.hand, scenario.plant, scenario.task
    );
    let (mut tick, mut last) = (0, [0.0; WATCHED]);
    run(&scenario, source, &open, None, |monitor| {
        tick += 1;
        let mut now = [0.0; WATCHED];
        let ends = open.low.iter().zip(&open.high);
        for (now, (number, (low, high))) in now
            .iter_mut()
            .zip(monitor.estimate().numbers().iter().zip(ends))
        {
            *now = number.beyond(*low, *high, 0.0) / number.variance.sqrt();
        }
        let most = now.iter().copied().fold(0.0, f64::max);
        if now != last && most > 1.3 {
            let shown = now.map(|own| (own * 10.0).round() / 10.0);
            println!(
                "sample {tick}: {shown:?}, surprise {:.2}",
                monitor.estimate().surprise()
            );
        }
        last = now;
    });
}

/// The looks of a use that found a number farthest beyond its ends: standard deviations, number, sample.
fn tops(plan: &Plan, rig: Rig, uses: u64) {
    let source = plan.controller.source().unwrap();
    let open = constants(plan, rig).unwrap();
    let all = (0..uses).into_par_iter().filter_map(|index| {
        let mut scenario = plan.scenario(index);
        if !matches!(scenario.hand, Hand::Operator { .. }) || !scenario.faults.is_empty() {
            return None;
        }
        scenario.ticks = USE_TICKS;
        let (mut tick, mut top) = (0, (0.0, 0, 0));
        run(&scenario, source, &open, None, |monitor| {
            tick += 1;
            let ends = open.low.iter().zip(&open.high);
            for (place, (number, (low, high))) in
                monitor.estimate().numbers().iter().zip(ends).enumerate()
            {
                let beyond = number.beyond(*low, *high, 0.0) / number.variance.sqrt();
                if beyond > top.0 {
                    top = (beyond, place, tick);
                }
            }
        })?;
        Some((top, index))
    });
    let mut all: Vec<_> = all.collect();
    all.sort_by(|one, other| other.0.0.total_cmp(&one.0.0));
    for one in all.iter().take(14) {
        println!("{one:?}");
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize| arguments[place].parse::<f64>().unwrap();
    let only = arguments.last().map_or("", String::as_str);
    for (rig, name) in [(Rig::ThreeBrake, "three"), (Rig::FourBrake, "four")] {
        if ["three", "four"].contains(&only) && only != name {
            continue;
        }
        let is_all = arguments[0] == "all";
        let plan = plan(rig, if is_all { number(5) as u64 } else { TRIALS });
        if arguments[0] == "looks" {
            looks(&plan, rig, number(1) as u64);
            continue;
        }
        if arguments[0] == "tops" {
            tops(&plan, rig, number(1) as u64);
            continue;
        }
        let made = monitor(&plan);
        println!(
            "{:?} {:?} {:?}",
            made.rig, made.basis, made.constants.margins
        );
        match arguments[0].as_str() {
            "false" => false_alarms(&plan, &made, number(1)),
            "far" => far(&plan, &made, number(1) as u64),
            "all" => {
                false_alarms(&plan, &made, number(1));
                found(&plan, &made, number(2) as u64, number(3));
                far(&plan, &made, number(4) as u64);
            }
            "both" => {
                false_alarms(&plan, &made, number(1));
                found(&plan, &made, number(2) as u64, number(3));
            }
            _ => found(&plan, &made, number(1) as u64, number(2)),
        }
    }
}
