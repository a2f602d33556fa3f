//! This program measures a monitor: false alarms in hours of use of rigs that are as certified, and how soon concealed changes are found.
//!
//! `watched HOURS RIGS WIDTHS TRIALS SEED`, for both layouts and the low proportional gain of table 6.1: a monitor from so many trials, so many hours
//! of use, and for each number changes of so many rigs by so many widths of its interval, on rigs drawn from the seed. A last word `three`
//! or `four` asks for one layout only.
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
use rigproof_certify::monitor::drill::{Concealed, Drilled, is_of_coverage, run};
use rigproof_certify::monitor::{Made, made};
use rigproof_certify::plan::{Plan, Subject};
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::tool::Tool;
use rigproof_impl::monitor::Alarm;
use rigproof_impl::monitor::constants::WATCHED;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::Method;

/// Samples of one use: ninety seconds.
const USE_TICKS: u32 = 90_000;
/// When a change comes: after a minute of use.
const CHANGE_TICKS: u32 = 60_000;

fn plan(rig: Rig, trials: u64) -> Plan {
    let controller = Subject::built_in(BuiltIn::of(Method::ProportionalLow));
    Plan {
        scenarios: trials,
        ..Plan::alone("watched", controller, vec![rig])
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
fn in_use(plan: &Plan, seed: u64, index: u64) -> Option<Scenario> {
    let mut scenario = Scenario::drawn(seed, index, &plan.rigs, USE_TICKS);
    scenario.faults.clear();
    let is_use = matches!(scenario.hand, Hand::Operator { .. });
    is_use.then_some(scenario)
}

fn false_alarms(plan: &Plan, made: &Made, seed: u64, hours: f64) {
    let source = plan.controller.source().unwrap();
    let most = (hours * 3600.0 / 90.0) as u64 * 4;
    let (mut ticks, mut covered, mut wrong) = (0_u64, 0, Vec::new());
    // In parts, so that no more is run than is asked for.
    for begin in (0..most).step_by(40) {
        let each = (begin..begin + 40).into_par_iter().filter_map(|index| {
            let scenario = in_use(plan, seed, index)?;
            let drilled = run(&scenario, source, &made.constants, None, |_| {})?;
            Some((index, drilled))
        });
        let each: Vec<(u64, Drilled)> = each.collect();
        for (index, drilled) in each {
            ticks += u64::from(drilled.ticks);
            match drilled.alarm {
                // Where no trial was, an alarm is right.
                Some((alarm, _)) if is_of_coverage(alarm) => covered += 1,
                Some((alarm, tick)) => wrong.push((index, alarm, tick)),
                None => {}
            }
        }
        if ticks as f64 >= hours * 3.6e6 {
            break;
        }
    }
    println!(
        "{:?}: {:.2} h of use, {covered} alarms outside of what was covered, {} false alarms: {wrong:?}",
        made.rig,
        ticks as f64 / 3.6e6,
        wrong.len()
    );
}

/// What changes where a number does.
fn change(number: usize) -> (Mechanism, Joint) {
    let at = |place: usize| Joint::ALL.get(place).copied().unwrap();
    match number {
        0..4 => (Mechanism::GainError, at(number)),
        4..8 => (Mechanism::DryOffset, at(number - 4)),
        _ => (Mechanism::ConstantBias, at(2 * (number - 8))),
    }
}

/// Whether the alarm names the joint.
fn names(alarm: Option<(Alarm, u32)>, joint: Joint) -> bool {
    match alarm {
        Some((Alarm::Gain(at) | Alarm::Friction(at) | Alarm::Bias(at), _)) => at == joint,
        _ => false,
    }
}

fn found(plan: &Plan, made: &Made, seed: u64, rigs: u64, widths: f64) {
    let source = plan.controller.source().unwrap();
    for number in 0..WATCHED {
        let (mechanism, joint) = change(number);
        if !made.rig.layout().brakes().contains(&joint) {
            continue;
        }
        let width = made.constants.high[number] - made.constants.low[number];
        let all = (0..rigs).into_par_iter().filter_map(|index| {
            let scenario = in_use(plan, seed, index)?;
            let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
            let concealed = Concealed {
                effect: LeftOut {
                    mechanism,
                    joint: Some(joint),
                    parameters: vec![sign * widths * width],
                },
                from_tick: CHANGE_TICKS,
                is_driven: mechanism == Mechanism::GainError,
            };
            let drilled = run(&scenario, source, &made.constants, Some(&concealed), |_| {})?;
            Some((drilled.is_found(&concealed)?, index, drilled))
        });
        let all: Vec<(bool, u64, Drilled)> = all.collect();
        let hits = all.iter().filter(|own| own.0);
        let mut times: Vec<u32> = hits.map(|own| own.2.excited_at_alarm).collect();
        times.sort_unstable();
        let missed = all.iter().filter(|own| !own.0).map(|own| own.1);
        let named = all.iter().filter(|own| names(own.2.alarm, joint)).count();
        println!(
            "{:?} {} {}: {} of {} found within 2 s, median {:?} ms; {named} named the joint; missed on rigs {:?}",
            made.rig,
            mechanism.name(),
            joint.letter(),
            times.len(),
            all.len(),
            times.get(times.len() / 2),
            missed.collect::<Vec<u64>>()
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize| arguments[place].parse::<f64>().unwrap();
    let only = arguments.get(5).map(String::as_str);
    for (rig, name) in [(Rig::ThreeBrake, "three"), (Rig::FourBrake, "four")] {
        if only.is_some_and(|only| only != name) {
            continue;
        }
        let seed = arguments[4].parse().unwrap();
        let plan = plan(rig, number(3) as u64);
        let made = monitor(&plan);
        println!("{:?} {:?}", made.rig, made.basis);
        false_alarms(&plan, &made, seed, number(0));
        found(&plan, &made, seed, number(1) as u64, number(2));
    }
}
