//! This file says that dry friction on two coordinates is solved exactly.

use nalgebra::{Matrix2, SMatrix, Vector2};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_model::motion::friction::{Dry, DryBrakes, dry_motion};

/// Draws `count` values of a strategy.
fn draw<S: Strategy>(strategy: S, count: usize) -> Vec<S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).unwrap().current())
        .collect()
}

#[derive(Clone, Copy, Debug)]
struct Problem {
    mass: Matrix2<f64>,
    drive: Vector2<f64>,
    brakes: DryBrakes,
}

/// Any two coordinates with up to four brakes; every fourth problem has two parallel ones, every fifth lacks one.
fn problem() -> impl Strategy<Value = Problem> {
    let mass = (0.07..2.3_f64, 0.07..2.3_f64, -0.97..0.97_f64);
    let rows = prop::array::uniform8(-1.9..1.9_f64);
    let bounds = prop::array::uniform4(0.013..7.5_f64);
    let drive = (-11.0..11.0_f64, -11.0..11.0_f64, 0.03..1.7_f64);
    (mass, rows, bounds, drive, 0_u8..20).prop_map(|(mass, rows, mut bounds_nm, drive, kind)| {
        let (m_1, m_2, part) = mass;
        let across = part * (m_1 * m_2).sqrt();
        let mut rows = SMatrix::<f64, 4, 2>::from_row_slice(&rows);
        if kind % 4 == 0 {
            let parallel = rows.row(1) * -0.73;
            rows.set_row(3, &parallel);
        }
        if kind % 5 == 0 {
            bounds_nm[2] = 0.0;
        }
        Problem {
            mass: Matrix2::new(m_1, across, across, m_2),
            drive: Vector2::new(drive.0, drive.1) * drive.2,
            brakes: DryBrakes { rows, bounds_nm },
        }
    })
}

/// The greatest violation of balance, bounds and opposition, by the size of what is balanced.
fn inclusion_residual(problem: &Problem, dry: &Dry) -> f64 {
    let Problem {
        mass,
        drive,
        brakes,
    } = problem;
    let motion = Vector2::from(dry.motion);
    let mut balance = mass * motion - drive;
    let mut worst: f64 = 0.0;
    let force: f64 = drive.norm() + brakes.bounds_nm.iter().sum::<f64>();
    let speed = 1e-12 + force / mass.norm();
    for i in 0..4 {
        let (row, bound, torque) = (
            brakes.rows.row(i).transpose(),
            brakes.bounds_nm[i],
            dry.torques_nm[i],
        );
        balance -= row * torque;
        let rate = row.dot(&motion);
        worst = worst.max((torque.abs() - bound) / force);
        // λ = −bound·sign(rate) is the same as rate·λ = −bound·|rate|.
        worst = worst.max((rate * torque + bound * rate.abs()) / force / speed);
    }
    worst.max(balance.norm() / force)
}

#[test]
fn dry_motion_meets_its_inclusion() {
    let (mut cases, mut worst): ([u32; 3], f64) = ([0; 3], 0.0);
    for problem in draw(problem(), 40_000) {
        let dry = dry_motion(&problem.mass, &problem.drive, &problem.brakes);
        let residual = inclusion_residual(&problem, &dry);
        assert!(
            residual < 1e-10,
            "{residual:e} left in {problem:?}: {dry:?}"
        );
        worst = worst.max(residual);
        let case = if dry.motion == [0.0; 2] {
            0
        } else if dry.held.contains(&true) {
            1
        } else {
            2
        };
        cases[case] += 1;
    }
    println!("at rest, along one direction, free: {cases:?}; greatest residual {worst:e}");
    // Every branch of the solution is taken often enough to be tested.
    assert!(cases.iter().all(|&count| count > 2000), "{cases:?}");
}

#[test]
fn dry_motion_is_the_only_one() {
    // A maximal monotone law has one motion: a second solver, by descent on the convex energy that the motion
    // minimises, ½·vᵀMv − r·v + Σ bound·|G·v|, can find none lower.
    for (problem, steps) in draw((problem(), prop::array::uniform32(-1.0..1.0_f64)), 4000) {
        let energy = |v: &Vector2<f64>| {
            let friction: f64 = (problem.brakes.rows * v)
                .iter()
                .zip(problem.brakes.bounds_nm)
                .map(|(rate, bound)| bound * rate.abs())
                .sum();
            0.5 * v.dot(&(problem.mass * v)) - problem.drive.dot(v) + friction
        };
        let motion =
            Vector2::from(dry_motion(&problem.mass, &problem.drive, &problem.brakes).motion);
        let least = energy(&motion);
        for (k, pair) in steps.chunks(2).enumerate() {
            let size = libm::exp2(-2.0 * k as f64);
            let other = motion + Vector2::new(pair[0], pair[1]) * size;
            let slack = 1e-12 * (1.0 + least.abs());
            assert!(
                energy(&other) >= least - slack,
                "{problem:?} moves better by {other}"
            );
        }
    }
}

#[test]
fn two_brakes_by_hand() {
    // Unit masses apart, brakes on both coordinates of 1.3 and 0.7: each coordinate for itself.
    let rows = SMatrix::<f64, 4, 2>::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
    let brakes = DryBrakes {
        rows,
        bounds_nm: [1.3, 0.0, 0.7, 0.0],
    };
    let mass = Matrix2::new(2.0, 0.0, 0.0, 0.5);
    let dry = |x, y| dry_motion(&mass, &Vector2::new(x, y), &brakes);
    let close = |actual: [f64; 2], by_hand: [f64; 2]| {
        assert!(
            (Vector2::from(actual) - Vector2::from(by_hand)).amax() < 1e-14,
            "{actual:?}"
        );
    };
    close(dry(1.1, -0.6).motion, [0.0, 0.0]);
    close(dry(2.1, -0.6).motion, [0.4, 0.0]);
    assert_eq!(dry(2.1, -0.6).held, [false, false, true, false]);
    close(dry(2.1, -0.9).motion, [0.4, -0.4]);
    assert_eq!(dry(2.1, -0.9).torques_nm, [-1.3, 0.0, 0.7, 0.0]);
    assert!((brakes.hold(&Vector2::new(0.65, 0.07)).share - 0.5).abs() < 1e-15);
}
