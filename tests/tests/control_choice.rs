//! This file says what the controllers of chapter 2 choose, against plain searches, and which settings are refused.

use core::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use rigproof_model::ModelError;
use rigproof_model::brake::torque_gain;
use rigproof_model::control::path::{Line, Path};
use rigproof_model::control::torque_translation::{Share, translate};
use rigproof_model::control::{
    Actuation, Controller, Impedance, JointRow, Obstacle, Optimal, Proportional, Sdof, Sensed,
    Side, VelocityRatio, Virtual, Weights,
};
use rigproof_model::linkage::{Pose, forward, jacobian::jacobian, limits};
use rigproof_spec::command::Reason;
use rigproof_spec::geometry::{angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::opposition;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::STANDING;
use rigproof_spec::tables::torque_gain_fit;
use rigproof_tests::cases;

#[derive(Clone, Debug)]
struct Moment {
    layout: Layout,
    sensed: Sensed,
    rows: Vec<JointRow>,
    line: Line,
}

impl Moment {
    fn velocity(&self) -> Vector2<f64> {
        Vector2::from(self.sensed.tip_velocity_m_s)
    }

    fn row(&self, joint: Joint) -> Vector2<f64> {
        self.rows
            .iter()
            .find(|(other, _)| *other == joint)
            .unwrap()
            .1
    }
}

/// A pose inside table 4.2, moving, with a line that passes within 9 cm.
fn moment() -> impl Strategy<Value = Moment> {
    let layout = prop::sample::select(vec![Layout::ThreeBrake, Layout::FourBrake]);
    let motion = (0.0013..0.41_f64, -PI..PI, 0.13..21.0_f64, -PI..PI);
    let path = (-0.09..0.09_f64, -PI..PI);
    (layout, 0.18..3.13_f64, 0.0..2.96_f64, motion, path).prop_filter_map(
        "inside table 4.2",
        |(layout, a, b, (speed, heading, push, aim), (aside, angle))| {
            let pose = forward::pose(&arms(layout), a, b).ok()?;
            limits::check(&angle_ranges(layout), &pose).ok()?;
            let j = jacobian(&arms(layout), &pose).ok()?;
            let polar = |r: f64, angle: f64| [r * libm::cos(angle), r * libm::sin(angle)];
            let tip_velocity_m_s = polar(speed, heading);
            let sensed = Sensed {
                pose,
                tip_velocity_m_s,
                omega_rad_s: (j * Vector2::from(tip_velocity_m_s)).into(),
                tip_force_n: polar(push, aim),
            };
            let all = Joint::ALL.into_iter().zip(j.row_iter());
            let rows = all
                .filter(|(joint, _)| layout.brakes().contains(joint))
                .map(|(joint, row)| (joint, row.transpose()))
                .collect();
            // A joint that stands has no direction (gap `joint-at-rest`): `impl_laws` asks for it by itself.
            let stands = |row: &Vector2<f64>| {
                let rate = row.dot(&Vector2::from(tip_velocity_m_s)).abs();
                rate <= 2.0 * STANDING * row.norm() * speed
            };
            let rows: Vec<(Joint, Vector2<f64>)> = rows;
            if rows.iter().any(|(_, row)| stands(row)) {
                return None;
            }
            let [x, y] = pose.tip_m;
            let [dx, dy] = polar(1.0, angle);
            let from = [x - aside * dy, y + aside * dx];
            let line = Line::through(from, [from[0] + dx, from[1] + dy]).ok()?;
            Some(Moment {
                layout,
                sensed,
                rows,
                line,
            })
        },
    )
}

/// What each brake pushes the tip with at 1 N·m.
fn pushes(moment: &Moment) -> Vec<Vector2<f64>> {
    let against = |row: &Vector2<f64>| row * -row.dot(&moment.velocity()).signum();
    moment.rows.iter().map(|(_, row)| against(row)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(20_000),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn translated_torques_make_the_wanted_direction(moment in moment(), size in 0.3..90.0_f64, angle in -PI..PI) {
        let wanted = Vector2::new(size * libm::cos(angle), size * libm::sin(angle));
        let pushes = pushes(&moment);
        // Whether the wanted direction lies between the two of any pair, by angles, and how far from any edge.
        let (mut between, mut edge_rad, mut least_nm) = (false, PI, f64::INFINITY);
        let from = |a: Vector2<f64>, b: Vector2<f64>| {
            libm::remainder(libm::atan2(b.y, b.x) - libm::atan2(a.y, a.x), 2.0 * PI)
        };
        for (k, first) in pushes.iter().enumerate() {
            for second in pushes.iter().skip(k + 1) {
                let (width, way) = (from(*first, *second), from(*first, wanted));
                let inside = if width > 0.0 { (0.0..=width).contains(&way) } else { (width..=0.0).contains(&way) };
                between |= inside;
                if inside {
                    // The law of sines in the triangle of the two forces and their sum.
                    let first_nm = libm::sin(width - way) / (libm::sin(width) * first.norm());
                    let second_nm = libm::sin(way) / (libm::sin(width) * second.norm());
                    least_nm = least_nm.min(size * (first_nm + second_nm));
                }
            }
            edge_rad = from(*first, wanted).abs().min(edge_rad);
        }
        match translate(&moment.rows, moment.velocity(), wanted) {
            Some([first, second]) => {
                let made = |Share { joint, torque_nm }| {
                    let row = moment.row(joint);
                    row * (-row.dot(&moment.velocity()).signum() * torque_nm)
                };
                for share in [first, second] {
                    prop_assert!(share.torque_nm >= 0.0);
                    prop_assert!(share.torque_nm <= torque_gain_fit(share.joint).greatest_nm() * (1.0 + 1e-12));
                }
                let sum = made(first) + made(second);
                prop_assert!(wanted.perp(&sum).abs() <= 1e-8 * wanted.norm() * sum.norm());
                prop_assert!(wanted.dot(&sum) > 0.0 && sum.norm() <= wanted.norm() * (1.0 + 1e-9));
                prop_assert!(opposition(sum.into(), moment.sensed.tip_velocity_m_s).holds());
                // Scaled back to the wanted size, no other pair needs less.
                let needed_nm = (first.torque_nm + second.torque_nm) * size / sum.norm();
                prop_assert!(needed_nm <= least_nm * (1.0 + 1e-7), "{needed_nm} N·m, not {least_nm} N·m");
            }
            None => prop_assert!(!between || edge_rad < 1e-9, "a pair makes that direction"),
        }
        if !between && edge_rad > 1e-9 {
            prop_assert!(translate(&moment.rows, moment.velocity(), wanted).is_none());
        }
    }

    #[test]
    fn impedance_falls_back_to_the_part_across_then_along(moment in moment(), stiffness in 40.0..900.0_f64) {
        let elements = Virtual {
            stiffness_n_per_m: stiffness,
            damping_across_n_s_per_m: 23.0,
            damping_along_n_s_per_m: 7.1,
        };
        let actuation = Actuation::thesis(moment.layout);
        let command = Impedance::new(actuation, moment.line, elements).unwrap().command(&moment.sensed);
        let nearest = moment.line.nearest(moment.sensed.pose.tip_m);
        let (t, n) = (nearest.tangent, Vector2::new(-nearest.tangent.y, nearest.tangent.x));
        let v = moment.velocity();
        let across = n * -(stiffness * nearest.offset_m + 23.0 * n.dot(&v));
        let along = t * -(7.1 * t.dot(&v));
        let first = [across + along, across, along]
            .into_iter()
            .find_map(|wanted| translate(&moment.rows, v, wanted));
        match (first, command.reason) {
            (Some([a, b]), Reason::ChosenPair(joint_a, joint_b)) => {
                prop_assert_eq!([a.joint, b.joint], [joint_a, joint_b]);
                for share in [a, b] {
                    let given_nm = torque_gain(share.joint, command.currents_a[share.joint as usize]);
                    let least_nm = torque_gain(share.joint, 0.0);
                    prop_assert!((given_nm - share.torque_nm.max(least_nm)).abs() < 1e-9);
                }
            }
            (None, Reason::NoneHelps) => {}
            other => prop_assert!(false, "{other:?}"),
        }
    }

    #[test]
    fn velocity_ratio_turns_the_link_speeds_towards_the_desired_ones(moment in moment(), gain in 0.7..9.0_f64) {
        let actuation = Actuation::thesis(moment.layout);
        let command = VelocityRatio::new(actuation, moment.line, 0.05, gain).unwrap().command(&moment.sensed);
        let nearest = moment.line.nearest(moment.sensed.pose.tip_m);
        let desired = rigproof_model::control::desired_velocity::desired_velocity(
            &nearest, Vector2::from(moment.sensed.tip_force_n), 0.05,
        ).direction;
        let links = |v: Vector2<f64>| Vector2::new(moment.row(Joint::A).dot(&v), moment.row(Joint::B).dot(&v));
        let (actual, wanted) = (links(moment.velocity()), links(desired));
        let Reason::Chosen(joint) = command.reason else {
            // Both links are too fast: neither moves as desired.
            if let Reason::ChosenPair(a, b) = command.reason {
                prop_assert_eq!([a, b], [Joint::A, Joint::B]);
                prop_assert!(actual.x * wanted.x <= 0.0 && actual.y * wanted.y <= 0.0);
            }
            return Ok(());
        };
        // What the brake takes from the two links: its row in terms of the link speeds.
        let base = Matrix2::new(
            moment.row(Joint::A).x, moment.row(Joint::A).y, moment.row(Joint::B).x, moment.row(Joint::B).y,
        );
        let through = base.transpose().try_inverse().unwrap() * moment.row(joint);
        let taken = through * -through.dot(&actual).signum();
        let turn = |speeds: Vector2<f64>| libm::atan2(wanted.perp(&speeds), wanted.dot(&speeds)).abs();
        // A step far below the angle that is left, or it would turn past the desired motion.
        let small = 1e-6 * turn(actual).min(1.0) * actual.norm() / taken.norm();
        prop_assert!(turn(actual + taken * small) <= turn(actual) + 1e-12, "{command:?} turns away");
        prop_assert!(taken.x * actual.x + taken.y * actual.y <= 0.0);
        // Of two coupling brakes that help, the one with the greater lever on the link that is too fast.
        if matches!(joint, Joint::E | Joint::C) {
            let a_is_fast = wanted.x / actual.x < wanted.y / actual.y;
            let lever = |joint: Joint| {
                let through = base.transpose().try_inverse().unwrap() * moment.row(joint);
                let taken = through * -through.dot(&actual).signum();
                let (fast, other) = if a_is_fast { ((taken.x, actual.x), (taken.y, actual.y)) } else { ((taken.y, actual.y), (taken.x, actual.x)) };
                (fast.0 * fast.1 < 0.0 && other.0 * other.1 > 0.0).then_some(fast.0.abs())
            };
            let ours = lever(joint);
            prop_assert!(ours.is_some(), "{command:?} does not help");
            for rival in moment.layout.brakes().iter().filter(|brake| matches!(brake, Joint::E | Joint::C)) {
                prop_assert!(lever(*rival).is_none_or(|theirs| theirs <= ours.unwrap() * (1.0 + 1e-9)));
            }
        }
    }

    #[test]
    fn optimal_costs_no_more_than_any_other_brake_and_level(
        moment in moment(), angle in 0.1..3.0_f64, energy in 0.01..2.0_f64, horizon_s in 0.003..0.05_f64,
    ) {
        let mass = Matrix2::new(3.7, 0.31, 0.31, 2.9);
        let weights = Weights { angle, energy, horizon_s };
        let actuation = Actuation::thesis(moment.layout);
        let inertia = move |_: &Pose| Some(mass);
        let command = Optimal::new(actuation, moment.line, 0.05, weights, inertia).unwrap().command(&moment.sensed);
        let nearest = moment.line.nearest(moment.sensed.pose.tip_m);
        let push = Vector2::from(moment.sensed.tip_force_n);
        let desired = rigproof_model::control::desired_velocity::desired_velocity(&nearest, push, 0.05).direction;
        let v = moment.velocity();
        let kinetic = |v: Vector2<f64>| 0.5 * (3.7 * v.x * v.x + 2.0 * 0.31 * v.x * v.y + 2.9 * v.y * v.y);
        let cost = |after: Vector2<f64>| {
            let off = libm::acos((after.dot(&desired) / after.norm()).clamp(-1.0, 1.0));
            angle * off * off + energy * libm::pow(kinetic(after) / kinetic(v) - 1.0, 2.0)
        };
        let after = |push: Vector2<f64>| v + mass.try_inverse().unwrap() * push * horizon_s;
        // The force that the command gives, and every level that turns no joint round.
        let limit_n = actuation.greatest_force_n();
        let brake = |joint: Joint, force_n: f64| {
            let row = moment.row(joint);
            row * (-row.dot(&v).signum() * force_n / row.norm())
        };
        let mut least = cost(after(push));
        for (joint, row) in &moment.rows {
            for level in 1..=20 {
                let next = after(push + brake(*joint, limit_n * f64::from(level) / 20.0));
                if row.dot(&next) * row.dot(&v) > 0.0 {
                    least = least.min(cost(next));
                }
            }
        }
        let chosen = match command.reason {
            Reason::Chosen(joint) => {
                let off_state_n = torque_gain(joint, 0.0) * moment.row(joint).norm();
                let force_n = torque_gain(joint, command.currents_a[joint as usize]) * moment.row(joint).norm();
                prop_assert!(force_n <= limit_n * (1.0 + 1e-9) || command.currents_a[joint as usize] == 0.0);
                // Below the off-state torque the current no longer tells which force was meant.
                if force_n <= off_state_n * (1.0 + 1e-9) { return Ok(()); }
                cost(after(push + brake(joint, force_n)))
            }
            _ => cost(after(push)),
        };
        prop_assert!(chosen <= least + 1e-6 * least.max(1e-3), "{chosen} against {least}: {command:?}");
    }
}

#[test]
fn an_obstacle_lets_the_tip_out_and_leads_it_along_its_boundary() {
    // A wall y = 0.35 m, solid above. 1 cm inside, the operator pushes up and to the right.
    let arms = arms(Layout::FourBrake);
    let wall = Line::through([-0.31, 0.35], [0.29, 0.35]).unwrap();
    let at = |tip_m, tip_force_n| Sensed {
        pose: rigproof_model::linkage::inverse::pose(&arms, tip_m).unwrap(),
        tip_velocity_m_s: [0.031, 0.017],
        omega_rad_s: [0.1, 0.2, 0.3, 0.4],
        tip_force_n,
    };
    let inner = Sdof::new(Actuation::thesis(Layout::FourBrake), wall, 0.05, 0.0).unwrap();
    let mut obstacle = Obstacle::new(wall, Side::Left, inner);
    assert!((obstacle.depth_m([0.07, 0.36]) - 0.01).abs() < 1e-15);
    let inside = obstacle.command(&at([0.07, 0.36], [2.3, 6.1]));
    assert!(
        inside.currents_a.iter().any(|current_a| *current_a > 0.0),
        "{inside:?}"
    );
    let outside = obstacle.command(&at([0.07, 0.34], [2.3, 6.1]));
    assert_eq!(
        (outside.reason, outside.currents_a),
        (Reason::FreeSide, [0.0; 4])
    );
}

/// The message of a refused setting.
fn refused(result: Result<(), ModelError>, expected: &str) {
    let error = result.unwrap_err();
    assert!(matches!(error, ModelError::SettingRange { .. }));
    assert_eq!(error.to_string(), expected);
}

#[test]
fn settings_out_of_range_are_named() {
    let actuation = Actuation::thesis(Layout::FourBrake);
    let line = Line::through([-0.31, 0.35], [0.29, 0.37]).unwrap();
    for (boundary_m, gap_m, expected) in [
        (
            0.05,
            -0.0031,
            "the gap around the path is -0.0031 m; it must lie between 0 m and 0.05 m",
        ),
        (
            0.05,
            0.0501,
            "the gap around the path is 0.0501 m; it must lie between 0 m and 0.05 m",
        ),
        (
            0.05,
            f64::NAN,
            "the gap around the path is NaN m; it must lie between 0 m and 0.05 m",
        ),
        (
            0.0,
            0.0,
            "the boundary of the velocity field is 0 m; it must lie between 0.0000001 m and 0.61 m",
        ),
        (
            f64::NAN,
            0.0,
            "the boundary of the velocity field is NaN m; it must lie between 0.0000001 m and 0.61 m",
        ),
    ] {
        refused(
            Sdof::new(actuation, line, boundary_m, gap_m).map(|_| ()),
            expected,
        );
    }
    for (gain, expected) in [
        (
            -5.0,
            "the proportional gain is -5 N·s/m; it must lie between 0 N·s/m and 1000000 N·s/m",
        ),
        (
            f64::INFINITY,
            "the proportional gain is inf N·s/m; it must lie between 0 N·s/m and 1000000 N·s/m",
        ),
    ] {
        refused(
            Proportional::new(actuation, line, 0.05, gain).map(|_| ()),
            expected,
        );
    }
}

#[test]
fn settings_of_the_controllers_of_chapter_2_are_named() {
    let actuation = Actuation::thesis(Layout::FourBrake);
    let line = Line::through([-0.31, 0.35], [0.29, 0.37]).unwrap();
    let ratio = VelocityRatio::new(actuation, line, 0.05, -0.3).map(|_| ());
    refused(
        ratio,
        "the gain is -0.3 N·m·s/rad; it must lie between 0 N·m·s/rad and 1000000 N·m·s/rad",
    );
    let elements = Virtual {
        stiffness_n_per_m: -40.0,
        damping_across_n_s_per_m: 3.0,
        damping_along_n_s_per_m: 3.0,
    };
    let impedance = Impedance::new(actuation, line, elements).map(|_| ());
    refused(
        impedance,
        "the virtual stiffness is -40 N/m; it must lie between 0 N/m and 1000000 N/m",
    );
    let weights = Weights {
        angle: 0.7,
        energy: 0.3,
        horizon_s: 0.0,
    };
    let optimal = Optimal::new(actuation, line, 0.05, weights, |_: &Pose| None).map(|_| ());
    refused(
        optimal,
        "the horizon is 0 s; it must lie between 0.000001 s and 1 s",
    );
    let limit = Actuation::new(Layout::FourBrake, arms(Layout::FourBrake), -3.0).map(|_| ());
    refused(
        limit,
        "the greatest desired force is -3 N; it must lie between 0 N and 1000 N",
    );
}
