//! This file holds the plant's dry friction against the reference's: the same motion and the same brakes that hold.

use nalgebra::{Matrix2, SMatrix, Vector2};
use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, DryBrake, dry_motion as plant_motion};
use rigproof_impl::vector::Vector;
use rigproof_model::motion::friction::{DryBrakes, dry_motion};

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::{Draw, campaign};

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

/// A step that begins with rates and goes on as it was until a joint turns back, worked with the reference's solution of the friction: the rates
/// at its end, and whether the step was divided. `held` is a brake that holds, `signs` are those of the others.
fn going_on(
    mass: &Matrix2<f64>,
    rates: Vector2<f64>,
    impulse: Vector2<f64>,
    brakes: &DryBrakes,
    (held, signs): (Option<usize>, [f64; 4]),
) -> (Vector2<f64>, bool) {
    let momentum = mass * rates;
    let ends = |drive: Vector2<f64>, share: f64| {
        let bounds_nm = brakes.bounds_nm.map(|bound| bound * share);
        Vector2::from(
            dry_motion(
                mass,
                &drive,
                &DryBrakes {
                    bounds_nm,
                    ..*brakes
                },
            )
            .motion,
        )
    };
    // The brakes that slip push; the one that holds does so with whatever it takes.
    let pushing = (0..4).fold(momentum + impulse, |sum, i| {
        sum - brakes.rows.row(i).transpose() * (signs[i] * brakes.bounds_nm[i])
    });
    let holding = |i: usize| if held == Some(i) { 1e6 } else { 0.0 };
    let bounds_nm = [0, 1, 2, 3].map(holding);
    let on = dry_motion(
        mass,
        &pushing,
        &DryBrakes {
            bounds_nm,
            ..*brakes
        },
    );
    let end = Vector2::from(on.motion);
    let strength = held.map_or(f64::INFINITY, |held| {
        let row = brakes.rows.row(held);
        let parallel = (0..4).filter(|&i| signs[i] == 0.0);
        let shares = parallel.map(|i| brakes.bounds_nm[i] * brakes.rows.row(i).norm());
        shares.sum::<f64>() / row.norm()
    });
    if held.is_some_and(|held| on.torques_nm[held].abs() > strength) {
        return (ends(momentum + impulse, 1.0), false);
    }
    let turned = (0..4).filter(|&i| brakes.bounds_nm[i] > 0.0 && signs[i] != 0.0);
    let turned = turned.filter_map(|i| {
        let [before, after] = [rates, end].map(|v| signs[i] * (brakes.rows.row(i) * v).x);
        (after <= 0.0).then(|| before / (before - after))
    });
    let part = turned.fold(1.0, f64::min);
    if part >= 1.0 {
        return (ends(momentum + impulse, 1.0), false);
    }
    let at_turn = momentum + mass * (end - rates) * part;
    (ends(at_turn + impulse * (1.0 - part), 1.0 - part), true)
}

#[test]
fn a_step_goes_on_as_it_was_until_a_joint_turns_back_as_the_reference_divided_there() {
    let mut draw = Draw::new(4409);
    let mut motions = Vec::new();
    let [mut divided, mut held_on, mut slipped_on] = [0; 3];
    for k in 0..campaign(40_000) {
        let (mass, impulse, brakes) = problem(&mut draw);
        let row = |i: usize| brakes.rows.row(i).transpose();
        let held = (k % 2 == 0 && brakes.bounds_nm[k / 2 % 4] > 0.0).then_some(k / 2 % 4);
        let size = libm::pow(10.0, draw.between(-1.5, 2.0));
        let rates = match held {
            Some(held) => Vector2::new(-row(held).y, row(held).x) * draw.between(-size, size),
            None => Vector2::new(draw.between(-size, size), draw.between(-size, size)),
        };
        let along = |i: usize| {
            held.is_some_and(|held| {
                row(i).perp(&row(held)).abs() <= 1e-12 * row(i).norm() * row(held).norm()
            })
        };
        let signs = [0, 1, 2, 3].map(|i| {
            if along(i) {
                0.0
            } else {
                (brakes.rows.row(i) * rates).x.signum()
            }
        });
        let (expected, is_divided) = going_on(&mass, rates, impulse, &brakes, (held, signs));
        let mut own = [DryBrake::absent(); 4];
        for (i, one) in own.iter_mut().enumerate() {
            let row = Vector::new(row(i).x, row(i).y);
            *one = DryBrake {
                force_row: row,
                rate_row: row,
                bound: brakes.bounds_nm[i],
                start_rad_s: row.dot(Vector::new(rates.x, rates.y)),
            };
        }
        let own_mass = Mass {
            aa: mass.m11,
            ab: mass.m12,
            bb: mass.m22,
        };
        let last = match held {
            Some(held) => Contact::Along { held, signs },
            None => Contact::Slipping(signs),
        };
        let plane = |v: Vector2<f64>| Vector::new(v.x, v.y);
        let got = plant_motion(&own_mass, plane(mass * rates), plane(impulse), &own, last);
        let off = got.rates_rad_s - plane(expected);
        let reach = impulse.norm() + (mass * rates).norm() + brakes.bounds_nm.iter().sum::<f64>();
        motions.push(off.norm() / (reach * mass.try_inverse().unwrap().norm()));
        assert_eq!(got.part < 1.0, is_divided, "{got:?} {held:?} {signs:?}");
        divided += u32::from(is_divided);
        held_on += u32::from(!is_divided && got.contact == last && held.is_some());
        slipped_on += u32::from(!is_divided && got.contact == last && held.is_none());
    }
    println!("{divided} divided, {held_on} held on, {slipped_on} slipped on");
    assert!(divided > 1000 && held_on > 1000 && slipped_on > 1000 || motions.len() < 40_000);
    assert_within_budget("plant_dry_going_on", motions);
}
