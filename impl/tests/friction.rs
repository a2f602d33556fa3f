//! This file says what makes a motion against dry brakes the right one: momentum is kept, and every brake opposes its joint with its whole
//! bound or holds it with no more. Nothing else decides, since the motion that obeys this is one.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_impl::plant::form::Mass;
use rigproof_impl::plant::friction::{Contact, Dry, DryBrake, dry_motion, standing};
use rigproof_impl::vector::Vector;

type Plane = Vector<f64>;

/// Rounding, as a part of all impulses together.
const CLOSE: f64 = 1e-11;

struct Draw(Pcg64Mcg);

impl Draw {
    fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_in(&mut self, many: u64) -> bool {
        self.0.next_u64().is_multiple_of(many)
    }

    fn plane(&mut self, size: f64) -> Plane {
        Vector::new(self.between(-size, size), self.between(-size, size))
    }

    fn sign(&mut self) -> f64 {
        if self.one_in(2) { 1.0 } else { -1.0 }
    }

    fn mass(&mut self) -> Mass<f64> {
        let (aa, bb) = (self.between(0.07, 2.3), self.between(0.07, 2.3));
        let ab = self.between(-0.97, 0.97) * libm::sqrt(aa * bb);
        Mass { aa, ab, bb }
    }

    /// Up to four brakes, some absent, some parallel to another.
    fn brakes(&mut self) -> [DryBrake; 4] {
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
fn reach(drive: Plane, brakes: &[DryBrake; 4]) -> f64 {
    let each = brakes
        .iter()
        .map(|brake| brake.bound * brake.force_row.norm());
    drive.norm() + each.sum::<f64>()
}

/// The motion in which a drive, N·m·s, ends, found by trying all: the least of ½·vᵀ·M·v − v·drive + Σ bound·|row·v| over rest, every
/// direction that a brake lets through and every choice of signs.
fn tried(mass: &Mass<f64>, drive: Plane, brakes: &[DryBrake; 4]) -> Plane {
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
fn kind(dry: &Dry) -> usize {
    match dry.contact {
        Contact::Rest => 0,
        Contact::Along { .. } => 1,
        Contact::Slipping(_) => 2,
    }
}

/// Momentum is kept, and every brake does what it says it does and what a dry brake may do. `drive`, N·m·s, is momentum and impulse at the
/// beginning of the part of the step that `dry` speaks of.
fn assert_right(mass: &Mass<f64>, drive: Plane, brakes: &[DryBrake; 4], dry: &Dry) {
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

#[test]
fn of_all_motions_against_brakes_the_one_that_obeys_them_is_taken() {
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_301));
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

impl Draw {
    fn next(&mut self) -> u64 {
        self.0.next_u64()
    }
}

#[test]
fn what_goes_on_until_a_joint_turns_back_is_right_before_and_after() {
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_313));
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
        // What the brakes would do if all went on: signs kept, and what held still holding, found by the direction it leaves.
        let signs = match last {
            Contact::Slipping(signs) | Contact::Along { signs, .. } => signs,
            Contact::Rest => unreachable!(),
        };
        let slipped = brakes.iter().zip(signs);
        let pushed = slipped.fold(impulse, |sum, (brake, sign)| {
            sum - brake.force_row * (sign * brake.bound)
        });
        let det = mass.aa * mass.bb - mass.ab * mass.ab;
        let mut change = Vector::new(
            (mass.bb * pushed.x - mass.ab * pushed.y) / det,
            (mass.aa * pushed.y - mass.ab * pushed.x) / det,
        );
        if let Contact::Along { held, .. } = last {
            let row = brakes[held].rate_row;
            let along = Vector::new(-row.y, row.x);
            change = along * (along.dot(pushed) / along.dot(mass.times(along)));
            let missing = mass.times(change) - pushed;
            let parallel = |i: &usize| signs[*i] == 0.0;
            let strength: f64 = (0..4)
                .filter(parallel)
                .map(|i| brakes[i].bound * brakes[i].force_row.norm())
                .sum();
            let excess = missing.norm() / strength - 1.0;
            if excess > 0.0 {
                // It cannot go on holding: anew, from the start.
                if excess > 1e-9 {
                    assert_right(&mass, momentum + impulse, &brakes, &dry);
                    assert_eq!(dry.part, 1.0);
                    anew += 1;
                }
                continue;
            }
        }
        // The first moment at which a slipping joint stands.
        let turns = brakes
            .iter()
            .zip(signs)
            .filter(|(brake, sign)| brake.bound > 0.0 && *sign != 0.0);
        let turns = turns.map(|(brake, _)| {
            let (start, by) = (brake.rate_row.dot(rates), brake.rate_row.dot(change));
            if start * by < 0.0 {
                -start / by
            } else {
                f64::INFINITY
            }
        });
        let first = turns.fold(f64::INFINITY, f64::min);
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
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_319));
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
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_323));
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
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_329));
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
    let mut draw = Draw(Pcg64Mcg::seed_from_u64(3_331));
    for _ in 0..60_000 {
        let (mass, mut brakes) = (draw.mass(), draw.brakes());
        // Whatever the size of all impulses.
        let size = libm::exp2(libm::round(draw.between(-20.0, 70.0)));
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
