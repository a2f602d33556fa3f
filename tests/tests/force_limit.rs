//! This file says how strong the brakes are at the tip, where the thesis's 19.5 N and 22.0 N come from, and what a current
//! buys.

use core::f64::consts::PI;

use nalgebra::{Vector2, Vector4};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use rigproof_model::brake::{current_gain, torque_gain};
use rigproof_model::control::force_angle::{force_angle, opposing_force, path_angles};
use rigproof_model::control::force_limit::{
    force_from_elbow, force_magnitude, greatest_common_force, least_force, tip_force,
};
use rigproof_model::linkage::{Pose, forward, inverse, jacobian::jacobian};
use rigproof_spec::geometry::{AngleRange, Arms, angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{desired_force, opposition};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_spec::tables::{brake_table, torque_gain_fit};
use rigproof_tests::cases;

const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];

fn layout() -> impl Strategy<Value = Layout> {
    prop::sample::select(LAYOUTS.to_vec())
}

/// A pose inside the ranges of table 4.2.
fn pose() -> impl Strategy<Value = (Arms, Pose)> {
    (layout(), 0.18..3.13_f64, 0.0..2.96_f64).prop_filter_map(
        "inside table 4.2",
        |(layout, a, b)| {
            let (arms, ranges) = (arms(layout), angle_ranges(layout));
            let pose = forward::pose(&arms, a, b).ok()?;
            rigproof_model::linkage::limits::check(&ranges, &pose).ok()?;
            Some((arms, pose))
        },
    )
}

fn elbow(pose: &Pose, joint: Joint) -> f64 {
    match joint {
        Joint::A | Joint::E => pose.theta_e_rad,
        Joint::B | Joint::C => pose.theta_c_rad,
    }
}

fn row(arms: &Arms, pose: &Pose, joint: Joint) -> Vector2<f64> {
    let index = Joint::ALL.iter().position(|other| *other == joint).unwrap();
    jacobian(arms, pose).unwrap().row(index).transpose()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(2_000),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    //= thesis (6.1) test
    //= thesis (6.2) test
    #[test]
    fn tip_force_and_joint_torques_do_the_same_work(
        (arms, pose) in pose(), torques in [-7.1..7.3_f64, -5.3..5.9, -6.1..5.7, -5.7..5.3],
        direction in -3.1..3.1_f64,
    ) {
        // Work over a small displacement, the joints from the inverse kinematics on both sides of the pose.
        let step_m = 2e-6;
        let (sine, cosine) = libm::sincos(direction);
        let [x, y] = pose.tip_m;
        let at = |way: f64| inverse::pose(&arms, [x + way * cosine, y + way * sine]).unwrap();
        let (before, after) = (at(-step_m), at(step_m));
        let turned = [
            after.theta_a_rad - before.theta_a_rad,
            after.theta_e_rad - before.theta_e_rad,
            after.theta_b_rad - before.theta_b_rad,
            after.theta_c_rad - before.theta_c_rad,
        ];
        let joints_j: f64 = torques.iter().zip(turned).map(|(torque, turned)| torque * turned).sum();
        let force_n = tip_force(&jacobian(&arms, &pose).unwrap(), &Vector4::from(torques));
        let tip_j = 2.0 * step_m * (force_n.x * cosine + force_n.y * sine);
        let scale_j = 2.0 * step_m * libm::hypot(force_n.x, force_n.y).max(70.0);
        prop_assert!((joints_j - tip_j).abs() < 2e-7 * scale_j, "{joints_j} J against {tip_j} J");
    }

    //= thesis (6.3) test
    //= thesis (6.4) test
    //= thesis (6.5) test
    //= thesis (6.6) test
    //= thesis (6.7) test
    #[test]
    fn force_from_the_elbow_is_the_length_of_the_jacobian_row(
        (arms, pose) in pose(), joint in prop::sample::select(Joint::ALL.to_vec()), torque_nm in -7.3..7.1_f64,
    ) {
        let from_row_n = force_magnitude(row(&arms, &pose, joint), torque_nm);
        let from_elbow_n = force_from_elbow(&arms, joint, elbow(&pose, joint), torque_nm);
        prop_assert!((from_row_n - from_elbow_n).abs() <= 1e-10 * from_row_n);
        let mut torques = Vector4::zeros();
        torques[Joint::ALL.iter().position(|other| *other == joint).unwrap()] = torque_nm;
        let force_n = tip_force(&jacobian(&arms, &pose).unwrap(), &torques);
        prop_assert!((libm::hypot(force_n.x, force_n.y) - from_row_n).abs() <= 1e-12 * from_row_n);
    }

    #[test]
    fn printed_force_magnitudes_of_e_and_b_are_negative((arms, pose) in pose()) {
        let right = PI / 2.0;
        let across = |inner: f64, outer: f64, angle: f64| {
            libm::sqrt(outer * outer + inner * inner + 2.0 * outer * inner * libm::cos(angle))
        };
        let (e, c, b) = (pose.theta_e_rad, pose.theta_c_rad, pose.theta_b_rad);
        let printed_a = 1.0 / (arms.l_ae_m * libm::cos(e + right));
        let printed_e = across(arms.l_ae_m, arms.l_ed_m, e) / (arms.l_ed_m * arms.l_ae_m * libm::sin(e));
        let meant_b = 1.0 / (arms.l_bc_m * libm::cos(c + right));
        let printed_c = across(arms.l_bc_m, arms.l_cd_m, c) / (arms.l_cd_m * arms.l_bc_m * libm::sin(c));
        prop_assert!(printed_a > 0.0 && printed_c > 0.0 && printed_e < 0.0 && meant_b < 0.0);
        let lengths = Joint::ALL.map(|joint| force_magnitude(row(&arms, &pose, joint), 1.0));
        for (printed, length) in [printed_a, printed_e, meant_b, printed_c].into_iter().zip(lengths) {
            prop_assert!((printed.abs() - length).abs() <= 1e-10 * length);
        }
        // With θB as printed, (6.6) is negative too, and wrong wherever θB and θC have different sines.
        let printed_b = 1.0 / (arms.l_bc_m * libm::cos(b + right));
        prop_assert!(printed_b <= 0.0);
        if (libm::sin(b) - libm::sin(c)).abs() > 1e-3 {
            prop_assert!((printed_b.abs() / lengths[2] - 1.0).abs() > 9e-4);
        }
    }

    //= thesis (6.9) test
    //= thesis (6.10) test
    #[test]
    fn a_locked_joint_leaves_its_local_path((arms, pose) in pose(), joint in prop::sample::select(Joint::ALL.to_vec())) {
        let j_i = row(&arms, &pose, joint);
        let force_rad = force_angle(j_i);
        let turn = libm::sin(force_rad) * j_i.x - libm::cos(force_rad) * j_i.y;
        prop_assert!(turn.abs() < 1e-12 * libm::hypot(j_i.x, j_i.y));
        // Along its local path the joint does not turn: to second order in the step.
        for path_rad in path_angles(j_i) {
            let step_m = 1e-5;
            let [x, y] = pose.tip_m;
            let (sine, cosine) = libm::sincos(path_rad);
            let moved = |way: f64| inverse::pose(&arms, [x + way * cosine, y + way * sine]).unwrap();
            let angle = |pose: &Pose| match joint {
                Joint::A => pose.theta_a_rad,
                Joint::E => pose.theta_e_rad,
                Joint::B => pose.theta_b_rad,
                Joint::C => pose.theta_c_rad,
            };
            let turned = angle(&moved(step_m)) - angle(&moved(-step_m));
            prop_assert!(turned.abs() < 1e-8, "joint {} turns {turned} rad", joint.letter());
        }
    }

    //= thesis (6.11) test
    #[test]
    fn the_force_of_a_brake_opposes_the_tip(
        (arms, pose) in pose(), joint in prop::sample::select(Joint::ALL.to_vec()),
        velocity in [-0.31..0.37_f64, -0.41..0.29],
    ) {
        let j_i = row(&arms, &pose, joint);
        let v = Vector2::from(velocity);
        // F_i·v of unit torque is the joint's speed: the rule is its sign.
        let omega = j_i.dot(&v);
        match opposing_force(j_i, v) {
            Some(force_n) => {
                prop_assert!(opposition(force_n.into(), velocity).holds());
                prop_assert_eq!(force_n, if omega < 0.0 { j_i } else { -j_i });
            }
            None => prop_assert!(omega.abs() <= 1.001e-4 * j_i.norm() * v.norm()),
        }
    }

    #[test]
    fn current_gain_inverts_the_torque_gain(
        joint in prop::sample::select(Joint::ALL.to_vec()), share in 0.0..1.0_f64,
    ) {
        let fit = torque_gain_fit(joint);
        let torque_nm = fit.off_state_nm() + share * (fit.greatest_nm() - fit.off_state_nm());
        let current_a = current_gain(&brake_table(joint), torque_nm);
        prop_assert!((0.0..=1.0).contains(&current_a));
        prop_assert!((torque_gain(joint, current_a) - torque_nm).abs() < 1e-12);
        let more = current_gain(&brake_table(joint), torque_nm + 1e-3);
        prop_assert!(more >= current_a, "more torque takes no less current");
    }
}

#[test]
fn the_printed_arctangent_gives_the_opposite_force_in_two_thirds_of_the_poses() {
    // (6.9) with the printed quotient, for a joint whose F·v is negative: the force must oppose the velocity.
    let (mut wrong, mut all) = (0, 0);
    for layout in LAYOUTS {
        let arms = arms(layout);
        for k in 0..4000 {
            let (a, b) = (
                0.2 + 2.9 * f64::from(k % 61) / 61.0,
                2.9 * f64::from(k / 61) / 66.0,
            );
            let Ok(pose) = forward::pose(&arms, a, b) else {
                continue;
            };
            if rigproof_model::linkage::limits::check(&angle_ranges(layout), &pose).is_err() {
                continue;
            }
            for joint in layout.brakes() {
                let j_i = row(&arms, &pose, *joint);
                // A velocity that the positive force opposes.
                let velocity = [-j_i.x, -j_i.y];
                let angle = libm::atan(j_i.y / j_i.x);
                all += 1;
                wrong +=
                    i32::from(!opposition([libm::cos(angle), libm::sin(angle)], velocity).holds());
            }
        }
    }
    let share = f64::from(wrong) / f64::from(all);
    // 7359 of 11234.
    assert!((share - 0.655).abs() < 0.005, "{share}");
}

//= thesis (6.8) test
#[test]
fn nineteen_and_a_half_and_twenty_two_newtons_follow_from_the_joint_ranges() {
    // By hand: brake E at 190°, 5.94/(0.305·sin 95°); brake C where cos θC = -0.264/0.305, 5.88/0.264.
    for (layout, by_hand_n, printed_n) in [
        (
            Layout::ThreeBrake,
            5.94 / (0.305 * libm::sin(PI * 95.0 / 180.0)),
            19.5,
        ),
        (Layout::FourBrake, 5.88 / 0.264, 22.0),
    ] {
        let ours_n = greatest_common_force(layout);
        assert!((ours_n - by_hand_n).abs() < 1e-12, "{ours_n} N");
        assert_eq!(greatest_desired_force_n(layout), printed_n);
        assert!(desired_force(layout, printed_n).holds() && printed_n < ours_n);
    }
    assert!((greatest_common_force(Layout::ThreeBrake) - 19.55).abs() < 0.005);
    assert!((greatest_common_force(Layout::FourBrake) - 22.27).abs() < 0.005);
    // With a brake at C the 3-brake layout would have 19.35 N: the thesis did not count it.
    let three = arms(Layout::ThreeBrake);
    let c_n = least_force(&three, Joint::C, AngleRange::new(10.0, 170.0));
    assert!((c_n - 19.35).abs() < 0.005, "{c_n} N");
}

#[test]
fn no_elbow_angle_gives_less_than_the_least_force() {
    for layout in LAYOUTS {
        let (arms, ranges) = (arms(layout), angle_ranges(layout));
        for joint in Joint::ALL {
            let range = if matches!(joint, Joint::A | Joint::E) {
                ranges.e
            } else {
                ranges.c
            };
            let torque_nm = torque_gain_fit(joint).greatest_nm();
            let swept_n = (0..=20_000)
                .map(|k| {
                    range.least_deg
                        + (range.greatest_deg - range.least_deg) * f64::from(k) / 20_000.0
                })
                .map(|deg| force_from_elbow(&arms, joint, PI * deg / 180.0, torque_nm))
                .fold(f64::INFINITY, f64::min);
            let ours_n = least_force(&arms, joint, range);
            assert!(
                ours_n <= swept_n * (1.0 + 1e-12) && ours_n > swept_n - 1e-5,
                "{ours_n} {swept_n}"
            );
        }
    }
}

#[test]
fn the_smaller_of_two_currents_is_taken_just_below_200_milliampere() {
    for joint in Joint::ALL {
        let upper_nm = torque_gain(joint, 0.2_f64.next_down());
        let lower_nm = torque_gain(joint, 0.2);
        for share in [0.13, 0.57, 0.91] {
            let torque_nm = lower_nm + share * (upper_nm - lower_nm);
            let current_a = current_gain(&brake_table(joint), torque_nm);
            assert!(current_a < 0.2, "{}: {current_a} A", joint.letter());
            // The other answer, above 0.2 A, gives the same torque.
            let (mut low, mut high) = (0.2, 0.3);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if torque_gain(joint, middle) < torque_nm {
                    low = middle
                } else {
                    high = middle
                }
            }
            assert!(high > 0.2 && (torque_gain(joint, high) - torque_nm).abs() < 1e-12);
        }
    }
}

#[test]
fn torques_beyond_the_brake_get_the_nearest_current_and_undefined_ones_none() {
    for joint in Joint::ALL {
        let fit = torque_gain_fit(joint);
        assert_eq!(
            current_gain(&brake_table(joint), fit.off_state_nm() - 0.013),
            0.0
        );
        assert_eq!(current_gain(&brake_table(joint), -3.7), 0.0);
        assert_eq!(
            current_gain(&brake_table(joint), fit.greatest_nm() + 0.013),
            1.0
        );
        assert_eq!(current_gain(&brake_table(joint), f64::INFINITY), 1.0);
        assert_eq!(current_gain(&brake_table(joint), f64::NAN), 0.0);
    }
}
