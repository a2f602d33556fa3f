//! This file claims what holds for the five-bar's plant: its energy, its friction, its convergence.

use super::law::{Effect, Law};
use super::linkage::{Pair, dot};
use super::mass::Form;
use super::*;
use rigproof_spec::inertia::inertia;
use rigproof_spec::joint::Joint;

fn effect(law: Law, joint: Joint) -> Effect {
    Effect {
        law,
        joint: Some(joint),
        onset_s: None,
    }
}

/// A soft hand about a circle, brakes on and off: everything sticks and slides.
fn push(time_s: f64, tip_m: Pair, velocity: Pair) -> Pair {
    let (s, c) = libm::sincos(2.3 * time_s);
    let goal = [0.013 + 0.11 * s, 0.41 + 0.08 * c * libm::sin(0.7 * time_s)];
    [
        420.0 * (goal[0] - tip_m[0]) - 21.0 * velocity[0],
        420.0 * (goal[1] - tip_m[1]) - 21.0 * velocity[1],
    ]
}

fn currents(time_s: f64) -> [f64; 4] {
    let on = |period_s: f64, level_a: f64| {
        if (time_s / period_s).fract() < 0.4 {
            level_a
        } else {
            0.0
        }
    };
    [
        on(1.31, 0.37),
        on(0.83, 0.29),
        on(1.07, 0.43),
        on(0.61, 0.23),
    ]
}

fn start(layout: Layout, hidden: &[Effect]) -> FiveBar {
    let theta = angles_of_tip(&arms(layout), [0.013, 0.39]).unwrap();
    FiveBar::new(layout, theta, hidden).unwrap()
}

fn kinetic_j(rig: &FiveBar, layout: Layout) -> f64 {
    let form = Form::new(&rig.arms, &inertia(layout), &rig.pose, rig.rates);
    0.5 * dot(rig.rates, form.times(rig.rates))
}

/// Work of the hand is kinetic energy plus what the joints took, to 1e-5 of the work turned over.
#[test]
fn energy_balances_and_no_joint_ever_gives_any() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let hidden = [effect(Law::Viscous { coefficient: 0.057 }, Joint::E)];
        let mut rig = start(layout, &hidden);
        let (mut work_j, mut turned_j, mut taken_j, mut given_j) = (0.0, 0.0, 0.0, 0.0);
        let (mut stuck, mut slid) = ([0; 4], [0; 4]);
        for k in 0..120_000 {
            let time_s = f64::from(k) * 1e-4;
            let step = rig.step(time_s, 1e-4, currents(time_s), &mut push).unwrap();
            let work = dot(step.force_n, step.tip_travel_m);
            work_j += work;
            turned_j += work.abs();
            for (joint, (torque, travel)) in
                step.resistance_nm.iter().zip(step.travel_rad).enumerate()
            {
                let power = torque * travel;
                taken_j += power;
                given_j += (-power).max(0.0);
                if rig.stuck()[joint] {
                    stuck[joint] += 1
                } else {
                    slid[joint] += 1
                }
            }
        }
        // A joint that turns round inside a step seems to give what its friction took on the way there.
        assert!(given_j < 1e-6 * taken_j, "{given_j} J of {taken_j} J");
        let left = work_j - taken_j - kinetic_j(&rig, layout);
        assert!(
            left.abs() < 1e-5 * turned_j,
            "{layout:?}: {left} J of {turned_j} J"
        );
        let braked = layout.brakes().len();
        assert!(
            stuck.iter().filter(|n| **n > 500).count() >= braked,
            "{stuck:?}"
        );
        assert!(slid.iter().all(|n| *n > 20_000), "{slid:?}");
    }
}

/// A quarter of the step moves the rig by less than half a count of 100 000 a turn in 3 s of sticking and sliding (measured: 9.8e-6
/// and 1.7e-5 rad).
#[test]
fn the_fine_step_is_fine_enough() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let run = |steps: u32| {
            let step_s = 1e-3 / f64::from(steps);
            let mut rig = start(layout, &[]);
            let mut worst = Vec::new();
            for k in 0..3000 * steps {
                // The current is held from one millisecond to the next.
                let sample_s = f64::from(k / steps) * 1e-3;
                rig.step(f64::from(k) * step_s, step_s, currents(sample_s), &mut push)
                    .unwrap();
                if (k + 1) % steps == 0 {
                    worst.push(rig.theta);
                }
            }
            worst
        };
        let (coarse, fine) = (run(20), run(80));
        let apart = coarse
            .iter()
            .zip(&fine)
            .map(|(a, b)| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()));
        let apart = apart.fold(0.0, f64::max);
        assert!(apart < 3e-5, "{layout:?} {apart:e} rad");
    }
}

/// A joint that sticks keeps its angle: 1e-9 rad in a second of motion about it.
#[test]
fn a_stuck_joint_stands_while_the_others_move() {
    let mut rig = start(Layout::FourBrake, &[]);
    let on = [0.0, 0.9, 0.0, 0.0];
    let hold = |time_s: f64, _: Pair, _: Pair| [3.1 * libm::sin(5.0 * time_s), 0.7];
    let mut angle = None;
    let mut moved = 0.0_f64;
    for k in 0..15_000 {
        let time_s = f64::from(k) * 1e-4;
        rig.step(time_s, 1e-4, on, &mut { hold }).unwrap();
        let [a, e, _, _] = rig.pose.joint_angles_rad(rig.theta);
        if k >= 5000 {
            assert!(rig.stuck()[1], "{time_s}");
            let (held_e, start_a) = *angle.get_or_insert((e, a));
            assert!((e - held_e).abs() < 1e-9, "{time_s} s: {:e}", e - held_e);
            moved = moved.max((a - start_a).abs());
        }
    }
    assert!(moved > 0.003, "{moved}");
}

#[test]
fn under_every_brake_and_a_push_below_their_yield_nothing_moves() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let mut rig = start(layout, &[]);
        let before = rig.theta;
        for k in 0..3000 {
            rig.step(f64::from(k) * 1e-4, 1e-4, [0.6; 4], &mut |_, _, _| {
                [0.3, -0.4]
            })
            .unwrap();
        }
        assert_eq!(rig.theta, before);
        assert_eq!(rig.rates, [0.0; 2]);
    }
}

#[test]
fn explore() {
    use crate::stratum::Stratum;
    for stratum in Stratum::ALL {
        for seed in 0..2 {
            let begun = cpu_s();
            match make::secret(seed, stratum) {
                Ok(secret) => {
                    let sizes: Vec<String> = secret
                        .sizes
                        .sizes
                        .iter()
                        .map(|s| format!("{:.1}/{:.1}/{:.1}", s.size, s.distinctness, s.strength))
                        .collect();
                    let names: Vec<String> = secret
                        .hidden
                        .iter()
                        .map(|e| format!("{}@{:?}", e.name(), e.joint))
                        .collect();
                    let left = size::left_over(&secret.setup, &secret.hidden, &secret.samples);
                    eprintln!(
                        "{} {seed} {:?} {}s noise {:.4} slide {:.2} left {:.3} {names:?} {sizes:?} {:.2} s",
                        stratum.name(),
                        secret.setup.layout,
                        secret.setup.duration_s,
                        secret.sizes.block_noise,
                        secret.sizes.sliding,
                        left,
                        cpu_s() - begun
                    );
                }
                Err(error) => {
                    eprintln!("{} {seed} {error} {:.2} s", stratum.name(), cpu_s() - begun)
                }
            }
        }
    }
}

fn cpu_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    stat.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}
