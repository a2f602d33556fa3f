//! This file says that a tip which is slower than a picometre a second stands, for reference and rig, whatever its squares come to.

use rigproof_certify::built_in::Kind;
use rigproof_certify::differential::both::{View, reference_command, rig_law, situation};
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::permitted::permitted;
use rigproof_certify::differential::tick::Tick;
use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_spec::command::{Command, Reason};

use crate::impl_laws::sample::Sampler;

/// Speeds below a picometre a second, m/s: squares that are normal numbers, that lose digits and that vanish, in one precision or both.
const SLOW_M_S: [f64; 5] = [0.97e-12, 3.1e-21, 2.3e-155, 2.3e-162, 7e-322];

fn rig<R: Real>(tick: &Tick) -> Command {
    let mut law = rig_law::<R>(tick).expect("plain settings");
    law.command(&situation(tick)).into()
}

#[test]
fn a_tip_slower_than_a_picometre_a_second_stands() {
    let (mut sampler, mut nudger) = (Sampler::new(43), Nudger::new(47));
    let (mut stood, mut acted) = (0, 0);
    while stood < 20_000 {
        let mut tick = sampler.plain();
        let by_velocity = !matches!(tick.law, Kind::Uncontrolled | Kind::Sdof { .. });
        if !by_velocity || reference_command(&tick, View::EXACT).is_none() {
            continue;
        }
        let (sine, cosine) = libm::sincos(3.1 * sampler.nudge());
        let at = |speed_m_s: f64| [cosine * speed_m_s, sine * speed_m_s];
        for slow_m_s in SLOW_M_S {
            tick.velocity_m_s = at(slow_m_s);
            let commands = [
                reference_command(&tick, View::EXACT).unwrap(),
                rig::<f64>(&tick),
                rig::<f32>(&tick),
            ];
            for command in commands {
                let brakes = matches!(command.reason, Reason::Chosen(_) | Reason::ChosenPair(..));
                let back = command.reason == Reason::LockedMovingBack;
                assert!(!brakes && !back, "{command:?} at {slow_m_s:e} in {tick:?}");
            }
            let [reference, rig, _] = commands;
            permitted(&tick, Some(reference), rig, &mut nudger).unwrap();
            stood += 1;
        }
        tick.velocity_m_s = at(1.03e-12);
        let moving = [
            reference_command(&tick, View::EXACT).unwrap(),
            rig::<f64>(&tick),
            rig::<f32>(&tick),
        ];
        acted += u32::from(moving.iter().all(|command| {
            matches!(
                command.reason,
                Reason::Chosen(_) | Reason::ChosenPair(..) | Reason::LockedMovingBack
            )
        }));
    }
    assert!(acted > 1000, "{acted} of {stood}");
}

#[test]
fn the_tick_that_was_decided_by_squares_that_vanish_is_answered_as_by_the_reference() {
    let mut sampler = Sampler::new(93_004_050);
    let slow = |tick: &Tick| {
        let [x, y] = tick.velocity_m_s;
        let speed_m_s = libm::hypot(x, y);
        0.0 < speed_m_s && speed_m_s < 1e-150
    };
    let tick = (0..433).map(|_| sampler.adverse()).last().unwrap();
    assert!(
        slow(&tick) && matches!(tick.law, Kind::Impedance { .. }),
        "{tick:?}"
    );
    let reference = reference_command(&tick, View::EXACT).unwrap();
    let rig = rig::<f64>(&tick);
    assert_eq!(reference, rig);
    assert_eq!(rig, Command::none(rig.reason));
}
