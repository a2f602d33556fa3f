//! This file says that the Jacobian is the derivative of the joint angles, and that it balances power and virtual work.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2, Vector4};
use proptest::prelude::*;
use rigproof_model::linkage::jacobian::{from_a_and_e, from_b_and_c, jacobian};
use rigproof_model::linkage::singularity::{base_jacobian, j_theta, j_x};
use rigproof_model::linkage::{Pose, forward, inverse, point_a_m, point_b_m};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

use crate::linkage::oracle::{Made, four_brake, is_assembled, linkages, moved, rad, three_brake};

const SAME: f64 = 1e-9;
const BALANCED: f64 = 1e-12;

type Rows = SMatrix<f64, 4, 2>;

/// The Jacobian from complex steps of the base angles: rows A, E, B, C.
pub fn complex_step(arms: &Arms, base: [f64; 2]) -> Rows {
    let (along_a, along_b) = (moved(arms, base, [1.0, 0.0]), moved(arms, base, [0.0, 1.0]));
    let tip_by_base = Matrix2::new(
        along_a.tip[0].im,
        along_b.tip[0].im,
        along_a.tip[1].im,
        along_b.tip[1].im,
    );
    let by_base = Rows::new(
        1.0,
        0.0,
        along_a.theta_e_rate,
        along_b.theta_e_rate,
        0.0,
        1.0,
        along_a.theta_c_rate,
        along_b.theta_c_rate,
    );
    by_base * tip_by_base.try_inverse().unwrap()
}

fn angles(pose: &Pose) -> Vector4<f64> {
    Vector4::new(
        pose.theta_a_rad,
        pose.theta_e_rad,
        pose.theta_b_rad,
        pose.theta_c_rad,
    )
}

/// The Jacobian from central differences of fourth order of the inverse kinematics.
pub fn central(arms: &Arms, [x, y]: [f64; 2], step_m: f64) -> Rows {
    let here = angles(&inverse::pose(arms, [x, y]).unwrap());
    // The base angles jump by a turn where they are cut.
    let turn = 2.0 * core::f64::consts::PI;
    let at = |dx: f64, dy: f64| {
        let there = angles(&inverse::pose(arms, [x + dx, y + dy]).unwrap());
        (there - here).map(|angle| angle - turn * (angle / turn).round())
    };
    let column = |[dx, dy]: [f64; 2]| {
        let wide = at(2.0 * dx, 2.0 * dy) - at(-2.0 * dx, -2.0 * dy);
        (8.0 * (at(dx, dy) - at(-dx, -dy)) - wide) / (12.0 * step_m)
    };
    Rows::from_columns(&[column([step_m, 0.0]), column([0.0, step_m])])
}

/// The Jacobian from statics: a brake that holds one joint alone leaves the other side's arms without moment, so its force
/// passes through the far joint and balances the torque about the near one.
fn statics(arms: &Arms, pose: &Pose) -> Rows {
    let row = |force_along: [f64; 2], lever: [f64; 2]| {
        let moment = lever[0] * force_along[1] - lever[1] * force_along[0];
        [force_along[0] / moment, force_along[1] / moment]
    };
    let to_tip = |[x, y]: [f64; 2]| [pose.tip_m[0] - x, pose.tip_m[1] - y];
    let (ad, bd) = (to_tip(point_a_m(arms)), to_tip(point_b_m(arms)));
    let (ed, cd) = (to_tip(pose.point_e_m), to_tip(pose.point_c_m));
    let rows = [row(ed, ad), row(ad, ed), row(cd, bd), row(bd, cd)];
    Rows::from_fn(|i, k| rows[i][k])
}

/// The shortest arm, m.
pub fn shortest_m(arms: &Arms) -> f64 {
    [arms.l_ae_m, arms.l_ed_m, arms.l_bc_m, arms.l_cd_m]
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// Greatest difference, relative to the longest row.
pub fn difference(left: &Rows, right: &Rows) -> f64 {
    (left - right).amax() / left.amax()
}

fn check(arms: &Arms, base: [f64; 2]) -> Result<(), TestCaseError> {
    let pose = forward::pose(arms, base[0], base[1])?;
    let j = jacobian(arms, &pose)?;
    let off = difference(&j, &complex_step(arms, base));
    prop_assert!(off < SAME, "complex step {off:e}");
    let off = difference(&j, &central(arms, pose.tip_m, 4e-5 * shortest_m(arms)));
    prop_assert!(off < SAME, "central {off:e}");
    let off = difference(&j, &statics(arms, &pose));
    prop_assert!(off < SAME, "statics {off:e}");
    Ok(())
}

//= thesis (5.33) test
//= thesis (5.38) test
fn check_power(
    arms: &Arms,
    base: [f64; 2],
    rates: [f64; 2],
    torques: [f64; 4],
) -> Result<(), TestCaseError> {
    let pose = forward::pose(arms, base[0], base[1])?;
    let torque = Vector4::from(torques);
    let moved = moved(arms, base, rates);
    let rate = Vector4::new(rates[0], moved.theta_e_rate, rates[1], moved.theta_c_rate);
    let velocity = Vector2::new(moved.tip[0].im, moved.tip[1].im);
    let force = jacobian(arms, &pose)?.transpose() * torque;
    let scale =
        torque.component_mul(&rate).abs().sum() + force.component_mul(&velocity).abs().sum();
    let off = (torque.dot(&rate) - force.dot(&velocity)).abs() / scale;
    prop_assert!(off < BALANCED, "power is off by {off:e} of {scale}");
    Ok(())
}

/// Away from where the reach of a central difference would leave the assembly.
fn is_far(made: &Made) -> bool {
    is_assembled(made) && made.arms.l_ab_m > 0.01
}

fn torques() -> impl Strategy<Value = [f64; 4]> {
    let torque = -7.3..7.3_f64;
    [torque.clone(), torque.clone(), torque.clone(), torque]
}

fn rates() -> impl Strategy<Value = [f64; 2]> {
    [-3.1..3.1_f64, -3.1..3.1_f64]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(5_000), max_global_rejects: 4 * cases(5_000), max_local_rejects: 8 * cases(5_000), ..ProptestConfig::default() })]

    //= thesis (5.39) test
    #[test]
    fn jacobian_is_the_derivative_of_random_linkages(made in linkages()) {
        prop_assume!(is_far(&made));
        check(&made.arms, [made.theta_a_rad, made.theta_b_rad])?;
    }

    #[test]
    fn jacobian_is_the_derivative_on_both_layouts(three in three_brake(), four in four_brake()) {
        check(&arms(Layout::ThreeBrake), three)?;
        check(&arms(Layout::FourBrake), four)?;
    }

    #[test]
    fn power_goes_in_where_it_comes_out(three in three_brake(), four in four_brake(), rates in rates(), torques in torques()) {
        check_power(&arms(Layout::ThreeBrake), three, rates, torques)?;
        check_power(&arms(Layout::FourBrake), four, rates, torques)?;
    }

    //= thesis (5.34) test
    //= thesis (5.35) test
    //= thesis (5.36) test
    //= thesis (5.37) test
    #[test]
    fn both_sides_carry_the_tip(base in four_brake(), rates in rates()) {
        let arms = arms(Layout::FourBrake);
        let pose = forward::pose(&arms, base[0], base[1])?;
        let moved = moved(&arms, base, rates);
        let velocity = Vector2::new(moved.tip[0].im, moved.tip[1].im);
        let left = from_a_and_e(&arms, &pose) * Vector2::new(rates[0], moved.theta_e_rate);
        let right = from_b_and_c(&arms, &pose) * Vector2::new(rates[1], moved.theta_c_rate);
        let scale = moved.theta_e_rate.abs().max(moved.theta_c_rate.abs()).max(3.1);
        prop_assert!((left - velocity).amax() < 1e-12 * scale, "{left} {velocity}");
        prop_assert!((right - velocity).amax() < 1e-12 * scale, "{right} {velocity}");
    }

    //= thesis (4.1) test
    //= thesis (4.2) test
    //= thesis (4.3) test
    //= thesis (4.4) test
    #[test]
    fn j_theta_is_diagonal_and_the_printed_one_is_the_jacobian(base in four_brake(), rates in rates()) {
        let arms = arms(Layout::FourBrake);
        let pose = forward::pose(&arms, base[0], base[1])?;
        let moved = moved(&arms, base, rates);
        let velocity = Vector2::new(moved.tip[0].im, moved.tip[1].im);
        let rate = Vector2::from(rates);
        let (left, right) = (j_x(&pose) * velocity, j_theta(&arms, &pose) * rate);
        let scale = velocity.amax().max(1.0);
        prop_assert!((left - right).amax() < 1e-13 * scale, "{left} {right}");
        // What (4.4) prints gives the rates themselves; in the place of J_θ it does not hold.
        let printed = base_jacobian(&arms, &pose)?;
        prop_assert!((printed * velocity - rate).amax() < 1e-9 * scale);
        let rows = jacobian(&arms, &pose)?;
        let base_rows = Matrix2::from_rows(&[rows.row(0), rows.row(2)]);
        prop_assert!((printed - base_rows).amax() < 1e-9 * rows.amax());
        prop_assert!((left - printed * rate).amax() > 1e-6 * (printed * rate).amax());
    }
}

#[test]
fn virtual_work_is_that_of_the_tip_force() {
    for (layout, a_deg, b_deg) in [
        (Layout::ThreeBrake, 127.3, 41.9),
        (Layout::ThreeBrake, 171.1, 9.7),
        (Layout::FourBrake, 113.7, 52.3),
        (Layout::FourBrake, 96.1, 73.9),
    ] {
        let arms = arms(layout);
        let pose = forward::pose(&arms, rad(a_deg), rad(b_deg)).unwrap();
        let j = jacobian(&arms, &pose).unwrap();
        for joint in 0..4 {
            let mut torque = SVector::<f64, 4>::zeros();
            torque[joint] = 3.7;
            let force = j.transpose() * torque;
            for [dx, dy] in [[2.3e-5, -1.7e-5], [-0.9e-5, -2.9e-5]] {
                let [x, y] = pose.tip_m;
                let there = angles(&inverse::pose(&arms, [x + dx, y + dy]).unwrap());
                let back = angles(&inverse::pose(&arms, [x - dx, y - dy]).unwrap());
                let work = torque.dot(&(there - back));
                let at_tip = 2.0 * (force.x * dx + force.y * dy);
                let scale = force.norm() * 5e-5;
                assert!((work - at_tip).abs() < 1e-7 * scale, "{work:e} {at_tip:e}");
            }
        }
    }
}
