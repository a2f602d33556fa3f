//! This file holds the plant's dry friction against the reference's: the same motion and the same brakes that hold.

use nalgebra::{Matrix2, SMatrix, Vector2};
use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, DryBrake, dry_motion as plant_motion};
use rigproof_impl::vector::Vector;
use rigproof_model::motion::friction::{DryBrakes, dry_motion};

use crate::budget::assert_within_budget;
use crate::rigs::{Draw, campaign};

/// Any two coordinates with up to four brakes, some parallel, some absent, some nearly parallel, loads of all sizes.
fn problem(draw: &mut Draw) -> (Matrix2<f64>, Vector2<f64>, DryBrakes) {
    let (one, other) = (draw.between(0.07, 2.3), draw.between(0.07, 2.3));
    let across = draw.between(-0.97, 0.97) * (one * other).sqrt();
    let mut rows = SMatrix::<f64, 4, 2>::from_fn(|_, _| draw.between(-1.9, 1.9));
    let mut bounds_nm = [0.0; 4].map(|_: f64| draw.between(0.013, 7.5));
    if draw.one_in(4) {
        let parallel = rows.row(1) * -0.73;
        rows.set_row(3, &parallel);
    }
    if draw.one_in(7) {
        let nearly = rows.row(0) * 0.61 + rows.row(2) * 1e-7;
        rows.set_row(2, &nearly);
    }
    if draw.one_in(5) {
        bounds_nm[2] = 0.0;
    }
    let size = libm::pow(10.0, draw.between(-2.0, 1.7));
    let drive = Vector2::new(draw.between(-1.1, 1.1), draw.between(-1.1, 1.1)) * size;
    let mut brakes = DryBrakes { rows, bounds_nm };
    if draw.one_in(9) {
        // Just inside or outside what the brakes can hold.
        let share = brakes.hold(&drive).share * draw.between(0.9999, 1.0001);
        brakes.bounds_nm = brakes.bounds_nm.map(|bound| bound * share);
    }
    (Matrix2::new(one, across, across, other), drive, brakes)
}

#[test]
fn dry_friction_moves_and_holds_as_in_the_reference() {
    let mut draw = Draw::new(9203);
    let mut motions = Vec::new();
    let [mut resting, mut along, mut slipping, mut ties] = [0; 4];
    for _ in 0..campaign(100_000) {
        let (mass, drive, brakes) = problem(&mut draw);
        let expected = dry_motion(&mass, &drive, &brakes);
        let rows = [0, 1, 2, 3].map(|i| Vector::new(brakes.rows[(i, 0)], brakes.rows[(i, 1)]));
        let mut own = [DryBrake::absent(); 4];
        for ((one, row), bound) in own.iter_mut().zip(rows).zip(brakes.bounds_nm) {
            *one = DryBrake {
                force_row: row,
                rate_row: row,
                bound,
                start_rad_s: 0.0,
            };
        }
        let own_mass = Mass {
            aa: mass.m11,
            ab: mass.m12,
            bb: mass.m22,
        };
        let push = Vector::new(drive.x, drive.y);
        let got = plant_motion(&own_mass, Vector::zero(), push, &own, Contact::Rest);
        let off = got.rates_rad_s - Vector::from(expected.motion);
        let reach = drive.norm() + brakes.bounds_nm.iter().sum::<f64>();
        motions.push(off.norm() / (reach * mass.try_inverse().unwrap().norm()));
        match got.contact {
            Contact::Rest => resting += 1,
            Contact::Along { .. } => along += 1,
            Contact::Slipping(_) => slipping += 1,
        }
        if got.held != expected.held {
            // A tie: a brake that holds with exactly its bound, or slips without speed.
            ties += 1;
            let fast = Vector::from(expected.motion).norm();
            let tie = (0..4)
                .filter(|&i| got.held[i] != expected.held[i])
                .all(|i| {
                    let rate = rows[i].dot(expected.motion.into()).abs();
                    let full =
                        (expected.torques_nm[i].abs() / brakes.bounds_nm[i] - 1.0).abs() < 1e-9;
                    rate < 1e-9 * fast * rows[i].norm() && full
                });
            assert!(tie || fast < 1e-9, "{got:?} {expected:?}");
        }
    }
    println!("{resting} rest, {along} along one brake, {slipping} slip, {ties} ties");
    assert!(resting > 1000 || motions.len() < 50_000);
    assert!(along > 1000 || motions.len() < 50_000);
    assert!(slipping > 1000 || motions.len() < 50_000);
    assert_within_budget("plant_dry_motion", motions);
}
