//! This file says where the thesis's rules for stuck brakes and the exact dry friction part, how often and by how much.

use nalgebra::Vector2;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_model::linkage::{Pose, inverse};
use rigproof_model::motion::acceleration::equations;
use rigproof_model::motion::coordinates::{coordinates, rates};
use rigproof_model::motion::friction::{DryBrakes, dry_motion};
use rigproof_model::motion::stick::{Joints, KarnoppBrakes, joints, karnopp};
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::torque_gain_fit;
use rigproof_spec::units::{RAD_PER_DEG, rad_from_deg};

/// A linkage, its brakes' yields and a direction to push in.
#[derive(Clone, Copy, Debug)]
struct Pushed {
    layout: Layout,
    pose: Pose,
    yields_nm: [f64; 4],
    direction: [f64; 2],
}

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

/// Yields anywhere between the off-state torque and the torque at 1 A.
fn pushed(layout: Layout) -> impl Strategy<Value = Pushed> {
    let shares = prop::array::uniform4(0.0..1.0_f64);
    (-0.57..0.57, 0.02..0.6, shares, -3.1..3.1_f64).prop_filter_map(
        "outside the workspace",
        move |(x_m, y_m, shares, angle_rad)| {
            let mut yields_nm = [0.0; 4];
            for joint in layout.brakes() {
                let fit = torque_gain_fit(*joint);
                let (least, most) = (fit.off_state_nm(), fit.greatest_nm());
                yields_nm[*joint as usize] = least + shares[*joint as usize] * (most - least);
            }
            Some(Pushed {
                layout,
                pose: pose(layout, x_m, y_m)?,
                yields_nm,
                direction: [libm::cos(angle_rad), libm::sin(angle_rad)],
            })
        },
    )
}

fn draw<S: Strategy>(strategy: S, count: usize) -> Vec<S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).unwrap().current())
        .collect()
}

impl Pushed {
    fn form(&self) -> TwoCoordinate {
        two_coordinate(
            &arms(self.layout),
            &inertia(self.layout),
            &self.pose,
            [0.0; 2],
        )
    }

    fn brakes(&self) -> DryBrakes {
        DryBrakes {
            rows: self.form().joints,
            bounds_nm: self.yields_nm,
        }
    }

    fn force_n(&self, size_n: f64) -> [f64; 2] {
        self.direction.map(|part| part * size_n)
    }

    /// The force at which the exact solution lets go, N.
    fn breaking_n(&self) -> f64 {
        1.0 / self.brakes().hold(&self.form().drive(self.direction)).share
    }

    fn joints(&self, size_n: f64) -> Joints {
        let (arms, inertia) = (arms(self.layout), inertia(self.layout));
        let q = coordinates(&arms, &inertia, &self.pose);
        let q_dot = rates(&self.form(), [0.0; 2]);
        joints(
            &equations(&arms, &inertia, &q, &q_dot),
            self.force_n(size_n),
        )
        .unwrap()
    }
}

/// What the lumped rule does while the force on a resting linkage grows slowly.
struct Ramp {
    /// Force at which it lets go, in parts of the exact one; none below three times it.
    lets_go_at: Option<f64>,
    /// The accelerations of θA and θB then, its own and the exact ones.
    accelerations: [Vector2<f64>; 2],
    /// Whether a brake then drives its joint.
    drives: bool,
    /// Whether the same brakes stay held.
    same_held: bool,
}

fn ramp(case: &Pushed) -> Ramp {
    let breaking_n = case.breaking_n();
    let mut rule = KarnoppBrakes::new(1e-3);
    let joints_of_one = case.joints(1.0);
    for percent in 1..=300 {
        let size_n = breaking_n * (f64::from(percent) + 0.37) / 100.0;
        // From rest everything is proportional to the force.
        let joints = Joints {
            free: joints_of_one.free * size_n,
            ..joints_of_one
        };
        let (torques_nm, held) = rule.torques_nm(&joints, [0.0; 4], case.yields_nm);
        let accelerated = joints.accelerations_rad_s2(torques_nm);
        let scale = (joints.free).amax();
        if accelerated.iter().all(|a| a.abs() < 1e-9 * scale) {
            continue;
        }
        let exact = dry_motion(
            &case.form().mass,
            &case.form().drive(case.force_n(size_n)),
            &case.brakes(),
        );
        let drives = (0..4).any(|i| torques_nm[i] * accelerated[i] > 1e-9 * scale);
        return Ramp {
            lets_go_at: Some(size_n / breaking_n),
            accelerations: [
                Vector2::new(accelerated[0], accelerated[2]),
                exact.motion.into(),
            ],
            drives,
            same_held: (0..4).all(|i| case.yields_nm[i] == 0.0 || held[i] == exact.held[i]),
        };
    }
    Ramp {
        lets_go_at: None,
        accelerations: [Vector2::zeros(); 2],
        drives: false,
        same_held: false,
    }
}

fn quantile(values: &mut [f64], rank: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * rank) as usize]
}

/// What a set of ramps shows, in per cent of them; the direction in degrees, median and 90 % quantile.
#[derive(Debug)]
struct Disagreement {
    lets_go_early: f64,
    lets_go_late: f64,
    other_brakes_held: f64,
    a_brake_drives: f64,
    both_move: f64,
    direction_off_deg: [f64; 2],
    least_force: f64,
}

fn disagreement(layout: Layout) -> Disagreement {
    let ramps: Vec<Ramp> = draw(pushed(layout), 4000).iter().map(ramp).collect();
    let percent = |holds: &dyn Fn(&Ramp) -> bool| {
        let count = ramps.iter().filter(|ramp| holds(ramp)).count();
        100.0 * count as f64 / ramps.len() as f64
    };
    let mut forces: Vec<f64> = ramps.iter().filter_map(|ramp| ramp.lets_go_at).collect();
    let moves = |ramp: &Ramp| ramp.accelerations[1] != Vector2::zeros();
    let mut angles_deg: Vec<f64> = ramps
        .iter()
        .filter(|ramp| moves(ramp))
        .map(|ramp| ramp.accelerations[0].angle(&ramp.accelerations[1]) / RAD_PER_DEG)
        .collect();
    Disagreement {
        lets_go_early: percent(&|ramp| ramp.lets_go_at.is_some_and(|at| at < 0.995)),
        lets_go_late: percent(&|ramp| ramp.lets_go_at.is_none_or(|at| at > 1.015)),
        other_brakes_held: percent(&|ramp| !ramp.same_held),
        a_brake_drives: percent(&|ramp| ramp.drives),
        both_move: percent(&moves),
        direction_off_deg: [0.5, 0.9].map(|rank| quantile(&mut angles_deg, rank)),
        least_force: quantile(&mut forces, 0.0),
    }
}

#[test]
fn lumped_rule_holds_as_long_as_it_should_on_three_brakes_and_not_on_four() {
    let three = disagreement(Layout::ThreeBrake);
    println!("{three:#?}");
    // Three brakes on two coordinates: the choices of the rule are the ends of all possible torques.
    assert!(three.lets_go_late == 0.0 && three.lets_go_early < 1.0);
    // Then it guesses which brakes go on holding, and keeps the sign of a torque that should turn.
    assert!((10.0..26.0).contains(&three.other_brakes_held));
    assert!((22.0..42.0).contains(&three.a_brake_drives));
    let four = disagreement(Layout::FourBrake);
    println!("{four:#?}");
    // Four brakes have 24 ends, the rule tries six.
    assert!(four.lets_go_late == 0.0 && (40.0..60.0).contains(&four.lets_go_early));
    assert!((70.0..90.0).contains(&four.other_brakes_held));
    assert!((75.0..95.0).contains(&four.a_brake_drives));
    assert!(four.least_force < 0.02);
    // Where both move, the direction is right in the middle on three brakes and off by 20° on four.
    assert!(
        three.both_move > 99.0
            && three.direction_off_deg[0] < 1e-3
            && three.direction_off_deg[1] > 30.0
    );
    assert!(four.both_move < 60.0 && four.direction_off_deg[0] > 10.0);
}

//= thesis (5.68) test
#[test]
fn one_and_two_stuck_joints_get_what_stops_them() {
    for (case, size_n) in draw((pushed(Layout::FourBrake), 0.7..29.0_f64), 2000) {
        let joints = case.joints(size_n);
        let scale = joints.free.amax();
        for i in 0..4 {
            let mut torques_nm = [0.31, -0.53, 0.71, -0.29];
            torques_nm[i] = joints.applied_on_one(torques_nm, i);
            assert!(joints.accelerations_rad_s2(torques_nm)[i].abs() < 1e-9 * scale);
            for j in i + 1..4 {
                let mut torques_nm = [0.31, -0.53, 0.71, -0.29];
                [torques_nm[i], torques_nm[j]] = joints.applied_on_two(torques_nm, [i, j]);
                // Two held joints hold the whole linkage.
                let worst = joints.accelerations_rad_s2(torques_nm).map(f64::abs);
                assert!(
                    worst.iter().all(|a| *a < 1e-6 * scale),
                    "{worst:?} of {scale}"
                );
            }
        }
        // W·τ of any three joints is dependent: "not linearly independent and cannot be used" (§5.3.5).
        assert!(
            joints
                .compliance
                .fixed_view::<3, 3>(0, 0)
                .determinant()
                .abs()
                < 1e-9 * joints.compliance.amax().powi(3)
        );
    }
}

#[test]
fn two_stuck_brakes_hold_as_long_as_they_should_and_then_slip_nearly_right() {
    let (mut cases, mut other, mut drives) = (0, 0, 0);
    for (mut case, pair, size) in draw(
        (pushed(Layout::FourBrake), 0_usize..6, 0.3..2.1_f64),
        20_000,
    ) {
        let kept = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]][pair];
        case.yields_nm = [0, 1, 2, 3].map(|i| {
            if kept.contains(&i) {
                case.yields_nm[i]
            } else {
                0.0
            }
        });
        let size_n = size * case.breaking_n();
        let joints = case.joints(size_n);
        let (torques_nm, held) =
            KarnoppBrakes::new(1e-3).torques_nm(&joints, [0.0; 4], case.yields_nm);
        let drive = case.form().drive(case.force_n(size_n));
        let exact = dry_motion(&case.form().mass, &drive, &case.brakes());
        if size < 1.0 {
            assert!(kept.iter().all(|&i| held[i] && exact.held[i]), "{case:?}");
            continue;
        }
        cases += 1;
        let accelerated = joints.accelerations_rad_s2(torques_nm);
        let scale = joints.free.amax();
        other += u32::from(kept.iter().any(|&i| held[i] != exact.held[i]));
        drives += u32::from(
            kept.iter()
                .any(|&i| torques_nm[i] * accelerated[i] > 1e-9 * scale),
        );
    }
    let percent = |count: u32| 100.0 * f64::from(count) / f64::from(cases);
    println!(
        "of {cases} that slip: other brakes held {:.2} %, a brake drives {:.2} %",
        percent(other),
        percent(drives)
    );
    assert!((0.3..3.0).contains(&percent(other)) && (0.3..3.0).contains(&percent(drives)));
}

//= thesis (5.67) test
#[test]
fn karnopp_rule_by_hand() {
    assert_eq!(karnopp(0.013, 0.01, 0.9, 2.3), -2.3);
    assert_eq!(karnopp(-0.013, 0.01, 0.9, 2.3), 2.3);
    assert_eq!(karnopp(0.007, 0.01, -3.1, 2.3), -2.3);
    assert_eq!(karnopp(-0.007, 0.01, 0.9, 2.3), 0.9);
}
