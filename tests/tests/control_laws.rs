//! This file says what holds for every controller at every pose, velocity and force on both layouts.

use core::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use rigproof_model::brake::torque_gain;
use rigproof_model::control::path::{Arc, Line, Nearest, Path, Polyline, Spline};
use rigproof_model::control::{
    Actuation, Controller, GainUnit, Impedance, Obstacle, Optimal, Sdof, Sensed, Side,
    VelocityRatio, Virtual, Weights, controller,
};
use rigproof_model::linkage::{Pose, forward, jacobian::jacobian, limits};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::{angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{
    best_influence, brake_count, braked_joints, current_limit, desired_force, free_side, gap, lock,
    opposition, undefined_input,
};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method, STANDING};
use rigproof_spec::units::M_PER_CM;
use rigproof_tests::cases;

/// One moment of a rig: its layout and what is sensed.
#[derive(Clone, Copy, Debug)]
struct Moment {
    layout: Layout,
    sensed: Sensed,
}

impl Moment {
    fn rows(&self) -> Vec<(Joint, Vector2<f64>)> {
        let j = jacobian(&arms(self.layout), &self.sensed.pose).unwrap();
        let all = Joint::ALL.into_iter().zip(j.row_iter());
        all.filter(|(joint, _)| self.layout.brakes().contains(joint))
            .map(|(joint, row)| (joint, row.transpose()))
            .collect()
    }

    fn velocity(&self) -> Vector2<f64> {
        Vector2::from(self.sensed.tip_velocity_m_s)
    }
}

/// A pose inside table 4.2.
fn pose() -> impl Strategy<Value = (Layout, Pose)> {
    let layout = prop::sample::select(vec![Layout::ThreeBrake, Layout::FourBrake]);
    (layout, 0.18..3.13_f64, 0.0..2.96_f64).prop_filter_map("inside table 4.2", |(layout, a, b)| {
        let pose = forward::pose(&arms(layout), a, b).ok()?;
        limits::check(&angle_ranges(layout), &pose).ok()?;
        Some((layout, pose))
    })
}

/// A pose with any velocity and force; now and then one of them is zero.
fn moment() -> impl Strategy<Value = Moment> {
    let speed = prop_oneof![9 => 0.0003..0.41_f64, 1 => Just(0.0)];
    let push = prop_oneof![9 => 0.13..21.0_f64, 1 => Just(0.0)];
    (pose(), speed, -PI..PI, push, -PI..PI).prop_map(
        |((layout, pose), speed, heading, push, aim)| {
            let polar = |r: f64, angle: f64| [r * libm::cos(angle), r * libm::sin(angle)];
            let tip_velocity_m_s = polar(speed, heading);
            let j = jacobian(&arms(layout), &pose).unwrap();
            let omega = j * Vector2::from(tip_velocity_m_s);
            let sensed = Sensed {
                pose,
                tip_velocity_m_s,
                omega_rad_s: omega.into(),
                tip_force_n: polar(push, aim),
            };
            Moment { layout, sensed }
        },
    )
}

/// Paths that pass near the tip: within 9 cm of it.
fn near_path(tip_m: [f64; 2]) -> impl Strategy<Value = Box<dyn Path>> {
    let [x, y] = tip_m;
    let at = move |[dx, dy]: [f64; 2]| [x + dx, y + dy];
    let offset = || [-0.09..0.09_f64, -0.09..0.09_f64];
    let corners = prop::collection::vec(offset(), 4).prop_map(move |offsets| -> Vec<[f64; 2]> {
        let ways = [[-0.21, 0.03], [-0.05, 0.0], [0.07, 0.02], [0.23, -0.04]];
        let shifted = offsets.into_iter().zip(ways);
        shifted
            .map(|([dx, dy], [wx, wy])| at([dx / 2.0 + wx, dy / 2.0 + wy]))
            .collect()
    });
    let corners = prop::strategy::Strategy::boxed(corners);
    prop_oneof![
        (offset(), -PI..PI).prop_map(move |([dx, dy], angle)| {
            let far = at([dx + libm::cos(angle), dy + libm::sin(angle)]);
            Box::new(Line::through(at([dx, dy]), far).unwrap()) as Box<dyn Path>
        }),
        (offset(), 0.03..0.09_f64, -PI..PI).prop_map(move |(centre, radius, start)| {
            Box::new(Arc::new(at(centre), radius, start, 2.0 * PI).unwrap()) as Box<dyn Path>
        }),
        corners
            .clone()
            .prop_map(|corners| Box::new(Polyline::open(&corners).unwrap()) as Box<dyn Path>),
        corners.prop_map(|corners| Box::new(Spline::through(&corners).unwrap()) as Box<dyn Path>),
    ]
}

fn moment_and_path() -> impl Strategy<Value = (Moment, Box<dyn Path>)> {
    moment().prop_flat_map(|moment| (Just(moment), near_path(moment.sensed.pose.tip_m)))
}

/// A path that gives no number for one of its answers.
#[derive(Clone, Copy, Debug)]
struct Lost(usize);

impl Path for Lost {
    fn nearest(&self, [x, y]: [f64; 2]) -> Nearest {
        let mut numbers = [x - 0.013, y - 0.017, 0.6, 0.8, 0.0213];
        numbers[self.0] = f64::NAN;
        let [foot_x, foot_y, along_x, along_y, offset_m] = numbers;
        Nearest {
            foot_m: Vector2::new(foot_x, foot_y),
            tangent: Vector2::new(along_x, along_y),
            offset_m,
        }
    }
}

/// Every controller there is, with the number of brakes it may use at once.
fn controllers<'a>(
    layout: Layout,
    path: &'a dyn Path,
    gain: f64,
) -> Vec<(Box<dyn Controller + 'a>, u8)> {
    let actuation = Actuation::thesis(layout);
    let elements = Virtual {
        stiffness_n_per_m: 310.0 * gain,
        damping_across_n_s_per_m: 37.0 * gain,
        damping_along_n_s_per_m: 11.0 * gain,
    };
    let weights = Weights {
        angle: 0.73 * gain,
        energy: 0.31,
        horizon_s: 0.013,
    };
    let mass = Matrix2::new(3.7, 0.31, 0.31, 2.9);
    let sdof = |gap_m| Sdof::new(actuation, path, BLEND_BOUNDARY_M, gap_m).unwrap();
    vec![
        (Box::new(sdof(0.0)), 1),
        (Box::new(sdof(0.0053)), 1),
        (Box::new(proportional(actuation, path, 73.0 * gain)), 1),
        (
            Box::new(VelocityRatio::new(actuation, path, BLEND_BOUNDARY_M, 7.3 * gain).unwrap()),
            2,
        ),
        (
            Box::new(Impedance::new(actuation, path, elements).unwrap()),
            2,
        ),
        (
            Box::new(
                Optimal::new(
                    actuation,
                    path,
                    BLEND_BOUNDARY_M,
                    weights,
                    move |_: &Pose| Some(mass),
                )
                .unwrap(),
            ),
            1,
        ),
        (Box::new(Obstacle::new(path, Side::Left, sdof(0.0))), 1),
        (
            Box::new(Obstacle::new(
                path,
                Side::Right,
                proportional(actuation, path, 91.0),
            )),
            1,
        ),
    ]
}

fn proportional(
    actuation: Actuation,
    path: &dyn Path,
    gain: f64,
) -> rigproof_model::control::Proportional<&dyn Path> {
    rigproof_model::control::Proportional::new(actuation, path, BLEND_BOUNDARY_M, gain).unwrap()
}

/// The velocity field again, by angles: the desired angle, the angle along the path and that towards it.
fn field(path: &dyn Path, sensed: &Sensed) -> (f64, f64, Option<f64>) {
    let nearest = path.nearest(sensed.pose.tip_m);
    let [force_x, force_y] = sensed.tip_force_n;
    let along = libm::atan2(nearest.tangent.y, nearest.tangent.x);
    let backward = nearest.tangent.x * force_x + nearest.tangent.y * force_y < 0.0;
    let along = if backward { along + PI } else { along };
    if nearest.offset_m == 0.0 {
        return (along, along, None);
    }
    // The path lies to the right of a point on its left.
    let right_of_travel = (nearest.offset_m > 0.0) != backward;
    let turn = if right_of_travel { -PI / 2.0 } else { PI / 2.0 };
    let share = (nearest.offset_m.abs() / BLEND_BOUNDARY_M).min(1.0);
    (along + share * turn, along, Some(along + turn))
}

/// Components of a vector along an angle and across it, to the left.
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(angle);
    [cosine * x + sine * y, cosine * y - sine * x]
}

fn obeys_the_laws_of_all(moment: &Moment, command: &Command, most: u8) {
    for current_a in command.currents_a {
        assert!(current_limit(current_a).holds(), "{command:?}");
    }
    assert!(braked_joints(moment.layout, command).holds(), "{command:?}");
    assert!(brake_count(command, most).holds(), "{command:?}");
    if let Reason::Chosen(joint) = command.reason {
        for (other, current_a) in Joint::ALL.into_iter().zip(command.currents_a) {
            assert!(other == joint || current_a == 0.0, "{command:?}");
        }
    }
    if command.reason.is_lock() {
        for joint in moment.layout.brakes() {
            assert_eq!(command.currents_a[*joint as usize], 1.0);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(20_000),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_command_is_one_the_rig_can_take((moment, path) in moment_and_path(), gain in 0.1..9.0_f64) {
        for (mut controller, most) in controllers(moment.layout, &*path, gain) {
            let command = controller.command(&moment.sensed);
            prop_assert!(command.reason != Reason::UndefinedInput && command.reason != Reason::SingularPose);
            obeys_the_laws_of_all(&moment, &command, most);
        }
    }

    #[test]
    fn an_undefined_input_never_actuates(
        (moment, path) in moment_and_path(), which in 0..15_usize,
        value in prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
    ) {
        let mut sensed = moment.sensed;
        let pose = &mut sensed.pose;
        match which {
            0 => pose.theta_a_rad = value,
            1 => pose.theta_e_rad = value,
            2 => pose.theta_b_rad = value,
            3 => pose.theta_c_rad = value,
            4 => pose.theta_d_rad = value,
            5 | 6 => pose.tip_m[which - 5] = value,
            7 | 8 => sensed.tip_velocity_m_s[which - 7] = value,
            9..=12 => sensed.omega_rad_s[which - 9] = value,
            _ => sensed.tip_force_n[which - 13] = value,
        }
        for (mut controller, _) in controllers(moment.layout, &*path, 1.3) {
            let command = controller.command(&sensed);
            prop_assert!(undefined_input(&sensed.inputs(), &command).holds(), "{command:?}");
            prop_assert_eq!(command.reason, Reason::UndefinedInput);
        }
    }

    #[test]
    fn a_path_that_does_not_know_never_actuates(moment in moment(), which in 0..5_usize) {
        for (mut controller, _) in controllers(moment.layout, &Lost(which), 1.3) {
            let command = controller.command(&moment.sensed);
            prop_assert!(undefined_input(&[f64::NAN], &command).holds(), "{command:?}");
            prop_assert_eq!(command.reason, Reason::UndefinedInput);
        }
    }

    #[test]
    fn nothing_acts_inside_the_gap((moment, path) in moment_and_path(), gap_m in 0.0..0.05_f64) {
        let distance_m = path.nearest(moment.sensed.pose.tip_m).distance_m();
        let actuation = Actuation::thesis(moment.layout);
        let command = Sdof::new(actuation, &*path, BLEND_BOUNDARY_M, gap_m).unwrap().command(&moment.sensed);
        prop_assert!(gap(distance_m, gap_m, &command).holds());
        prop_assert_eq!(command.reason == Reason::InsideGap, distance_m <= gap_m);
    }

    #[test]
    fn nothing_acts_on_the_free_side((moment, path) in moment_and_path(), left in any::<bool>()) {
        let actuation = Actuation::thesis(moment.layout);
        let inner = Sdof::new(actuation, &*path, BLEND_BOUNDARY_M, 0.0).unwrap();
        let side = if left { Side::Left } else { Side::Right };
        let mut obstacle = Obstacle::new(&*path, side, inner);
        let offset_m = path.nearest(moment.sensed.pose.tip_m).offset_m;
        let depth_m = if left { offset_m } else { -offset_m };
        let command = obstacle.command(&moment.sensed);
        prop_assert!(free_side(depth_m, &command).holds());
        let mut alone = Sdof::new(actuation, &*path, BLEND_BOUNDARY_M, 0.0).unwrap();
        if depth_m > 0.0 {
            prop_assert_eq!(command, alone.command(&moment.sensed));
        }
    }

    #[test]
    fn sdof_picks_the_local_path_closest_to_the_desired_velocity((moment, path) in moment_and_path()) {
        let (beta, along, towards) = field(&*path, &moment.sensed);
        prop_assume!(towards.is_some());
        let towards = towards.unwrap();
        let beyond = |angle: f64| libm::remainder(angle, 2.0 * PI);
        // Each local path as an angle, from the joint whose row it is at a right angle to.
        let mut best: Option<(f64, Joint)> = None;
        let mut doubtful = false;
        for (joint, row) in moment.rows() {
            for quarter in [PI / 2.0, -PI / 2.0] {
                let angle = libm::atan2(row.y, row.x) + quarter;
                let from_along = beyond(angle - along);
                let from_towards = beyond(angle - towards);
                let edge = (from_along.abs() - PI / 2.0).abs().min((from_towards.abs() - PI / 2.0).abs());
                doubtful |= edge < 1e-9;
                let valid = from_along.abs() <= PI / 2.0 && from_towards.abs() <= PI / 2.0;
                let off = beyond(angle - beta).abs();
                if valid {
                    doubtful |= best.is_some_and(|(least, _)| (least - off).abs() < 1e-9);
                    if best.is_none_or(|(least, _)| off < least) {
                        best = Some((off, joint));
                    }
                }
            }
        }
        prop_assume!(!doubtful);
        let actuation = Actuation::thesis(moment.layout);
        let command = Sdof::new(actuation, &*path, BLEND_BOUNDARY_M, 0.0).unwrap().command(&moment.sensed);
        let towards_n = turned(moment.sensed.tip_force_n, towards)[0];
        match best {
            Some((_, joint)) => prop_assert_eq!(command.reason, Reason::Chosen(joint)),
            None if towards_n < 0.0 => prop_assert_eq!(command.reason, Reason::LockedPushedAway),
            None => prop_assert_eq!(command.reason, Reason::NoneHelps),
        }
        prop_assert!(lock(towards_n, 1.0, &command).holds());
    }

    #[test]
    fn sdof_always_finds_a_brake_where_local_paths_are_at_most_90_degrees_apart((moment, path) in moment_and_path()) {
        let mut angles: Vec<f64> = moment
            .rows()
            .iter()
            .map(|(_, row)| libm::fmod(libm::atan2(row.y, row.x) + 2.0 * PI, PI))
            .collect();
        angles.sort_by(f64::total_cmp);
        let next = angles.iter().skip(1).copied().chain([angles[0] + PI]);
        let widest = angles.iter().zip(next).map(|(a, b)| b - a).fold(0.0, f64::max);
        let command = Sdof::new(Actuation::thesis(moment.layout), &*path, BLEND_BOUNDARY_M, 0.0)
            .unwrap()
            .command(&moment.sensed);
        if widest <= PI / 2.0 - 1e-9 {
            prop_assert!(matches!(command.reason, Reason::Chosen(_)), "{command:?} at {widest} rad");
        }
    }

    #[test]
    fn sdof_gives_every_brake_the_same_force_at_the_tip((moment, path) in moment_and_path()) {
        let command = Sdof::new(Actuation::thesis(moment.layout), &*path, BLEND_BOUNDARY_M, 0.0)
            .unwrap()
            .command(&moment.sensed);
        if let Reason::Chosen(joint) = command.reason {
            let (_, row) = moment.rows().into_iter().find(|(other, _)| *other == joint).unwrap();
            let torque_nm = torque_gain(joint, command.currents_a[joint as usize]);
            let force_n = torque_nm * libm::hypot(row.x, row.y);
            let printed_n = match moment.layout { Layout::ThreeBrake => 19.5, Layout::FourBrake => 22.0 };
            prop_assert!((force_n - printed_n).abs() < 1e-9, "{force_n} N");
        }
    }

    //= thesis (6.12) test
    //= thesis (6.13) test
    #[test]
    fn proportional_picks_the_best_influence_and_its_force((moment, path) in moment_and_path(), gain in 1.3..2900.0_f64) {
        let (beta, _, towards) = field(&*path, &moment.sensed);
        let [v_x, v_y] = turned(moment.sensed.tip_velocity_m_s, beta);
        let towards_n = towards.map_or(0.0, |angle| turned(moment.sensed.tip_force_n, angle)[0]);
        let command = proportional(Actuation::thesis(moment.layout), &*path, gain).command(&moment.sensed);
        prop_assert!(lock(towards_n, v_x, &command).holds(), "{command:?}");
        prop_assert_eq!(command.reason == Reason::LockedMovingBack, v_x < 0.0);
        // A standing tip has no direction; and near-zero components are decided by rounding.
        if v_x < 1e-12 || v_y.abs() < 1e-12 {
            return Ok(());
        }
        // H by small impulses: what becomes of the magnitudes of both components.
        let mut available = Vec::new();
        let mut closest = Vec::new();
        for (joint, row) in moment.rows() {
            let omega = row.dot(&moment.velocity());
            if omega.abs() <= STANDING * row.norm() * moment.velocity().norm() {
                prop_assert!(command.reason != Reason::Chosen(joint), "a joint that stands is braked");
                continue;
            }
            let push = if omega < 0.0 { row } else { -row };
            let [f_x, f_y] = turned(push.into(), beta);
            let small = 1e-3 * v_x.min(v_y.abs()) / libm::hypot(f_x, f_y);
            let change = |v: f64, f: f64| {
                let grown = (v + small * f).abs() - v.abs();
                if (f / libm::hypot(f_x, f_y)).abs() < 1e-9 { 0 } else if grown > 0.0 { 1 } else { -1 }
            };
            let column = [change(v_x, f_x), change(v_y, f_y)];
            available.push(column);
            closest.push((joint, column, f_x / libm::hypot(f_x, f_y), f_y));
            prop_assert!(opposition(push.into(), moment.sensed.tip_velocity_m_s).holds());
        }
        let chosen = match command.reason { Reason::Chosen(joint) => Some(joint), _ => None };
        let column = chosen.map(|joint| closest.iter().find(|(other, ..)| *other == joint).unwrap());
        prop_assert!(best_influence(column.map(|(_, column, ..)| *column), &available).holds(), "{command:?} of {available:?}");
        if let Some((joint, column, closeness, f_y)) = column {
            prop_assert!(f_y * v_y < 0.0, "the force drives the unwanted velocity");
            for (_, other, theirs, _) in closest.iter().filter(|(_, other, ..)| other == column) {
                prop_assert!(theirs <= closeness, "{other:?} is closer");
            }
            let (_, row) = moment.rows().into_iter().find(|(other, _)| other == joint).unwrap();
            let arm = libm::hypot(row.x, row.y);
            let torque_nm = torque_gain(*joint, command.currents_a[*joint as usize]);
            let limit_n = match moment.layout { Layout::ThreeBrake => 19.5, Layout::FourBrake => 22.0 };
            let wanted_n = (gain * v_y.abs()).min(limit_n);
            let least_n = torque_gain(*joint, 0.0) * arm;
            prop_assert!((torque_nm * arm - wanted_n.max(least_n)).abs() < 1e-9);
            if command.currents_a[*joint as usize] > 0.0 {
                prop_assert!(desired_force(moment.layout, torque_nm * arm * (1.0 - 1e-12)).holds());
            }
        }
    }

    #[test]
    fn commands_do_not_depend_on_the_way_a_path_is_drawn(
        moment in moment(), from in [-0.4..-0.2_f64, 0.1..0.5], to in [0.2..0.4_f64, 0.1..0.5],
    ) {
        let (there, back) = (Line::through(from, to).unwrap(), Line::through(to, from).unwrap());
        let tangent = there.nearest(moment.sensed.pose.tip_m).tangent;
        let along_n = tangent.dot(&Vector2::from(moment.sensed.tip_force_n));
        if along_n.abs() < 1e-9 {
            return Ok(());
        }
        for method in Method::ALL {
            let actuation = Actuation::thesis(moment.layout);
            let on = |line| controller(method, GainUnit::PerCentimetre, actuation, line).unwrap().command(&moment.sensed);
            let (there, back) = (on(there), on(back));
            prop_assert_eq!(there.reason, back.reason);
            for (there_a, back_a) in there.currents_a.into_iter().zip(back.currents_a) {
                prop_assert!((there_a - back_a).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn the_random_moments_meet_every_reason() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let mut met = std::collections::HashSet::new();
    for _ in 0..4000 {
        let (moment, path) = moment_and_path().new_tree(&mut runner).unwrap().current();
        for (mut controller, _) in controllers(moment.layout, &*path, 1.7) {
            met.insert(match controller.command(&moment.sensed).reason {
                Reason::ChosenPair(..) => "pair".to_owned(),
                reason => format!("{reason:?}"),
            });
        }
    }
    for expected in [
        "Chosen(A)",
        "Chosen(E)",
        "Chosen(B)",
        "Chosen(C)",
        "pair",
        "LockedPushedAway",
        "LockedMovingBack",
        "InsideGap",
        "FreeSide",
        "NoneHelps",
        "NothingToDo",
    ] {
        assert!(met.contains(expected), "{expected} was never met: {met:?}");
    }
    assert!((0.5 * M_PER_CM - 0.005).abs() < 1e-18);
}
