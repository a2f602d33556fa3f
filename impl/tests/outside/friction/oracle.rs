//! This file draws brakes and says what makes a motion against them the right one.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, Dry, DryBrake};
use rigproof_impl::vector::Vector;

pub type Plane = Vector<f64>;

/// Rounding, as a part of all impulses together.
pub const CLOSE: f64 = 1e-11;

pub struct Draw(Pcg64Mcg);

impl Draw {
    pub fn new(seed: u64) -> Draw {
        Draw(Pcg64Mcg::seed_from_u64(seed))
    }

    pub fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn one_in(&mut self, many: u64) -> bool {
        self.0.next_u64().is_multiple_of(many)
    }

    pub fn next(&mut self) -> u64 {
        self.0.next_u64()
    }

    pub fn plane(&mut self, size: f64) -> Plane {
        Vector::new(self.between(-size, size), self.between(-size, size))
    }

    pub fn sign(&mut self) -> f64 {
        if self.one_in(2) { 1.0 } else { -1.0 }
    }

    pub fn mass(&mut self) -> Mass<f64> {
        let (aa, bb) = (self.between(0.07, 2.3), self.between(0.07, 2.3));
        let ab = self.between(-0.97, 0.97) * libm::sqrt(aa * bb);
        Mass { aa, ab, bb }
    }

    /// Up to four brakes, some absent, some parallel to another.
    pub fn brakes(&mut self) -> [DryBrake; 4] {
        let mut rows = [0; 4].map(|_| self.plane(1.9));
        if self.one_in(3) {
            // By powers of two, so that they are parallel exactly.
            rows[1] = rows[0] * -0.5;
            rows[3] = rows[2] * 2.0;
        }
        if self.one_in(11) {
            rows = [1.0, -2.0, 0.25, -0.5].map(|factor| rows[0] * factor);
        }
        rows.map(|row| DryBrake {
            force_row: row,
            rate_row: row,
            bound: if self.one_in(5) {
                0.0
            } else {
                self.between(0.07, 2.3)
            },
            start_rad_s: 0.0,
        })
    }
}

/// All impulses together, N·m·s: what rounding is a part of.
pub fn reach(drive: Plane, brakes: &[DryBrake; 4]) -> f64 {
    let each = brakes
        .iter()
        .map(|brake| brake.bound * brake.force_row.norm());
    drive.norm() + each.sum::<f64>()
}

/// The motion in which a drive, N·m·s, ends, found by trying all: the least of ½·vᵀ·M·v − v·drive + Σ bound·|row·v| over rest, every
/// direction that a brake lets through and every choice of signs.
pub fn tried(mass: &Mass<f64>, drive: Plane, brakes: &[DryBrake; 4]) -> Plane {
    let cost = |v: Plane| {
        let against = brakes
            .iter()
            .map(|brake| brake.bound * brake.rate_row.dot(v).abs());
        0.5 * v.dot(mass.times(v)) - v.dot(drive) + against.sum::<f64>()
    };
    let mut found = Vector::zero();
    let mut consider = |v: Plane| {
        if cost(v) < cost(found) {
            found = v;
        }
    };
    for held in brakes.iter().filter(|brake| brake.bound > 0.0) {
        let row = held.rate_row;
        let along = Vector::new(-row.y, row.x);
        let parallel =
            |brake: &DryBrake| (brake.rate_row.x * row.y - brake.rate_row.y * row.x).abs() < 1e-12;
        let slipping = brakes.iter().filter(|brake| !parallel(brake));
        let friction: f64 = slipping
            .map(|brake| brake.bound * brake.rate_row.dot(along).abs())
            .sum();
        let push = along.dot(drive);
        let left = (push.abs() - friction).max(0.0) * push.signum();
        consider(along * (left / along.dot(mass.times(along))));
    }
    for choice in 0..16_u32 {
        let mut load = drive;
        for (place, brake) in brakes.iter().enumerate() {
            let sign = if choice >> place & 1 == 1 { 1.0 } else { -1.0 };
            load = load - brake.rate_row * (sign * brake.bound);
        }
        let det = mass.aa * mass.bb - mass.ab * mass.ab;
        consider(Vector::new(
            (mass.bb * load.x - mass.ab * load.y) / det,
            (mass.aa * load.y - mass.ab * load.x) / det,
        ));
    }
    found
}

/// Which of the three kinds of motion it was.
pub fn kind(dry: &Dry) -> usize {
    match dry.contact {
        Contact::Rest => 0,
        Contact::Along { .. } => 1,
        Contact::Slipping(_) => 2,
    }
}

/// Momentum is kept, and every brake does what it says it does and what a dry brake may do. `drive`, N·m·s, is momentum and impulse at the
/// beginning of the part of the step that `dry` speaks of.
pub fn assert_right(mass: &Mass<f64>, drive: Plane, brakes: &[DryBrake; 4], dry: &Dry) {
    let what = || format!("{dry:?} of {brakes:?} under {drive:?} with {mass:?}");
    let v = dry.rates_rad_s;
    let close = CLOSE * reach(drive, brakes);
    let pushed = brakes.iter().zip(dry.impulses);
    let sum = pushed.fold(drive, |sum, (brake, impulse)| {
        sum + brake.force_row * impulse
    });
    assert!((sum - mass.times(v)).norm() <= close, "{}", what());
    let signs = match dry.contact {
        Contact::Rest => [0.0; 4],
        Contact::Along { held, signs } => {
            assert!(dry.held[held] && signs[held] == 0.0, "{}", what());
            signs
        }
        Contact::Slipping(signs) => signs,
    };
    for (i, brake) in brakes.iter().enumerate() {
        let (rate, impulse) = (brake.rate_row.dot(v), dry.impulses[i]);
        // A rate of rounding has no sign.
        let still = 1e-12 * brake.rate_row.norm() * v.norm();
        assert!(impulse.abs() <= brake.bound * (1.0 + CLOSE), "{}", what());
        assert_eq!(
            dry.held[i],
            brake.bound > 0.0 && signs[i] == 0.0 && kind(dry) < 2,
            "{}",
            what()
        );
        if dry.held[i] {
            assert!(rate.abs() <= still, "{}", what());
        } else {
            assert_eq!(impulse.abs(), brake.bound, "{}", what());
            assert!(impulse * rate <= brake.bound * still, "{}", what());
            let is_told = brake.bound == 0.0 || rate.abs() <= still || signs[i] == rate.signum();
            assert!(is_told, "{}", what());
        }
    }
    // Parallel brakes that hold share the load by their strength.
    if let Contact::Along { held, .. } = dry.contact {
        let share = |i: usize| dry.impulses[i] / brakes[i].bound;
        for i in (0..4).filter(|&i| dry.held[i]) {
            let same = brakes[i].force_row.dot(brakes[held].force_row).signum();
            assert!((share(i) - same * share(held)).abs() < 1e-13, "{}", what());
        }
    }
}
