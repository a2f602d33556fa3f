//! This file says that forward and inverse kinematics undo each other and close the loop.

use proptest::prelude::*;
use rigproof_model::linkage::{Pose, forward, inverse, point_a_m, point_b_m};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

use crate::linkage::oracle::{
    Made, four_brake, from_down, is_assembled, linkages, rad, three_brake,
};

const CLOSE_RAD: f64 = 1e-10;
const CLOSED_M: f64 = 1e-12;

fn tries(usually: u32) -> ProptestConfig {
    let cases = cases(usually);
    ProptestConfig {
        cases,
        max_global_rejects: 4 * cases,
        max_local_rejects: 4 * cases,
        ..ProptestConfig::default()
    }
}

/// The greatest difference between an arm's length and the distance of the points it joins.
pub fn gap_m(arms: &Arms, pose: &Pose) -> f64 {
    [
        (point_a_m(arms), pose.point_e_m, arms.l_ae_m),
        (pose.point_e_m, pose.tip_m, arms.l_ed_m),
        (point_b_m(arms), pose.point_c_m, arms.l_bc_m),
        (pose.point_c_m, pose.tip_m, arms.l_cd_m),
    ]
    .map(|([x_1, y_1], [x_2, y_2], length)| (libm::hypot(x_2 - x_1, y_2 - y_1) - length).abs())
    .into_iter()
    .fold(0.0, f64::max)
}

pub fn distance([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> f64 {
    libm::hypot(x_2 - x_1, y_2 - y_1)
}

/// Whether a pose is the one that was made.
fn check_made(made: &Made, pose: &Pose) -> Result<(), TestCaseError> {
    for (name, found, meant) in [
        ("θA", pose.theta_a_rad, made.theta_a_rad),
        ("θE", pose.theta_e_rad, made.theta_e_rad),
        ("θB", pose.theta_b_rad, made.theta_b_rad),
        ("θC", pose.theta_c_rad, made.theta_c_rad),
        ("θD", pose.theta_d_rad, made.theta_d_rad),
    ] {
        let off = from_down(found - meant).abs();
        prop_assert!(off < CLOSE_RAD, "{name} {found} {meant}");
    }
    prop_assert!(distance(pose.tip_m, made.tip_m) < 1e-10);
    let gap = gap_m(&made.arms, pose);
    prop_assert!(gap < CLOSED_M, "closure {gap:e} m");
    Ok(())
}

fn check_there_and_back(arms: &Arms, [a, b]: [f64; 2]) -> Result<(), TestCaseError> {
    let pose = forward::pose(arms, a, b)?;
    let gap = gap_m(arms, &pose);
    prop_assert!(gap < CLOSED_M, "closure {gap:e} m");
    let back = inverse::pose(arms, pose.tip_m)?;
    for (there, back) in [
        (a, back.theta_a_rad),
        (b, back.theta_b_rad),
        (pose.theta_e_rad, back.theta_e_rad),
        (pose.theta_c_rad, back.theta_c_rad),
        (pose.theta_d_rad, back.theta_d_rad),
    ] {
        prop_assert!((there - back).abs() < CLOSE_RAD, "{there} {back}");
    }
    let again = forward::pose(arms, back.theta_a_rad, back.theta_b_rad)?;
    let off = distance(again.tip_m, pose.tip_m);
    prop_assert!(off < CLOSED_M, "tip off by {off:e} m");
    Ok(())
}

proptest! {
    #![proptest_config(tries(100_000))]

    #[test]
    fn random_linkages_have_the_pose_they_were_made_with(made in linkages()) {
        prop_assume!(is_assembled(&made));
        let back = inverse::pose(&made.arms, made.tip_m)?;
        check_made(&made, &back)?;
        check_made(&made, &forward::pose(&made.arms, made.theta_a_rad, made.theta_b_rad)?)?;
        let again = forward::pose(&made.arms, back.theta_a_rad, back.theta_b_rad)?;
        prop_assert!(distance(again.tip_m, made.tip_m) < 1e-10);
    }

    #[test]
    fn the_three_brake_layout_goes_there_and_back(base in three_brake()) {
        check_there_and_back(&arms(Layout::ThreeBrake), base)?;
    }

    #[test]
    fn the_four_brake_layout_goes_there_and_back(base in four_brake()) {
        check_there_and_back(&arms(Layout::FourBrake), base)?;
    }
}

#[test]
fn the_corners_of_the_three_brake_layout_go_there_and_back() {
    let arms = arms(Layout::ThreeBrake);
    for [a, b] in [[10.0, 0.0], [170.0, 0.0], [180.0, 10.0], [180.0, 170.0]] {
        check_there_and_back(&arms, [rad(a), rad(b)]).unwrap();
    }
}
