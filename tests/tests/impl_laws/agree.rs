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
use crate::sample::{Sampler, Tick};

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

fn ticks() -> u64 {
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
            for _ in 0..CHUNK {
                tally.add(&draw(&mut sampler), &mut nudger);
            }
            tally
        })
        .reduce(Tally::default, Tally::join);
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

fn assert_none_wrong(tally: &Tally) {
    if let Some(first) = tally.wrong.first() {
        panic!("{} of {} ticks: {first}", tally.wrong.len(), tally.ticks);
    }
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
