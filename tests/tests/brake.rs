//! This file says what holds for a brake under every current and motion, and checks it against hand calculation.

use crate::budget::assert_within_budget;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{FileFailurePersistence, TestRunner};
use rigproof_model::brake::{Backlash, Brake, ENTRY_TRAVEL_DEG, time_constant, torque_gain};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{current_limit, dissipation, torque_limit, yield_limit};
use rigproof_spec::tables::{Edge, backlash_width_deg};
use rigproof_spec::units::{rad_from_deg, rad_s_from_rpm};

/// One stretch of a history: current, speed and how long both hold.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    current_a: f64,
    omega_rad_s: f64,
    duration_s: f64,
}

fn joint() -> impl Strategy<Value = Joint> {
    prop::sample::select(Joint::ALL.to_vec())
}

/// Currents at the ends and between; speeds from creeping to the fastest of the thesis, and standstill.
fn stretch() -> impl Strategy<Value = Stretch> {
    let current_a = prop_oneof![0.003..0.997_f64, 0.197..0.203, Just(0.0), Just(1.0)];
    let speed_rad_s = prop_oneof![1e-9..0.05_f64, 0.05..0.5, 0.5..6.7, Just(0.0)];
    (current_a, speed_rad_s, any::<bool>(), 0.0013..0.071).prop_map(
        |(current_a, speed_rad_s, backward, duration_s)| Stretch {
            current_a,
            omega_rad_s: if backward { -speed_rad_s } else { speed_rad_s },
            duration_s,
        },
    )
}

fn history() -> impl Strategy<Value = Vec<Stretch>> {
    prop::collection::vec(stretch(), 1..23)
}

/// Runs a history in steps that divide each stretch into `divisions`, and hands every step to `see`.
fn run(
    joint: Joint,
    history: &[Stretch],
    divisions: u32,
    mut see: impl FnMut(&Brake, Stretch, f64),
) {
    let mut theta_rad = 0.731;
    let mut brake = Brake::new(joint, theta_rad);
    for &stretch in history {
        let start_rad = theta_rad;
        let dt_s = stretch.duration_s / f64::from(divisions);
        for step in 1..=divisions {
            theta_rad = start_rad + stretch.omega_rad_s * dt_s * f64::from(step);
            let resistance_nm = brake.step(stretch.current_a, theta_rad, stretch.omega_rad_s, dt_s);
            see(&brake, stretch, resistance_nm);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn brake_power_is_never_positive(joint in joint(), history in history()) {
        run(joint, &history, 17, |_, stretch, resistance_nm| {
            assert!(current_limit(stretch.current_a).holds());
            let power = dissipation(-resistance_nm, stretch.omega_rad_s);
            assert!(power.holds(), "{stretch:?}: {resistance_nm} N·m drives the shaft");
        });
    }

    #[test]
    fn torque_stays_within_its_limits(joint in joint(), history in history()) {
        run(joint, &history, 17, |brake, stretch, resistance_nm| {
            assert!(yield_limit(joint, brake.yield_torque()).holds(), "{brake:?}");
            assert!(torque_limit(joint, resistance_nm).holds(), "{resistance_nm} N·m");
            let magnitude_nm = if stretch.omega_rad_s == 0.0 { 0.0 } else { brake.yield_torque() };
            assert_eq!(resistance_nm.abs(), magnitude_nm);
        });
    }

    #[test]
    fn limits_hold_for_currents_the_amplifier_cannot_give(
        joint in joint(), current_a in -7.3..9.1, omega_rad_s in 0.003..6.7, steps in 1_u32..90,
    ) {
        let history = [Stretch { current_a, omega_rad_s, duration_s: 0.37 }];
        run(joint, &history, steps, |brake, _, _| {
            assert!(yield_limit(joint, brake.yield_torque()).holds(), "{brake:?}");
        });
    }

    //= thesis (3.2) test
    #[test]
    fn a_current_step_follows_the_exponential(
        joint in joint(), first_a in 0.21..0.99, second_a in 0.21..0.99,
        omega_rpm in 0.52..63.0, elapsed_s in 0.0007..0.09_f64, steps in 1_u32..60,
    ) {
        let omega_rad_s = rad_s_from_rpm(omega_rpm);
        let mut brake = Brake::new(joint, -0.417);
        brake.step(first_a, 0.351, omega_rad_s, 11.3);
        let initial_nm = brake.yield_torque();
        for step in 1..=steps {
            let dt_s = elapsed_s / f64::from(steps);
            brake.step(second_a, 0.351 + omega_rad_s * dt_s * f64::from(step), omega_rad_s, dt_s);
        }
        let final_nm = torque_gain(joint, second_a);
        prop_assume!((initial_nm - final_nm).abs() > 0.013);
        let a_s = if final_nm > initial_nm {
            time_constant(joint, second_a, omega_rad_s, Edge::Rising)
        } else {
            time_constant(joint, first_a, omega_rad_s, Edge::Falling)
        };
        let expected_nm = final_nm + (initial_nm - final_nm) * libm::exp(-elapsed_s / a_s);
        // The end of a fall, within 5 mN·m of its target, takes the time constant of the new current.
        let budget_nm = if final_nm > initial_nm { 1e-11 } else { 0.005 };
        prop_assert!((brake.yield_torque() - expected_nm).abs() < budget_nm);
    }

    #[test]
    fn backlash_keeps_its_width_and_holds_the_shaft_between_its_boundaries(
        joint in joint(), travels_deg in prop::collection::vec(-2.3..2.3, 1..70),
    ) {
        let width_rad = rad_from_deg(backlash_width_deg(joint));
        let entry_rad = rad_from_deg(ENTRY_TRAVEL_DEG);
        let mut theta_rad = -1.213;
        let mut backlash = Backlash::new(joint, theta_rad);
        for travel_deg in travels_deg {
            let before = backlash;
            theta_rad += rad_from_deg(travel_deg);
            let inside = backlash.update(theta_rad);
            let (theta_1_rad, theta_2_rad) = backlash.boundaries_rad();
            prop_assert!((theta_2_rad - theta_1_rad - width_rad).abs() < 1e-12);
            prop_assert!(theta_1_rad - 1e-12 <= theta_rad && theta_rad <= theta_2_rad + 1e-12);
            let to_boundary_rad = (theta_rad - theta_1_rad).min(theta_2_rad - theta_rad);
            if to_boundary_rad > entry_rad {
                prop_assert!(inside);
            }
            if inside {
                prop_assert_eq!(backlash.boundaries_rad(), before.boundaries_rad());
            } else if to_boundary_rad < 1e-12 {
                let (old_1, old_2) = before.boundaries_rad();
                prop_assert!(theta_rad <= old_1 || theta_rad >= old_2);
            }
        }
    }

    #[test]
    fn a_long_reverse_travel_meets_off_state_torque_until_the_width_is_used(
        joint in prop::sample::select(vec![Joint::E, Joint::B, Joint::C]),
        current_a in 0.23..0.97, omega_rad_s in 0.05..0.2, share in 0.55..0.97,
    ) {
        let width_rad = rad_from_deg(backlash_width_deg(joint));
        let mut brake = Brake::new(joint, 0.277);
        brake.step(current_a, 0.341, omega_rad_s, 13.7);
        let mut theta_rad = 0.341;
        let mut steps_inside = 0;
        while 0.341 - theta_rad < width_rad * share {
            theta_rad -= omega_rad_s * 0.0011;
            brake.step(current_a, theta_rad, -omega_rad_s, 0.0011);
            steps_inside += i32::from(brake.backlash().is_inside());
        }
        prop_assert!(brake.backlash().is_inside());
        // 11.3 ms is the greatest falling time constant of table 3.3, 7.6 N·m more than any yield.
        let remaining = libm::exp(-0.0011 * f64::from(steps_inside) / 0.0113);
        prop_assert!(brake.yield_torque() - torque_gain(joint, 0.0) < 7.6 * remaining + 1e-12);
        brake.step(current_a, 0.341 - width_rad * 1.013, -omega_rad_s, 13.7);
        prop_assert!(!brake.backlash().is_inside());
        prop_assert!((brake.yield_torque() - torque_gain(joint, current_a)).abs() < 1e-9);
    }

    #[test]
    fn time_constants_do_not_depend_on_the_direction(
        joint in joint(), current_a in 0.2..1.0, omega_rad_s in 0.053..6.7,
        edge in prop::sample::select(Edge::ALL.to_vec()),
    ) {
        let forward = time_constant(joint, current_a, omega_rad_s, edge);
        prop_assert!(forward.is_finite());
        prop_assert_eq!(forward, time_constant(joint, current_a, -omega_rad_s, edge));
    }

    #[test]
    fn the_settled_torque_forgets_the_current_history(
        joint in joint(), history in history(), current_a in 0.0..1.0, omega_rad_s in 0.06..6.7,
    ) {
        let mut brake = Brake::new(joint, 0.731);
        for stretch in history {
            brake.step(stretch.current_a, 0.731, stretch.omega_rad_s, stretch.duration_s);
        }
        brake.step(current_a, 0.823, omega_rad_s, 17.3);
        prop_assert!((brake.yield_torque() - torque_gain(joint, current_a)).abs() < 1e-9);
    }

    #[test]
    fn the_settled_torque_is_the_same_before_and_after_a_reversal(
        joint in joint(), current_a in 0.0..1.0, omega_rad_s in 0.06..6.7,
    ) {
        let mut brake = Brake::new(joint, 0.731);
        let before_nm = brake.step(current_a, 0.823, omega_rad_s, 17.3);
        let after_nm = brake.step(current_a, 0.719, -omega_rad_s, 17.3);
        prop_assert!((before_nm + after_nm).abs() < 1e-9);
    }
}

#[test]
fn a_step_of_brake_b_matches_the_tables_by_hand() {
    // K(0.57) = -2.14*0.57² + 8.76*0.57 - 0.49 = 3.807914 N·m, 7.5 ms above 4 rpm.
    let mut brake = Brake::new(Joint::B, 0.113);
    let resistance_nm = brake.step(0.57, 0.149, 0.83, 0.012);
    // 0.24 + (3.807914 - 0.24)*(1 - e^-1.6), e^-1.6 = 0.201896518
    assert!(
        (resistance_nm - 3.087_565_5).abs() < 1e-6,
        "{resistance_nm} N·m"
    );
}

#[test]
fn a_filtered_signed_torque_drives_the_shaft_after_a_reversal() {
    // Brake A has no backlash: 0.8 A, 7.5 ms, reversed at t = 0 from +6.4448 to -6.4448 N·m.
    let (gain_nm, a_s, dt_s, omega_rad_s) = (6.4448, 0.0075, 1e-5, -1.7);
    let mut signed_nm = gain_nm;
    let mut driving_s = 0.0;
    let mut brake = Brake::new(Joint::A, 0.41);
    brake.step(0.8, 0.47, -omega_rad_s, 9.1);
    for step in 1..=4000 {
        signed_nm += (-gain_nm - signed_nm) * -libm::expm1(-dt_s / a_s);
        if !dissipation(-signed_nm, omega_rad_s).holds() {
            driving_s += dt_s;
        }
        let theta_rad = 0.47 + omega_rad_s * dt_s * f64::from(step);
        let resistance_nm = brake.step(0.8, theta_rad, omega_rad_s, dt_s);
        assert!(dissipation(-resistance_nm, omega_rad_s).holds());
    }
    assert!((driving_s - 0.0052_f64).abs() < 2e-5, "{driving_s} s");
}

/// Yield torques at the ends of every stretch, at two step sizes.
fn disagreements_nm(
    divisions: (u32, u32),
    cases: u32,
    histories: impl Strategy<Value = Vec<Stretch>>,
) -> Vec<f64> {
    let mut runner = TestRunner::deterministic();
    let mut disagreements_nm = Vec::new();
    for _ in 0..cases {
        let (joint, history) = (joint(), &histories)
            .new_tree(&mut runner)
            .unwrap()
            .current();
        let ends = |divisions| {
            let mut yields_nm = Vec::new();
            run(joint, &history, divisions, |brake, _, _| {
                yields_nm.push(brake.yield_torque())
            });
            yields_nm
                .into_iter()
                .skip(divisions as usize - 1)
                .step_by(divisions as usize)
                .collect::<Vec<f64>>()
        };
        let (coarse, fine) = (ends(divisions.0), ends(divisions.1));
        assert_eq!(coarse.len(), history.len());
        disagreements_nm.extend(coarse.iter().zip(&fine).map(|(c, f)| (c - f).abs()));
    }
    disagreements_nm
}

#[test]
fn step_size_does_not_matter_in_constant_motion() {
    let forward = prop::collection::vec(stretch(), 3..17).prop_map(|mut history| {
        // A first second leaves the backlash at a time that depends on the step, and forgets it.
        let clear = Stretch {
            current_a: 0.37,
            omega_rad_s: 2.9,
            duration_s: 0.97,
        };
        history.insert(0, clear);
        for stretch in &mut history {
            stretch.omega_rad_s = clear.omega_rad_s;
        }
        history
    });
    assert_within_budget(
        "brake_step_size_constant_motion",
        disagreements_nm((7, 64), 300, forward),
    );
}

#[test]
fn step_size_matters_little_in_reversing_motion() {
    assert_within_budget(
        "brake_step_size_reversing_motion",
        disagreements_nm((400, 800), 300, history()),
    );
}
