//! This file says that the rig's laws answer as the reference's do, and that a wrong answer would be seen.
//!
//! `RIGPROOF_CAMPAIGN` is the number of ticks; without it a slice runs.

use std::collections::BTreeMap;

use rayon::prelude::*;
use rigproof_impl::law::Law as _;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;

use crate::both::View;
use crate::both::{reference_command, rig_law, situation};
use crate::budget::assert_within_budget;
use crate::permitted::{Permitted, Tie, permitted};
use crate::sample::{LawKind, Sampler, Tick};

/// Ticks of one seed.
const CHUNK: u64 = 1000;
/// Ticks of the slice that every test run takes.
const SLICE: u64 = 200_000;

/// What became of many ticks.
#[derive(Default)]
struct Tally {
    ticks: u64,
    same: u64,
    rounding_a: Vec<f64>,
    amplified_a: Vec<f64>,
    ties: BTreeMap<Tie, u64>,
    wrong: Vec<String>,
    reasons: BTreeMap<String, u64>,
}

impl Tally {
    fn add(&mut self, tick: &Tick, nudger: &mut Sampler) {
        self.ticks += 1;
        let Some(mut law) = rig_law::<f64>(tick) else {
            // Settings that the rig's code refuses are refused by the reference.
            if crate::both::reference(tick, View::EXACT).is_ok() {
                self.wrong.push(format!("refused: {tick:?}"));
            }
            return;
        };
        if let Err(error) = crate::both::reference(tick, View::EXACT) {
            self.wrong.push(format!("taken: {error} in {tick:?}"));
            return;
        }
        let rig = Command::from(law.command(&situation(tick)));
        *self.reasons.entry(format!("{:?}", rig.reason)).or_default() += 1;
        match permitted(tick, reference_command(tick, View::EXACT), rig, nudger) {
            Ok(Permitted::Same) => self.same += 1,
            Ok(Permitted::Rounding(current_a)) => self.rounding_a.push(current_a),
            Ok(Permitted::Amplified(current_a)) => self.amplified_a.push(current_a),
            Ok(Permitted::Tie(tie)) => *self.ties.entry(tie).or_default() += 1,
            Err(wrong) => self.wrong.push(wrong),
        }
    }

    fn join(mut self, other: Tally) -> Tally {
        self.ticks += other.ticks;
        self.same += other.same;
        self.rounding_a.extend(other.rounding_a);
        self.amplified_a.extend(other.amplified_a);
        for (tie, count) in other.ties {
            *self.ties.entry(tie).or_default() += count;
        }
        for (reason, count) in other.reasons {
            *self.reasons.entry(reason).or_default() += count;
        }
        self.wrong.extend(other.wrong);
        self
    }
}

/// How many ticks are compared, a half of them plain.
pub fn ticks() -> u64 {
    match std::env::var("RIGPROOF_CAMPAIGN") {
        Ok(count) => count
            .parse()
            .expect("RIGPROOF_CAMPAIGN is a number of ticks"),
        Err(_) => SLICE,
    }
}

fn campaign(first_seed: u64, ticks: u64, draw: fn(&mut Sampler) -> Tick) -> Tally {
    let seeds = first_seed..first_seed + ticks.div_ceil(CHUNK);
    let tally = seeds
        .into_par_iter()
        .map(|seed| {
            let (mut sampler, mut nudger) = (Sampler::new(seed), Sampler::new(!seed));
            let mut tally = Tally::default();
            for number in 0..CHUNK {
                let before = tally.wrong.len();
                tally.add(&draw(&mut sampler), &mut nudger);
                for wrong in tally.wrong.iter_mut().skip(before) {
                    *wrong = format!("seed {seed}, tick {number}: {wrong}");
                }
            }
            tally
        })
        .reduce(Tally::default, Tally::join);
    println!("rounding: {}", quantiles(&tally.rounding_a));
    println!("amplified: {}", quantiles(&tally.amplified_a));
    println!(
        "{} ticks: {} the same, {} within rounding, {} amplified, ties {:?}, reasons {:?}",
        tally.ticks,
        tally.same,
        tally.rounding_a.len(),
        tally.amplified_a.len(),
        tally.ties,
        tally.reasons
    );
    tally
}

/// The quantiles that a budget has, printed.
pub fn quantiles(values: &[f64]) -> String {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let [q75, q99, max] = [0.75, 0.99, 1.0].map(|rank| {
        let place = sorted.len().saturating_sub(1) as f64 * rank;
        sorted.get(place as usize).copied().unwrap_or(f64::NAN)
    });
    format!("q75 {q75:e}, q99 {q99:e}, max {max:e}")
}

fn assert_none_wrong(tally: &Tally) {
    let wrong: Vec<_> = tally.wrong.iter().take(5).cloned().collect();
    let count = tally.wrong.len();
    assert!(
        count == 0,
        "{count} of {} ticks: {}",
        tally.ticks,
        wrong.join("\n")
    );
}

#[test]
fn plain_ticks_are_answered_as_by_the_reference() {
    let tally = campaign(71_000_000, ticks() / 2, Sampler::plain);
    assert_none_wrong(&tally);
    assert_within_budget("rig_law_current_plain", tally.rounding_a);
}

#[test]
fn adverse_ticks_are_answered_as_by_the_reference() {
    let tally = campaign(93_000_000, ticks() / 2, Sampler::adverse);
    assert_none_wrong(&tally);
    assert_within_budget("rig_law_current_adverse", tally.rounding_a);
}

#[test]
fn a_planted_wrong_answer_is_reported() {
    let (mut sampler, mut nudger) = (Sampler::new(17), Sampler::new(19));
    let mut planted = 0;
    while planted < 300 {
        let tick = sampler.plain();
        let Some(reference) = reference_command(&tick, View::EXACT) else {
            continue;
        };
        let Reason::Chosen(chosen) = reference.reason else {
            continue;
        };
        planted += 1;
        let mut elsewhere = reference;
        elsewhere.currents_a.rotate_right(1);
        let next = Joint::ALL
            .into_iter()
            .cycle()
            .skip_while(|joint| *joint != chosen)
            .nth(1);
        elsewhere.reason = Reason::Chosen(next.unwrap());
        let mut stronger = reference;
        stronger.currents_a = stronger
            .currents_a
            .map(|a| if a > 0.0 { a - 3.1e-6 } else { a });
        let mut strange = reference;
        strange.currents_a[0] = f64::NAN;
        let released = Command::none(Reason::NoneHelps);
        for wrong in [elsewhere, stronger, strange, released] {
            if wrong == reference {
                continue;
            }
            let verdict = permitted(&tick, Some(reference), wrong, &mut nudger);
            assert!(
                verdict.is_err(),
                "{wrong:?} passes as {verdict:?} in {tick:?}"
            );
        }
    }
}

//= thesis (6.11) test
#[test]
fn a_brake_whose_joint_stands_is_not_actuated() {
    let mut sampler = Sampler::new(31);
    let (mut stood, mut actuated) = (0, 0);
    while stood < 4000 {
        let mut tick = sampler.plain();
        tick.law = LawKind::Proportional(5.3e3);
        for (place, row) in situation::<f64>(&tick).rows.into_iter().enumerate() {
            // Beside a right angle to the row: less than a joint's least share of the tip's motion, and more.
            let nudge = sampler.nudge();
            let [stands, turns] = [0.9e-4, 1.1e-4]
                .map(|share: f64| (row.left() + row * (share * nudge.signum())) * 0.031);
            tick.velocity_m_s = turns.into();
            let command = |tick: &Tick| {
                let rig = Command::from(rig_law::<f64>(tick).unwrap().command(&situation(tick)));
                Some([reference_command(tick, View::EXACT)?, rig])
            };
            let Some(turning) = command(&tick) else {
                continue;
            };
            let holds =
                |command: &Command| !command.reason.is_lock() && command.currents_a[place] > 0.0;
            actuated += u32::from(turning.iter().all(holds));
            tick.velocity_m_s = stands.into();
            let standing = command(&tick).unwrap();
            assert!(!standing.iter().any(holds), "{standing:?} in {tick:?}");
            stood += 1;
        }
    }
    assert!(actuated > 100, "{actuated} of {stood}");
}

#[test]
fn two_currents_are_permitted_only_where_they_give_one_torque() {
    // Brake E at 0.1985 A gives 4.32·0.1985 + 0.21 = 1.067 52 N·m, and at 0.201 491 A the quadratic piece gives the same.
    let (mut sampler, mut nudger) = (Sampler::new(37), Sampler::new(41));
    let tick = sampler.plain();
    let at = |current_a: f64| Command {
        currents_a: [0.0, current_a, 0.0, 0.0],
        reason: Reason::Chosen(Joint::E),
    };
    let quadratic_a = {
        let (k_3, k_4, k_5) = (-2.72, 9.37, -0.71 - 1.067_52);
        (-k_4 + libm::sqrt(k_4 * k_4 - 4.0 * k_3 * k_5)) / (2.0 * k_3)
    };
    let verdict = permitted(&tick, Some(at(0.1985)), at(quadratic_a), &mut nudger);
    assert_eq!(verdict, Ok(Permitted::Tie(Tie::CurrentStep)));
    let verdict = permitted(
        &tick,
        Some(at(0.1985)),
        at(quadratic_a + 2.3e-7),
        &mut nudger,
    );
    assert!(verdict.is_err(), "{verdict:?}");
}
