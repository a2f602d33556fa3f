//! This file says what happens where a brake holds with exactly all it can, and where brakes are parallel, nearly so or absent.

use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, DryBrake, dry_motion, standing};
use rigproof_impl::vector::Vector;

use super::oracle::{CLOSE, Draw, kind, reach};

/// One brake on each coordinate, bounds that are met exactly by powers of two.
fn crossed(bounds: [f64; 2]) -> [DryBrake; 4] {
    let mut brakes = [DryBrake::absent(); 4];
    let rows = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)];
    for (brake, (row, bound)) in brakes.iter_mut().zip(rows.into_iter().zip(bounds)) {
        (brake.force_row, brake.rate_row, brake.bound) = (row, row, bound);
    }
    brakes
}

#[test]
fn what_takes_the_whole_strength_is_held_and_what_comes_to_nothing_stands() {
    let mass = Mass {
        aa: 0.5,
        ab: 0.0,
        bb: 0.25,
    };
    let mut brakes = crossed([0.5, 0.25]);
    let at_bound = Vector::new(0.5, 0.1);
    let dry = dry_motion(&mass, Vector::zero(), at_bound, &brakes, Contact::Rest);
    assert_eq!(
        (dry.contact, dry.impulses),
        (Contact::Rest, [-0.5, -0.1, 0.0, 0.0])
    );
    assert_eq!(
        standing(at_bound, &brakes).unwrap().held,
        [true, true, false, false]
    );
    // Slipping brakes that neither start nor end with a rate hold.
    brakes[0].start_rad_s = 0.0;
    let slipping = Contact::Slipping([1.0, 1.0, 0.0, 0.0]);
    let dry = dry_motion(
        &mass,
        Vector::zero(),
        Vector::new(0.5, 0.25),
        &brakes,
        slipping,
    );
    assert_eq!(
        (dry.contact, dry.rates_rad_s),
        (Contact::Rest, Vector::zero())
    );
}

#[test]
fn parallel_brakes_hold_along_their_line_and_what_is_absent_exerts_nothing() {
    let row = Vector::new(0.75, -1.25);
    let mut brakes = [DryBrake::absent(); 4];
    for (i, factor) in [(1, 1.0), (3, -2.0)] {
        (brakes[i].force_row, brakes[i].rate_row, brakes[i].bound) =
            (row * factor, row * factor, 0.375);
    }
    let dry = standing(row * 0.5, &brakes).unwrap();
    assert!(
        (dry.impulses[1] + 0.5 / 3.0).abs() < 1e-15 && (dry.impulses[3] - 0.5 / 3.0).abs() < 1e-15
    );
    assert_eq!([dry.impulses[0], dry.impulses[2]], [0.0; 2]);
    assert_eq!(standing(row * 1.25, &brakes), None);
    assert_eq!(standing(row.left() * 0.01, &brakes), None);
}

#[test]
fn longer_rows_under_smaller_bounds_are_the_same_brakes() {
    let mut draw = Draw::new(3_323);
    let mut parallel = 0;
    for _ in 0..5_000 {
        let (mass, mut brakes, drive) = (draw.mass(), draw.brakes(), draw.plane(7.3));
        // Nearly parallel, by less and more than what counts as parallel.
        let off = libm::pow(10.0, draw.between(-15.0, -7.0));
        let beside = brakes[0].rate_row * 0.7 + brakes[0].rate_row.left() * off;
        (brakes[2].force_row, brakes[2].rate_row) = (beside, beside);
        let dry = dry_motion(&mass, Vector::zero(), drive, &brakes, Contact::Rest);
        parallel += u32::from(dry.held[0] && dry.held[2] && kind(&dry) == 1);
        // By a power of two, so that nothing is rounded otherwise.
        for factor in [1.0 / 4096.0, 512.0] {
            let scaled = brakes.map(|brake| DryBrake {
                force_row: brake.force_row * factor,
                rate_row: brake.rate_row * factor,
                bound: brake.bound / factor,
                ..brake
            });
            let same = dry_motion(&mass, Vector::zero(), drive, &scaled, Contact::Rest);
            assert_eq!(
                (same.rates_rad_s, same.contact, same.held),
                (dry.rates_rad_s, dry.contact, dry.held)
            );
            assert_eq!(same.impulses, dry.impulses.map(|impulse| impulse / factor));
        }
    }
    assert!(parallel > 100, "{parallel}");
}

#[test]
fn where_rows_move_on_within_the_step_the_brakes_are_contradicted_by_no_more_than_that() {
    let mut draw = Draw::new(3_329);
    let mut contradicted = 0;
    for _ in 0..60_000 {
        let (mass, mut brakes) = (draw.mass(), draw.brakes());
        let size = libm::pow(10.0, draw.between(-0.5, 1.0));
        let drive = draw.plane(size);
        for brake in &mut brakes {
            brake.rate_row = brake.rate_row + draw.plane(0.03);
        }
        let dry = dry_motion(&mass, Vector::zero(), drive, &brakes, Contact::Rest);
        let v = dry.rates_rad_s;
        let mut worst: f64 = 0.0;
        for (i, brake) in brakes
            .iter()
            .enumerate()
            .filter(|(_, brake)| brake.bound > 0.0)
        {
            let sine = dry.impulses[i].signum() * brake.rate_row.dot(v)
                / (brake.rate_row.norm() * v.norm() + 1e-300);
            let excess = dry.impulses[i].abs() / brake.bound - 1.0;
            worst = worst.max(if dry.held[i] { excess } else { sine });
        }
        contradicted += u32::from(worst > 1e-9);
        assert!(
            worst < 0.3,
            "{worst}: {dry:?} of {brakes:?} under {drive:?}"
        );
    }
    println!("{contradicted} contradicted");
}

#[test]
fn at_the_edge_between_holding_and_slipping_the_motion_is_that_of_both() {
    let mut draw = Draw::new(3_331);
    for _ in 0..60_000 {
        let (mass, mut brakes) = (draw.mass(), draw.brakes());
        // Whatever the size of all impulses.
        let size = libm::exp2(libm::round(draw.between(-45.0, 70.0)));
        for brake in &mut brakes {
            brake.bound *= size;
        }
        // A joint that stands while its brake exerts all it can: rounding alone says whether it holds.
        let edge = (draw.next() % 4) as usize;
        let row = brakes[edge].rate_row;
        let v = Vector::new(-row.y, row.x)
            * (libm::pow(10.0, draw.between(-7.0, 0.7)) * draw.sign() * size);
        let whole = draw.sign();
        let exerted = brakes.map(|brake| {
            let rate = brake.rate_row.dot(v);
            let is_still = rate.abs() <= 1e-12 * brake.rate_row.norm() * v.norm();
            let along = brake.force_row.dot(row).signum();
            brake.force_row
                * brake.bound
                * if is_still {
                    whole * along
                } else {
                    -rate.signum()
                }
        });
        let drive = exerted
            .into_iter()
            .fold(mass.times(v), |sum, one| sum - one);
        let dry = dry_motion(&mass, Vector::zero(), drive, &brakes, Contact::Rest);
        let off = mass.times(dry.rates_rad_s - v).norm();
        assert!(
            off < CLOSE * reach(drive, &brakes),
            "{off:e} {v:?}: {dry:?} of {brakes:?} under {drive:?}"
        );
    }
}
