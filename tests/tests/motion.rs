//! This file says that the linkage moves the same in ten coordinates and in two, and that each printed matrix is what it claims.

mod budget;

use budget::assert_within_budget;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_model::linkage::{Pose, forward, inverse};
use rigproof_model::motion::acceleration::equations;
use rigproof_model::motion::coordinates::{JOINTS, Ten, coordinates, forces, rates};
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
