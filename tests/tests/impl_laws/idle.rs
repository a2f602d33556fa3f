//! This file says that beside a brake that makes a wanted force alone any idle one may be named, and nothing else passes.

use nalgebra::Vector2;
use rigproof_certify::built_in::Kind;
use rigproof_certify::differential::both::{
    View, reference_command, reference_nearest, reference_rows,
};
use rigproof_certify::differential::idle::answers;
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::permitted::permitted;
use rigproof_certify::differential::tick::{PathKind, Tick};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;

use crate::impl_laws::sample::Sampler;

/// A tick whose path lies so that the force across it is along a brake's push; turned by so much, rad.
fn along_a_push(sampler: &mut Sampler, turn_rad: f64) -> Option<(Tick, Joint)> {
    let mut tick = sampler.plain();
    let rows = reference_rows(&tick)?;
    let place = ((sampler.nudge() + 1.0) * 1.5) as usize;
    let across = rows[place].normalize();
    let (sine, cosine) = libm::sincos(turn_rad);
    let along = Vector2::new(across.y, -across.x) * cosine + across * sine;
    tick.path = PathKind::Line([[0.0137, 0.0719], [0.0137 + along.x, 0.0719 + along.y]]);
    tick.law = Kind::Impedance {
        stiffness_n_per_m: 317.0,
        damping_across_n_s_per_m: 0.0,
        damping_along_n_s_per_m: 0.0,
    };
    tick.obstacle = None;
    let joint = Joint::ALL[place];
    tick.layout
        .brakes()
        .contains(&joint)
        .then_some((tick, joint))
}

fn verdict(tick: &Tick, rig: Command, nudger: &mut Nudger) -> Result<(), String> {
    let reference = reference_command(tick, View::EXACT);
    permitted(tick, reference, rig, nudger).map(|_| ())
}

/// The commands of pairs whose currents are one brake's, whatever they are called.
fn called_otherwise(tick: &Tick, currents_a: [f64; 4]) -> Vec<Command> {
    let brakes = tick.layout.brakes();
    let twos = brakes
        .iter()
        .flat_map(|one| brakes.iter().map(move |other| (*one, *other)));
    let pairs = twos.filter(|(one, other)| one != other);
    pairs
        .map(|(one, other)| Command {
            currents_a,
            reason: Reason::ChosenPair(one, other),
        })
        .collect()
}

#[test]
fn beside_a_brake_that_makes_the_force_alone_any_idle_one_may_be_named_and_no_other_command_given()
{
    let (mut sampler, mut nudger) = (Sampler::new(43), Nudger::new(47));
    let mut met = 0;
    while met < 100 {
        let Some((tick, joint)) = along_a_push(&mut sampler, 0.0) else {
            continue;
        };
        let answers = answers(&tick, &reference_nearest(&tick).unwrap());
        let Some(right) = answers.iter().find(|command| {
            command.currents_a.iter().filter(|a| **a > 0.01).count() == 1
                && command.currents_a[joint as usize] > 0.01
        }) else {
            continue;
        };
        met += 1;
        let mut weaker = *right;
        weaker.currents_a = weaker
            .currents_a
            .map(|a| if a > 0.0 { a - 3.1e-6 } else { a });
        let mut elsewhere = *right;
        elsewhere.currents_a.rotate_right(1);
        let mut wrong = vec![weaker, elsewhere];
        for other in called_otherwise(&tick, right.currents_a) {
            let Reason::ChosenPair(one, second) = other.reason else {
                unreachable!()
            };
            if one == joint || second == joint {
                continue;
            }
            wrong.push(other);
        }
        let mut back = tick.clone();
        back.velocity_m_s = tick.velocity_m_s.map(|component| -component);
        assert!(
            verdict(&back, *right, &mut nudger).is_err(),
            "{right:?} in {back:?}"
        );
        for answer in &answers {
            assert_eq!(verdict(&tick, *answer, &mut nudger), Ok(()), "{answer:?}");
        }
        for wrong in wrong {
            assert!(
                verdict(&tick, wrong, &mut nudger).is_err(),
                "{wrong:?} in {tick:?}"
            );
        }
    }
}

#[test]
fn where_the_force_is_off_the_push_by_a_billionth_the_idle_brake_is_known() {
    let (mut sampler, mut nudger) = (Sampler::new(53), Nudger::new(59));
    let mut met = 0;
    while met < 100 {
        let turn_rad = 1.3e-9 * sampler.nudge().signum();
        let Some((tick, _)) = along_a_push(&mut sampler, turn_rad) else {
            continue;
        };
        let nearest = reference_nearest(&tick).unwrap();
        assert_eq!(answers(&tick, &nearest), []);
        let Some(reference) = reference_command(&tick, View::EXACT) else {
            continue;
        };
        let acting = reference.currents_a.iter().filter(|a| **a > 0.01).count();
        if acting != 1 || !matches!(reference.reason, Reason::ChosenPair(..)) {
            continue;
        }
        met += 1;
        let mut wrong = called_otherwise(&tick, reference.currents_a);
        wrong.retain(|wrong| wrong.reason != reference.reason);
        wrong.push(Command::none(Reason::NoneHelps));
        for wrong in wrong {
            assert!(
                verdict(&tick, wrong, &mut nudger).is_err(),
                "{wrong:?} in {tick:?}"
            );
        }
    }
}
