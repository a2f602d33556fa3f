//! This file says that the brake of blind recordings is the brake of the nominal model: two programs, one set of
//! decisions (0001 to 0006), so that a recording with nothing hidden shows nothing.

use crate::budget::assert_within_budget;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_blind::{BrakeStep, brake_yield_nm};
use rigproof_model::brake::{Brake, torque_gain};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::backlash_width_deg;
use rigproof_spec::units::{rad_from_deg, rad_s_from_rpm, rpm_from_rad_s};
use std::f64::consts::TAU;

/// Where every shaft starts, rad.
const START_RAD: f64 = 0.731;

/// How far apart the two torques are at the end of every step, N·m.
fn disagreements_nm(joint: Joint, steps: &[BrakeStep]) -> Vec<f64> {
    let yields_nm = brake_yield_nm(joint, START_RAD, steps);
    assert_eq!(yields_nm.len(), steps.len());
    let mut model = Brake::new(joint, START_RAD);
    steps
        .iter()
        .zip(yields_nm)
        .map(|(step, yield_nm)| {
            let torque_nm = model.step(
                step.current_a,
                step.position_rad,
                step.speed_rad_s,
                step.step_s,
            );
            if step.speed_rad_s == 0.0 {
                (model.yield_torque() - yield_nm).abs()
            } else {
                (torque_nm - step.speed_rad_s.signum() * yield_nm).abs()
            }
        })
        .collect()
}

/// A stretch of constant current and speed: currents around every edge of the fits and beyond, speeds from creeping
/// to beyond the fastest tested, standstill and both directions.
fn stretch() -> impl Strategy<Value = (f64, f64, f64)> {
    let current_a = prop_oneof![0.003..0.997_f64, 0.19..0.21, -0.3..1.4, Just(0.0)];
    let speed_rad_s = prop_oneof![1e-9..0.05_f64, 0.05..0.5, 0.5..7.1, Just(0.0)];
    (current_a, speed_rad_s, any::<bool>(), 0.0013..0.071).prop_map(
        |(current_a, speed_rad_s, backward, duration_s)| {
            let direction = if backward { -1.0 } else { 1.0 };
            (current_a, direction * speed_rad_s, duration_s)
        },
    )
}

#[test]
fn both_brakes_agree_on_any_history() {
    let histories = prop::collection::vec(stretch(), 3..40);
    let joints = prop::sample::select(Joint::ALL.to_vec());
    let mut runner = TestRunner::deterministic();
    let mut apart_nm = Vec::new();
    for _ in 0..600 {
        let (joint, history) = (&joints, &histories)
            .new_tree(&mut runner)
            .unwrap()
            .current();
        let mut position_rad = START_RAD;
        let mut steps = Vec::new();
        for (current_a, speed_rad_s, duration_s) in history {
            let step_s = duration_s / 13.0;
            for _ in 0..13 {
                position_rad += speed_rad_s * step_s;
                steps.push(BrakeStep {
                    step_s,
                    current_a,
                    position_rad,
                    speed_rad_s,
                });
            }
        }
        apart_nm.extend(disagreements_nm(joint, &steps));
    }
    assert_within_budget("brake_model_against_blind", apart_nm);
}

/// What the bench has to show in a motion, so that agreement means something.
#[derive(Debug, Default, PartialEq)]
struct Shown {
    rises: bool,
    falls: bool,
    decays_into_backlash: bool,
    leaves_backlash_forward: bool,
    leaves_backlash_backward: bool,
    below_half_rpm_in_motion: bool,
    above_4_rpm: bool,
}

/// Ten seconds of a sine, 20 000 steps a second, under a current that goes up and down in steps.
fn bench_steps(peak_speed_rpm: f64, frequency_hz: f64) -> Vec<BrakeStep> {
    const LEVELS_A: [f64; 12] = [
        0.0, 0.83, 0.07, 0.31, 0.2, 0.94, 1.0, 0.62, 0.19, 0.47, 0.21, 0.71,
    ];
    const STEP_S: f64 = 5e-5;
    let omega = TAU * frequency_hz;
    let peak_rad_s = rad_s_from_rpm(peak_speed_rpm);
    (1..=200_000)
        .map(|k| {
            let time_s = STEP_S * f64::from(k);
            let (sine, cosine) = libm::sincos(omega * time_s);
            BrakeStep {
                step_s: STEP_S,
                // 0.237 s a level; 3 ms into each the current moves again, before the torque has settled.
                current_a: LEVELS_A[(time_s / 0.237) as usize % 12]
                    - if time_s % 0.237 < 0.003 { 0.04 } else { 0.0 },
                position_rad: START_RAD + peak_rad_s / omega * sine,
                speed_rad_s: peak_rad_s * cosine,
            }
        })
        .collect()
}

fn shown(joint: Joint, steps: &[BrakeStep]) -> Shown {
    let mut model = Brake::new(joint, START_RAD);
    let mut shown = Shown::default();
    for step in steps {
        let (before_nm, was_inside) = (model.yield_torque(), model.backlash().is_inside());
        model.step(
            step.current_a,
            step.position_rad,
            step.speed_rad_s,
            step.step_s,
        );
        let (change_nm, inside) = (
            model.yield_torque() - before_nm,
            model.backlash().is_inside(),
        );
        let left = was_inside && !inside;
        let rpm = rpm_from_rad_s(step.speed_rad_s);
        shown.rises |= change_nm > 1e-4;
        shown.falls |= change_nm < -1e-4 && !inside;
        shown.decays_into_backlash |= change_nm < -1e-4 && inside;
        shown.leaves_backlash_forward |= left && rpm > 0.0;
        shown.leaves_backlash_backward |= left && rpm < 0.0;
        shown.below_half_rpm_in_motion |= rpm != 0.0 && rpm.abs() < 0.5 && change_nm.abs() > 1e-4;
        shown.above_4_rpm |= rpm.abs() > 4.0;
    }
    shown
}

#[test]
fn both_brakes_agree_on_bench_motion() {
    let mut apart_nm = Vec::new();
    for joint in Joint::ALL {
        let has_backlash = joint != Joint::A;
        // Turning at up to 16 rpm, and creeping at 0.47 rpm at most through 13.4°, more than any backlash.
        for (peak_rpm, frequency_hz) in [(16.3, 0.41), (0.47, 0.067)] {
            let steps = bench_steps(peak_rpm, frequency_hz);
            let expected = Shown {
                rises: true,
                falls: true,
                decays_into_backlash: has_backlash,
                leaves_backlash_forward: has_backlash,
                leaves_backlash_backward: has_backlash,
                below_half_rpm_in_motion: true,
                above_4_rpm: peak_rpm > 4.0,
            };
            assert_eq!(shown(joint, &steps), expected, "{joint:?} {peak_rpm} rpm");
            apart_nm.extend(disagreements_nm(joint, &steps));
        }
    }
    assert_within_budget("brake_model_against_blind", apart_nm);
}

#[test]
fn both_brakes_start_in_the_middle_of_the_backlash_without_current() {
    for joint in [Joint::E, Joint::B, Joint::C] {
        for direction in [1.0, -1.0] {
            // Just short of half the width, nearer to the boundary than a shaft has to be for an entry, and just beyond.
            let half_deg = 0.5 * backlash_width_deg(joint);
            for (travel_deg, settled_nm) in [
                (half_deg - 0.013, torque_gain(joint, 0.0)),
                (half_deg + 0.013, torque_gain(joint, 0.83)),
            ] {
                let steps = [BrakeStep {
                    step_s: 9.7,
                    current_a: 0.83,
                    position_rad: START_RAD + direction * rad_from_deg(travel_deg),
                    speed_rad_s: direction * 2.3,
                }];
                let [yield_nm] = brake_yield_nm(joint, START_RAD, &steps)[..] else {
                    panic!("one step has one torque");
                };
                let at_deg = direction * travel_deg;
                assert!((yield_nm - settled_nm).abs() < 1e-9, "{joint:?} {at_deg}°");
                assert!(disagreements_nm(joint, &steps)[0] < 1e-12);
            }
        }
    }
}
