//! This file says that what brakes did in the last step goes on until a joint turns back, and no longer.

use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, DryBrake, dry_motion};
use rigproof_impl::vector::Vector;

use super::oracle::{Draw, Plane, assert_right, kind, reach};

/// A motion that the brakes were already in: rates, and what they did.
fn going_on(draw: &mut Draw, brakes: &[DryBrake; 4]) -> (Plane, Contact) {
    let sign = |rate: f64| {
        if rate.abs() < 1e-12 {
            0.0
        } else {
            rate.signum()
        }
    };
    let held = (draw.next() % 4) as usize;
    if brakes[held].bound > 0.0 && draw.one_in(2) {
        let row = brakes[held].rate_row;
        let rates = Vector::new(-row.y, row.x) * draw.between(-2.3, 2.3);
        let mut signs = brakes.map(|brake| sign(brake.rate_row.dot(rates)));
        signs[held] = 0.0;
        return (rates, Contact::Along { held, signs });
    }
    let rates = draw.plane(2.3);
    (
        rates,
        Contact::Slipping(brakes.map(|brake| sign(brake.rate_row.dot(rates)))),
    )
}

/// The signs of the rates of the joints that slip.
fn signs_of(last: Contact) -> [f64; 4] {
    match last {
        Contact::Slipping(signs) | Contact::Along { signs, .. } => signs,
        Contact::Rest => [0.0; 4],
    }
}

/// How the rates change if all goes on, signs kept and what held still holding, and the part of its strength that this takes.
fn all_going_on(
    mass: &Mass<f64>,
    impulse: Plane,
    brakes: &[DryBrake; 4],
    last: Contact,
) -> (Plane, f64) {
    let signs = signs_of(last);
    let slipped = brakes.iter().zip(signs);
    let pushed = slipped.fold(impulse, |sum, (brake, sign)| {
        sum - brake.force_row * (sign * brake.bound)
    });
    if let Contact::Along { held, .. } = last {
        let row = brakes[held].rate_row;
        let along = Vector::new(-row.y, row.x);
        let change = along * (along.dot(pushed) / along.dot(mass.times(along)));
        let missing = mass.times(change) - pushed;
        let parallel = brakes.iter().zip(signs).filter(|(_, sign)| *sign == 0.0);
        let strength: f64 = parallel
            .map(|(brake, _)| brake.bound * brake.force_row.norm())
            .sum();
        return (change, missing.norm() / strength);
    }
    let det = mass.aa * mass.bb - mass.ab * mass.ab;
    let change = Vector::new(
        (mass.bb * pushed.x - mass.ab * pushed.y) / det,
        (mass.aa * pushed.y - mass.ab * pushed.x) / det,
    );
    (change, 0.0)
}

/// The first moment at which a slipping joint stands, as a part of the step; infinite where none does.
fn first_turn(brakes: &[DryBrake; 4], last: Contact, rates: Plane, change: Plane) -> f64 {
    let slipping = brakes.iter().zip(signs_of(last));
    let slipping = slipping.filter(|(brake, sign)| brake.bound > 0.0 && *sign != 0.0);
    let turns = slipping.map(|(brake, _)| {
        let (start, by) = (brake.rate_row.dot(rates), brake.rate_row.dot(change));
        if start * by < 0.0 {
            -start / by
        } else {
            f64::INFINITY
        }
    });
    turns.fold(f64::INFINITY, f64::min)
}

#[test]
fn what_goes_on_until_a_joint_turns_back_is_right_before_and_after() {
    let mut draw = Draw::new(3_313);
    let (mut went_on, mut divided, mut anew) = ([0; 3], 0, 0);
    for _ in 0..40_000 {
        let (mass, mut brakes) = (draw.mass(), draw.brakes());
        let (rates, last) = going_on(&mut draw, &brakes);
        for brake in &mut brakes {
            brake.start_rad_s = brake.rate_row.dot(rates);
        }
        let momentum = mass.times(rates);
        let size = libm::pow(10.0, draw.between(-1.0, 1.3));
        let impulse = draw.plane(size);
        let dry = dry_motion(&mass, momentum, impulse, &brakes, last);
        let (change, share) = all_going_on(&mass, impulse, &brakes, last);
        if share > 1.0 {
            // It cannot go on holding: anew, from the start.
            if share > 1.0 + 1e-9 {
                assert_right(&mass, momentum + impulse, &brakes, &dry);
                assert_eq!(dry.part, 1.0);
                anew += 1;
            }
            continue;
        }
        let first = first_turn(&brakes, last, rates, change);
        if (first - 1.0).abs() < 1e-9 {
            continue;
        }
        if first > 1.0 {
            assert_eq!(dry.part, 1.0, "{first}: {dry:?} {last:?}");
            assert_eq!(dry.contact, last);
            assert!(
                (dry.rates_rad_s - rates - change).norm() < 1e-9 * (rates.norm() + change.norm())
            );
            assert_right(&mass, momentum + impulse, &brakes, &dry);
            went_on[kind(&dry)] += 1;
            continue;
        }
        assert!(
            (dry.part - (1.0 - first)).abs() < 1e-9,
            "{first}: {dry:?} {last:?}"
        );
        let mut left = brakes;
        for brake in &mut left {
            brake.bound *= dry.part;
        }
        let drive = mass.times(rates + change * (1.0 - dry.part)) + impulse * dry.part;
        assert_right(&mass, drive, &left, &dry);
        divided += 1;
    }
    assert!(went_on[1] > 2_000 && went_on[2] > 2_000, "{went_on:?}");
    assert!(divided > 8_000 && anew > 2_000, "{divided} {anew}");
}

#[test]
fn a_joint_already_on_its_way_back_turns_at_once() {
    let mut draw = Draw::new(3_319);
    for _ in 0..2_000 {
        // Signs of the last step that no rate bears out: everything is asked anew.
        let (mass, mut brakes, drive) = (draw.mass(), draw.brakes(), draw.plane(4.1));
        let signs = [0; 4].map(|_| draw.sign());
        for (brake, sign) in brakes.iter_mut().zip(signs) {
            brake.start_rad_s = -sign * draw.between(0.03, 1.7);
        }
        let dry = dry_motion(
            &mass,
            Vector::zero(),
            drive,
            &brakes,
            Contact::Slipping(signs),
        );
        let fresh = dry_motion(&mass, Vector::zero(), drive, &brakes, Contact::Rest);
        assert_eq!(dry.part, 1.0);
        let off = mass.times(dry.rates_rad_s - fresh.rates_rad_s);
        assert!(
            off.norm() < 1e-11 * reach(drive, &brakes),
            "{dry:?} {fresh:?}"
        );
        // Nor does a brake go on that had no sign.
        let dry = dry_motion(
            &mass,
            Vector::zero(),
            drive,
            &brakes,
            Contact::Slipping([0.0; 4]),
        );
        assert_eq!(dry.rates_rad_s, fresh.rates_rad_s);
    }
}
