//! This file says that the rig's laws answer as the reference's do, and that a wrong answer would be seen.
//!
//! `RIGPROOF_CAMPAIGN` is the number of ticks; without it a slice runs.

use rayon::prelude::*;
use rigproof_certify::built_in::Kind;
use rigproof_certify::differential::both::{View, reference_command, rig_law, situation};
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::permitted::{Permitted, permitted};
use rigproof_certify::differential::tick::Tick;
use rigproof_certify::differential::tie::Tie;
use rigproof_impl::law::Law as _;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;

use crate::budget::assert_within_budget;
use crate::impl_laws::sample::Sampler;
use crate::impl_laws::tally::{Answers, quantiles};

/// Ticks of one seed.
const CHUNK: u64 = 1000;
/// Ticks of the slice that every test run takes.
const SLICE: u64 = 200_000;

/// How many ticks are compared, a half of them plain.
pub fn ticks() -> u64 {
    match std::env::var("RIGPROOF_CAMPAIGN") {
        Ok(count) => count
            .parse()
            .expect("RIGPROOF_CAMPAIGN is a number of ticks"),
        Err(_) => SLICE,
    }
}

/// Answers one tick, or says that both refuse its settings.
fn add(answers: &mut Answers, tick: &Tick, nudger: &mut Nudger, place: &str) {
    let refused = rigproof_certify::differential::both::reference(tick, View::EXACT).err();
    match (rig_law::<f64>(tick), refused) {
        (Some(mut law), None) => {
            let rig = Command::from(law.command(&situation(tick)));
            answers.add(tick, rig, nudger, place);
        }
        (None, Some(_)) => answers.refused += 1,
        (_, refused) => {
            let wrong = format!(
                "{place}: the reference refuses by {refused:?}, the rig not, or not that: {tick:?}"
            );
            answers.wrong.push(wrong);
        }
    }
}

fn campaign(first_seed: u64, ticks: u64, draw: fn(&mut Sampler) -> Tick) -> Answers {
    let seeds = first_seed..first_seed + ticks.div_ceil(CHUNK);
    let count = CHUNK * (seeds.end - seeds.start);
    let answers = seeds
        .into_par_iter()
        .map(|seed| {
            let (mut sampler, mut nudger) = (Sampler::new(seed), Nudger::new(!seed));
            let mut answers = Answers::default();
            for number in 0..CHUNK {
                let place = format!("seed {seed}, tick {number}");
                add(&mut answers, &draw(&mut sampler), &mut nudger, &place);
            }
            answers
        })
        .reduce(Answers::default, |mut one, other| {
            one.join(other);
            one
        });
    println!("rounding: {}", quantiles(&answers.rounding_a));
    println!("{count} ticks: {}", answers.counts());
    answers
}

#[test]
fn plain_ticks_are_answered_as_by_the_reference() {
    let answers = campaign(71_000_000, ticks() / 2, Sampler::plain);
    answers.assert_none_wrong();
    assert_within_budget("rig_law_current_plain", answers.rounding_a);
}

#[test]
fn adverse_ticks_are_answered_as_by_the_reference() {
    let answers = campaign(93_000_000, ticks() / 2, Sampler::adverse);
    answers.assert_none_wrong();
    assert_within_budget("rig_law_current_adverse", answers.rounding_a);
}

#[test]
fn a_planted_wrong_answer_is_reported() {
    let (mut sampler, mut nudger) = (Sampler::new(17), Nudger::new(19));
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
        tick.law = Kind::Proportional {
            gain_n_s_per_m: 5.3e3,
        };
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
    let (mut sampler, mut nudger) = (Sampler::new(37), Nudger::new(41));
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
