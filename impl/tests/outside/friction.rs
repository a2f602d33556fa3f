//! Whether a motion against dry brakes is the right one: momentum is kept, and every brake opposes its joint with its whole bound or holds it
//! with no more. Nothing else decides, since the motion that obeys this is one.

mod edges;
mod going_on;
mod oracle;

use rigproof_impl::plant::friction::{Contact, dry_motion};
use rigproof_impl::vector::Vector;

use oracle::{Draw, assert_right, kind, reach, tried};

#[test]
fn of_all_motions_against_brakes_the_one_that_obeys_them_is_taken() {
    let mut draw = Draw::new(3_301);
    let mut kinds = [0; 3];
    for number in 0..30_000 {
        let (mass, brakes) = (draw.mass(), draw.brakes());
        let size = libm::pow(10.0, draw.between(-1.0, 1.7));
        let mut drive = draw.plane(size);
        if number % 7 == 0 {
            // So that parallel brakes hold: a push along what one lets through, and something across.
            let row = brakes[number % 4].rate_row;
            drive = Vector::new(-row.y, row.x) * draw.between(-9.0, 9.0)
                + row * draw.between(-0.1, 0.1);
        }
        let dry = dry_motion(&mass, Vector::zero(), drive, &brakes, Contact::Rest);
        assert_right(&mass, drive, &brakes, &dry);
        assert_eq!(dry.part, 1.0);
        let off = mass.times(dry.rates_rad_s - tried(&mass, drive, &brakes));
        assert!(
            off.norm() < 1e-7 * reach(drive, &brakes),
            "{off:?}: {dry:?} of {brakes:?} under {drive:?}"
        );
        kinds[kind(&dry)] += 1;
    }
    assert!(kinds.iter().all(|&count| count > 3_000), "{kinds:?}");
}
