//! This file says what brakes exert that hold a standing linkage: together the load, each no more than it can, and all as little as can be.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::plant::friction::{DryBrake, standing};
use rigproof_impl::vector::Vector;

struct Draw(Pcg64Mcg);

impl Draw {
    fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn row(&mut self) -> Vector<f64> {
        Vector::new(self.between(-1.3, 1.7), self.between(-1.9, 1.1))
    }

    /// Up to four brakes, some absent, some parallel to another.
    fn brakes(&mut self) -> [DryBrake; 4] {
        let mut rows = [self.row(), self.row(), self.row(), self.row()];
        if self.between(0.0, 1.0) < 0.3 {
            // By powers of two, so that they are parallel exactly.
            rows[1] = rows[0] * -0.5;
            rows[3] = rows[2] * 2.0;
        }
        if self.between(0.0, 1.0) < 0.1 {
            rows = [1.0, -2.0, 0.25, -0.5].map(|factor| rows[0] * factor);
        }
        rows.map(|row| {
            let is_there = self.between(0.0, 1.0) < 0.8;
            let bound = self.between(0.1, 2.3);
            DryBrake {
                force_row: row,
                rate_row: row,
                bound: if is_there { bound } else { 0.0 },
                start_rad_s: 0.0,
            }
        })
    }
}

/// The greatest share of the brakes' strength that a load takes along any line: over the normals of the rows and, for what lies along parallel
/// rows, the rows themselves; beyond one nothing holds it.
fn greatest_share(load: Vector<f64>, brakes: &[DryBrake; 4]) -> f64 {
    let there = || brakes.iter().filter(|brake| brake.bound > 0.0);
    if there().next().is_none() {
        return f64::INFINITY;
    }
    let normals = there().flat_map(|brake| [brake.force_row, brake.force_row.left()]);
    let shares = normals.map(|normal| {
        let strength: f64 = there()
            .map(|brake| brake.bound * brake.force_row.dot(normal).abs())
            .sum();
        let load = load.dot(normal).abs();
        // Along a line on which no brake acts nothing is held and, but for rounding, nothing may be asked.
        if load <= 1e-12 && strength <= 1e-12 {
            0.0
        } else {
            load / strength
        }
    });
    shares.fold(0.0, f64::max)
}

#[test]
fn brakes_at_rest_hold_the_load_and_each_takes_the_same_least_share_of_its_bound_at_most() {
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(2_017));
    let (mut held, mut let_go) = (0, 0);
    for number in 0..40_000 {
        let brakes = draw.brakes();
        let mut load = draw.row() * draw.between(0.3, 2.9);
        if number % 5 == 0 {
            load = brakes[0].force_row * 0.375;
        }
        let share = greatest_share(load, &brakes);
        let Some(dry) = standing(load, &brakes) else {
            assert!(share > 1.0 - 1e-12, "{share} of {brakes:?} under {load:?}");
            let_go += 1;
            continue;
        };
        held += 1;
        assert!(share < 1.0 + 1e-12, "{share} of {brakes:?} under {load:?}");
        let mut left = load;
        for (brake, impulse) in brakes.iter().zip(dry.impulses) {
            left = left + brake.force_row * impulse;
            assert!(
                impulse.abs() <= brake.bound * (share + 1e-12),
                "{brakes:?} under {load:?}"
            );
        }
        assert!(left.norm() < 1e-12, "{left:?} of {load:?} by {brakes:?}");
        assert_eq!(dry.held, brakes.map(|brake| brake.bound > 0.0));
    }
    assert!(held > 8_000 && let_go > 8_000, "{held} held, {let_go} not");
}

#[test]
fn without_a_load_no_brake_exerts_anything() {
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(2_027));
    for _ in 0..100 {
        let dry = standing(Vector::new(0.0, 0.0), &draw.brakes()).unwrap();
        assert_eq!(dry.impulses, [0.0; 4]);
    }
}
