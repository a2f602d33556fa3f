//! This file says that the linkage moves the same in ten coordinates and in two, and that each printed matrix is what it claims.

use crate::budget::assert_within_budget;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_model::linkage::{Pose, forward, inverse};
use rigproof_model::motion::acceleration::equations;
use rigproof_model::motion::constraints::{constraint_matrix, constraint_matrix_rate, constraints};
use rigproof_model::motion::coordinates::{JOINTS, Ten, coordinates, forces, rates};
use rigproof_model::motion::mass::{kinetic_energy_j, mass_matrix};
use rigproof_model::motion::ten_coordinates::TenCoordinates;
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::layout::Layout;
use rigproof_spec::units::rad_from_deg;

/// A moving linkage and what acts on it.
#[derive(Clone, Copy, Debug)]
struct Moving {
    layout: Layout,
    inertia: Inertia,
    pose: Pose,
    rates_rad_s: [f64; 2],
    tip_force_n: [f64; 2],
    torques_nm: [f64; 4],
}

/// Poses with θD of 10° to 170°, where the hardware stops, and θC and θE likewise.
fn pose(layout: Layout, x_m: f64, y_m: f64) -> Option<Pose> {
    let pose = inverse::pose(&arms(layout), [x_m, y_m]).ok()?;
    let inside = |angle_rad: f64, least_deg: f64| {
        (rad_from_deg(least_deg)..=rad_from_deg(least_deg + 160.0)).contains(&angle_rad)
    };
    let allowed = inside(pose.theta_c_rad, 10.0)
        && inside(pose.theta_d_rad, 10.0)
        && inside(pose.theta_e_rad, 190.0);
    allowed.then_some(pose)
}

fn moving() -> impl Strategy<Value = Moving> {
    let layout = prop::sample::select(vec![Layout::ThreeBrake, Layout::FourBrake]);
    let place = (layout, -0.57..0.57, 0.02..0.6);
    let rates = [-6.7..6.7, -6.7..6.7_f64];
    let load = (
        [-23.0..23.0, -23.0..23.0],
        [-7.5..7.5, -5.9..5.9, -6.1..6.1, -5.8..5.8_f64],
    );
    (place, rates, load, 0.013..2.3).prop_filter_map(
        "outside the workspace",
        |((layout, x_m, y_m), rates_rad_s, (tip_force_n, torques_nm), payload_kg)| {
            let pose = pose(layout, x_m, y_m)?;
            // Every second state carries a load at the tip; table 5.1 has none.
            let mut inertia = inertia(layout);
            if payload_kg > 1.1 {
                inertia.payload_kg = payload_kg;
            }
            Some(Moving {
                layout,
                inertia,
                pose,
                rates_rad_s,
                tip_force_n,
                torques_nm,
            })
        },
    )
}

impl Moving {
    fn form(&self) -> TwoCoordinate {
        two_coordinate(
            &arms(self.layout),
            &self.inertia,
            &self.pose,
            self.rates_rad_s,
        )
    }

    fn ten(&self) -> (Ten, Ten) {
        let q = coordinates(&arms(self.layout), &self.inertia, &self.pose);
        (q, rates(&self.form(), self.rates_rad_s))
    }

    fn forces(&self) -> Ten {
        forces(self.tip_force_n, self.torques_nm)
    }
}

/// Draws `count` values of a strategy.
fn draw<S: Strategy>(strategy: S, count: usize) -> Vec<S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).unwrap().current())
        .collect()
}

//= thesis (5.40) test
//= thesis (5.42) test
//= thesis (5.43) test
//= thesis (5.52) test
//= thesis (5.66) test
//= thesis (A.1) test
//= thesis (A.3) test
//= thesis (A.4) test
//= thesis (A.5) test
//= thesis (A.6) test
#[test]
fn ten_coordinates_accelerate_like_two() {
    let mut differences = Vec::new();
    for state in draw(moving(), 100_000) {
        let (q, q_dot) = state.ten();
        let ten = equations(&arms(state.layout), &state.inertia, &q, &q_dot)
            .acceleration(&state.forces())
            .unwrap();
        let form = state.form();
        let two = form.joint_accelerations_rad_s2(
            form.acceleration_rad_s2(state.tip_force_n, state.torques_nm),
        );
        let scale = two.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        for (joint, accelerated) in JOINTS.into_iter().zip(two) {
            differences.push((ten.q_ddot[joint] - accelerated).abs() / scale);
        }
    }
    assert_within_budget("ten_against_two_coordinates", differences);
}

//= thesis (5.40) test
#[test]
fn the_three_brake_layout_has_a_closed_form() {
    // With L_AB = 0 and equal arms ED turns with BC and CD with AE:
    // M11 = I_AE + m_AE·l_AE² + I_CD + m_ED·L_AE² + m_CD·l_CD² = 0.54999 and so on.
    for [theta_a, theta_b, rate_a, rate_b] in [[2.13, 0.71, 1.37, -2.9], [1.31, -0.47, -4.3, 0.9]] {
        let parameters = arms(Layout::ThreeBrake);
        let pose = forward::pose(&parameters, theta_a, theta_b).unwrap();
        let form = two_coordinate(
            &parameters,
            &inertia(Layout::ThreeBrake),
            &pose,
            [rate_a, rate_b],
        );
        let cosine = 0.228_74 * libm::cos(theta_a - theta_b);
        let sine = 0.228_74 * libm::sin(theta_a - theta_b);
        for (entry, by_hand) in [
            (form.mass.m11, 0.549_99),
            (form.mass.m12, cosine),
            (form.mass.m21, cosine),
            (form.mass.m22, 0.366_41),
        ] {
            assert!((entry - by_hand).abs() < 1e-5, "{entry} against {by_hand}");
        }
        assert!((form.bias.x - sine * rate_b * rate_b).abs() < 1e-4);
        assert!((form.bias.y + sine * rate_a * rate_a).abs() < 2e-4);
    }
}

//= thesis (5.44) test
//= thesis (5.45) test
//= thesis (5.46) test
//= thesis (5.47) test
//= thesis (5.48) test
//= thesis (5.49) test
//= thesis (5.50) test
//= thesis (5.51) test
//= thesis (A.28) test
//= thesis (A.29) test
//= thesis (A.30) test
//= thesis (A.31) test
//= thesis (A.32) test
//= thesis (A.33) test
//= thesis (A.34) test
//= thesis (A.35) test
#[test]
fn constraints_hold_on_the_linkage_and_only_there() {
    for state in draw(moving(), 1000) {
        let (q, _) = state.ten();
        let at = |q: &Ten| constraints(&arms(state.layout), &state.inertia, q);
        assert!(at(&q).amax() < 1e-15, "{:e} m", at(&q).amax());
        // Each point appears with minus one in its own pair of constraints: the tip in two of them.
        for (coordinate, rows) in [
            (0, vec![0, 2]),
            (1, vec![1, 3]),
            (4, vec![4]),
            (5, vec![5]),
            (8, vec![6]),
            (9, vec![7]),
        ] {
            let mut moved = q;
            moved[coordinate] += 0.0137;
            for row in 0..8 {
                let expected = if rows.contains(&row) { -0.0137 } else { 0.0 };
                assert!((at(&moved)[row] - expected).abs() < 1e-15);
            }
        }
    }
}

//= thesis (5.59) test
//= thesis (5.60) test
//= thesis (5.61) test
//= thesis (5.62) test
//= thesis (5.63) test
//= thesis (5.64) test
//= thesis (5.65) test
//= thesis (A.36) test
//= thesis (A.37) test
//= thesis (A.38) test
//= thesis (A.39) test
//= thesis (A.40) test
//= thesis (A.41) test
#[test]
fn constraint_matrix_is_the_derivative_of_8_constraints_by_10_coordinates() {
    let mut differences = Vec::new();
    for state in draw(moving(), 1000) {
        let (q, _) = state.ten();
        let a = constraint_matrix(&arms(state.layout), &state.inertia, &q);
        assert_eq!(a.shape(), (8, 10));
        let h = libm::exp2(-17.0);
        for column in 0..10 {
            let shifted = |by: f64| {
                let mut q = q;
                q[column] += by;
                constraints(&arms(state.layout), &state.inertia, &q)
            };
            // Central differences at two widths, so that the error is of fourth order.
            let wide = (shifted(2.0 * h) - shifted(-2.0 * h)) / (4.0 * h);
            let narrow = (shifted(h) - shifted(-h)) / (2.0 * h);
            let derivative = (narrow * 4.0 - wide) / 3.0;
            differences.push((derivative - a.column(column)).amax());
        }
    }
    assert_within_budget("constraint_matrix_against_differences", differences);
}

//= thesis (A.42) test
//= thesis (A.43) test
//= thesis (A.44) test
//= thesis (A.45) test
//= thesis (A.46) test
#[test]
fn constraint_matrix_rate_is_its_rate() {
    let mut differences = Vec::new();
    for state in draw(moving(), 1000) {
        let (q, q_dot) = state.ten();
        let at = |t: f64| constraint_matrix(&arms(state.layout), &state.inertia, &(q + q_dot * t));
        let rate = constraint_matrix_rate(&arms(state.layout), &state.inertia, &q, &q_dot);
        let h = libm::exp2(-17.0);
        let wide = (at(2.0 * h) - at(-2.0 * h)) / (4.0 * h);
        let narrow = (at(h) - at(-h)) / (2.0 * h);
        differences.push(((narrow * 4.0 - wide) / 3.0 - rate).amax() / (1.0 + rate.amax()));
    }
    assert_within_budget("constraint_matrix_against_differences", differences);
}

//= thesis (5.53) test
//= thesis (5.54) test
//= thesis (5.55) test
//= thesis (5.56) test
//= thesis (5.57) test
//= thesis (5.58) test
//= thesis (A.7) test
//= thesis (A.8) test
//= thesis (A.9) test
//= thesis (A.10) test
//= thesis (A.11) test
//= thesis (A.12) test
//= thesis (A.13) test
//= thesis (A.14) test
//= thesis (A.15) test
//= thesis (A.16) test
//= thesis (A.17) test
//= thesis (A.18) test
//= thesis (A.19) test
//= thesis (A.20) test
//= thesis (A.21) test
//= thesis (A.22) test
//= thesis (A.23) test
//= thesis (A.24) test
//= thesis (A.25) test
//= thesis (A.26) test
//= thesis (A.27) test
#[test]
fn mass_matrix_is_the_second_derivative_of_the_kinetic_energy() {
    for (state, v) in draw((moving(), prop::array::uniform10(-3.1..3.1_f64)), 1000) {
        let (v, i) = (Ten::from(v), &state.inertia);
        // The sum of (A.7) to (A.11) written out again, in rates that need not fit the linkage.
        let square = |x: f64| x * x;
        let by_hand =
            0.5 * (i.ae.inertia_kg_m2 + i.ae.mass_kg * square(i.ae.centre_m)) * square(v[2])
                + 0.5 * (i.bc.inertia_kg_m2 + i.bc.mass_kg * square(i.bc.centre_m)) * square(v[6])
                + 0.5 * i.ed.inertia_kg_m2 * square(v[2] + v[3])
                + 0.5 * i.cd.inertia_kg_m2 * square(v[6] + v[7])
                + 0.5 * i.ed.mass_kg * (square(v[4]) + square(v[5]))
                + 0.5 * i.cd.mass_kg * (square(v[8]) + square(v[9]))
                + 0.5 * i.payload_kg * (square(v[0]) + square(v[1]));
        let energy = |v: &Ten| kinetic_energy_j(i, v);
        assert!((energy(&v) / by_hand - 1.0).abs() < 1e-14);
        // (A.12) to (A.21) are M·q̈, row by row: the energy is quadratic, so that differences are exact.
        let mass = mass_matrix(i);
        for row in 0..10 {
            let mut unit = Ten::zeros();
            unit[row] = 1.0;
            let momentum = 0.5 * (energy(&(v + unit)) - energy(&(v - unit)));
            assert!((momentum - (mass * v)[row]).abs() < 1e-12 * (1.0 + by_hand));
        }
        let (_, q_dot) = state.ten();
        let of_two = state.form().kinetic_energy_j(state.rates_rad_s);
        assert!(
            (energy(&q_dot) - of_two).abs() < 1e-13 * of_two,
            "{of_two} J"
        );
    }
}

#[test]
fn the_multiplier_in_lagranges_equation_belongs_to_the_constraint() {
    for state in draw(moving(), 300) {
        let (q, q_dot) = state.ten();
        let (arms, inertia) = (arms(state.layout), state.inertia);
        let solved = equations(&arms, &inertia, &q, &q_dot)
            .acceleration(&state.forces())
            .unwrap();
        let a = constraint_matrix(&arms, &inertia, &q);
        let inertial = mass_matrix(&inertia) * solved.q_ddot;
        //= thesis (5.41) test
        //= thesis (A.2) test
        let intended = state.forces() + a.transpose() * solved.lambda;
        let scale = 1.0 + inertial.amax() + solved.lambda.amax();
        assert!((inertial - intended).amax() < 1e-9 * scale);
        // As printed, λ_j stands outside the sum over the constraints; for j = 9 and 10 there is none.
        assert!(solved.lambda.len() < solved.q_ddot.len());
        let printed_3 = state.forces()[2] + solved.lambda[2] * a.column(2).sum();
        assert!((inertial[2] - printed_3).abs() > 1e-9 * scale);
    }
}

/// Drives the ten coordinates, confined by a spring, and returns their greatest drift, m.
fn drift_m(layout: Layout, step_s: f64, end_s: f64) -> f64 {
    let (arms, inertia) = (arms(layout), inertia(layout));
    let pose = inverse::pose(&arms, [0.031, 0.407]).unwrap();
    let mut ten = TenCoordinates::new(&arms, &inertia, &pose, [0.37, -0.61]);
    let mut drift_m = 0.0_f64;
    for step in 0..(end_s / step_s) as u32 {
        let t = f64::from(step) * step_s;
        let push = [17.0 * libm::sin(1.7 * t), 13.0 * libm::cos(2.3 * t)];
        let load = |q: &Ten, v: &Ten| {
            let spring = |x: f64, middle: f64, rate: f64| -190.0 * (x - middle) - 7.3 * rate;
            let force = [
                push[0] + spring(q[0], 0.013, v[0]),
                push[1] + spring(q[1], 0.403, v[1]),
            ];
            forces(force, [0.0; 4])
        };
        ten.step_runge_kutta(load, step_s).unwrap();
        drift_m = drift_m.max(ten.drift_m());
    }
    assert!(ten.drift_rate_m_s() < 1e-6);
    drift_m
}

#[test]
fn ten_coordinates_drift_less_than_a_nanometre_in_a_minute() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let minute_m = drift_m(layout, 0.5e-3, 60.0);
        let [wide_m, narrow_m] = [4e-3, 2e-3].map(|step_s| drift_m(layout, step_s, 4.0));
        println!("{layout:?}: {minute_m:e} m in 60 s; {wide_m:e} m and {narrow_m:e} m in 4 s");
        assert!(minute_m < 1e-9, "{minute_m:e} m");
        // Fourth order: sixteen times less at half the step.
        assert!((8.0..32.0).contains(&(wide_m / narrow_m)));
    }
}
