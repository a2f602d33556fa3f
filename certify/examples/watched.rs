//! This program measures a monitor: false alarms in hours of use of rigs that are as certified, and how soon concealed changes are found.
//!
//! `watched false HOURS`, `watched found RIGS HALVES` and `watched both HOURS RIGS HALVES`, both for both layouts and the low proportional gain of table 6.1.
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
use rigproof_certify::monitor::{Made, made};
use rigproof_certify::plan::{FORM, Plan, Subject};
use rigproof_certify::scenario::{Rig, Scenario};
use rigproof_certify::tool::Tool;
use rigproof_impl::monitor::Alarm;
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
const SEED_OF_USE: u64 = 20_251_125;

fn plan(rig: Rig) -> Plan {
    Plan {
        form: FORM,
        name: "watched".to_owned(),
        controller: Subject::built_in(BuiltIn::of(Method::ProportionalLow)),
        baseline: None,
        rigs: vec![rig],
        seed: 1,
        scenarios: TRIALS,
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
    made(&none, source, TRIALS).unwrap().pop().unwrap()
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

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize| arguments[place].parse::<f64>().unwrap();
    for rig in [Rig::ThreeBrake, Rig::FourBrake] {
        let plan = plan(rig);
        let made = monitor(&plan);
        println!(
            "{:?} {:?} {:?}",
            made.rig, made.basis, made.constants.sigmas
        );
        match arguments[0].as_str() {
            "false" => false_alarms(&plan, &made, number(1)),
            "both" => {
                false_alarms(&plan, &made, number(1));
                found(&plan, &made, number(2) as u64, number(3));
            }
            _ => found(&plan, &made, number(1) as u64, number(2)),
        }
    }
}
