//! This file says how two coordinates move against up to four dry brakes: the exact solution in finitely many cases.
//!
//! As in the reference, with three differences that a time step asks for. A brake's torque acts where the forces are looked at, but its
//! joint's rate is that at the end of the step: two rows a brake. What the brakes did in the last step is tried first; the
//! solution is one, so that the order of the cases does not change it. And where a slipping joint turns back within the step, the
//! step is divided at that moment: opposed to the rate at the end all along, the torque would be wrong before it.

mod dry_brake;
mod rest;

use super::form::Mass;
use crate::vector::Vector;

pub use dry_brake::DryBrake;

type Plane = Vector<f64>;

/// What the brakes of a rig do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// The linkage stands.
    Rest,
    /// One brake and those parallel to it hold; the linkage moves along.
    Along {
        /// Which of A, E, B, C.
        held: usize,
        /// The signs of the rates of the others.
        signs: [f64; 4],
    },
    /// Every brake slips, with these signs of the rates.
    Slipping([f64; 4]),
}

/// What the brakes let happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dry {
    /// The rates of the two coordinates.
    pub rates_rad_s: Plane,
    /// Impulses of A, E, B, C on their joints, N·m·s, of the part of the step after the last turn.
    pub impulses: [f64; 4],
    /// That part: 1 where no joint turned back.
    pub part: f64,
    /// Which brakes hold their joint.
    pub held: [bool; 4],
    /// What the brakes do.
    pub contact: Contact,
}

/// The rates after a step that begins with `momentum` and adds `impulse`, N·m·s, against brakes that did `last` in the step before.
///
/// M·v = r + Σ Gᵢᵀ·λᵢ, where λᵢ opposes the joint's rate with its bound, or is any impulse inside it where the joint stands:
///
/// 1. v = 0 if and only if −r lies in the zonotope Σ Gᵢᵀ·[−boundᵢ, boundᵢ], a polygon whose sides are parallel to the Gᵢ;
/// 2. else v runs along a direction that one brake, or several parallel ones, holds;
/// 3. else v lies in one of the sectors between these directions, where every sign is known.
///
/// The first case that is consistent is the answer; where rounding leaves none, the one with the smallest contradiction is.
#[inline(always)]
pub fn dry_motion(
    mass: &Mass<f64>,
    momentum: Plane,
    impulse: Plane,
    brakes: &[DryBrake; 4],
    last: Contact,
) -> Dry {
    let drive = momentum + impulse;
    let whole = Problem {
        mass,
        drive,
        brakes,
    };
    let (signs, dry) = match last {
        Contact::Rest => return whole.rest().unwrap_or_else(|| whole.any()),
        // A brake that acts now and did not has no sign to go on with.
        Contact::Slipping(signs) if knows(brakes, signs) => (signs, whole.sector(signs)),
        Contact::Slipping(_) => return whole.any(),
        Contact::Along { held, signs } => match whole.holding(held, signs) {
            Some(dry) => (signs, dry),
            None => return whole.any(),
        },
    };
    let before = first_turn(brakes, signs, dry.rates_rad_s);
    if before >= 1.0 {
        return dry;
    }
    // Up to the turn everything went on as it was; from there on the brakes are free to do what they must.
    let until = (impulse + sum(brakes, dry.impulses)) * before;
    let part = 1.0 - before;
    let mut left = *brakes;
    for brake in &mut left {
        brake.bound *= part;
    }
    let rest = Problem {
        mass,
        drive: momentum + until + impulse * part,
        brakes: &left,
    };
    Dry { part, ..rest.any() }
}

/// What the brakes do if the linkage stands and goes on standing under an impulse, N·m·s; none if they cannot hold it.
pub fn standing(impulse: Plane, brakes: &[DryBrake; 4]) -> Option<Dry> {
    let none = Mass {
        aa: 0.0,
        ab: 0.0,
        bb: 0.0,
    };
    let problem = Problem {
        mass: &none,
        drive: impulse,
        brakes,
    };
    problem.rest()
}

/// Whether every brake that acts has a sign.
#[inline]
fn knows(brakes: &[DryBrake; 4], signs: [f64; 4]) -> bool {
    let mut pairs = brakes.iter().zip(signs);
    pairs.all(|(brake, sign)| sign != 0.0 || !brake.acts())
}

/// The part of a step, up to which every slipping joint keeps its sign if the rates change evenly; 1 where all do.
#[inline]
fn first_turn(brakes: &[DryBrake; 4], signs: [f64; 4], rates_rad_s: Plane) -> f64 {
    let mut first = 1.0;
    for (brake, sign) in brakes.iter().zip(signs) {
        let end = sign * brake.rate_row.dot(rates_rad_s);
        if end <= 0.0 && sign != 0.0 && brake.acts() {
            let start = sign * brake.start_rad_s;
            let part = if start > 0.0 {
                start / (start - end)
            } else {
                0.0
            };
            first = if part < first { part } else { first };
        }
    }
    first
}

struct Problem<'a> {
    mass: &'a Mass<f64>,
    drive: Plane,
    brakes: &'a [DryBrake; 4],
}

impl Problem<'_> {
    /// The motion if a brake goes on holding while the others slip as they did; none where it cannot.
    fn holding(&self, held: usize, signs: [f64; 4]) -> Option<Dry> {
        let brake = self.brakes.get(held).filter(|brake| brake.acts())?;
        let (share, dry) = self.along(held, brake, signs);
        (share.abs() <= 1.0).then_some(dry)
    }

    /// The motion, whatever the brakes did before.
    fn any(&self) -> Dry {
        if let Some(dry) = self.rest() {
            return dry;
        }
        let mut best: Option<(f64, Dry)> = None;
        let cases = || {
            self.brakes
                .iter()
                .enumerate()
                .filter(|(_, brake)| brake.acts())
        };
        let one_held = cases().map(|(held, brake)| self.one_held(held, brake));
        let sectors = cases().flat_map(|(_, brake)| {
            [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(way, side)| {
                let dry = self.sector(self.signs(brake, way, side));
                (self.contradiction(&dry), dry)
            })
        });
        for (contradiction, dry) in one_held.chain(sectors) {
            if contradiction <= 0.0 {
                return dry;
            }
            if best.is_none_or(|(least, _)| contradiction < least) {
                best = Some((contradiction, dry));
            }
        }
        best.map_or_else(|| self.sector([0.0; 4]), |(_, dry)| dry)
    }

    /// The motion that one brake and those parallel to it let through, and how far it contradicts their bounds.
    fn one_held(&self, index: usize, brake: &DryBrake) -> (f64, Dry) {
        let direction = brake.rate_row.left();
        let push = brake.force_row.left().dot(self.drive);
        let way = push.signum();
        let signs = self.brakes.map(|other| {
            let component = other.rate(direction);
            if component == 0.0 {
                0.0
            } else {
                way * component.signum()
            }
        });
        let (share, dry) = self.along(index, brake, signs);
        let against = -way * direction.dot(dry.rates_rad_s);
        (f64::max(share.abs() - 1.0, against), dry)
    }

    /// The motion if one brake and those parallel to it, whose sign is 0, hold, and the part of their strength that this takes.
    fn along(&self, index: usize, brake: &DryBrake, signs: [f64; 4]) -> (f64, Dry) {
        let direction = brake.rate_row.left();
        let row = brake.force_row;
        let mut held = [false; 4];
        let mut impulses = [0.0; 4];
        let mut strength = 0.0;
        let places = held.iter_mut().zip(&mut impulses);
        for ((is_held, impulse), (other, sign)) in places.zip(self.brakes.iter().zip(signs)) {
            *is_held = sign == 0.0 && other.acts();
            *impulse = -sign * other.bound;
            if *is_held {
                strength += other.bound * other.force_row.dot(row).abs();
            }
        }
        let load = self.drive + sum(self.brakes, impulses);
        let accelerated = self.mass.times(direction);
        let speed = row.left().dot(load) / row.left().dot(accelerated);
        // What is missing lies along the row and is what the brakes hold with.
        let missing = accelerated * speed - load;
        let share = missing.dot(row) / strength;
        for ((impulse, other), is_held) in impulses.iter_mut().zip(self.brakes).zip(held) {
            if is_held {
                *impulse = share * other.bound * other.force_row.dot(row).signum();
            }
        }
        let dry = Dry {
            rates_rad_s: direction * speed,
            impulses,
            part: 1.0,
            held,
            contact: Contact::Along { held: index, signs },
        };
        (share, dry)
    }

    /// The motion if every brake slips with a given sign.
    #[inline]
    fn sector(&self, signs: [f64; 4]) -> Dry {
        let mut impulses = signs;
        for (impulse, brake) in impulses.iter_mut().zip(self.brakes) {
            *impulse *= -brake.bound;
        }
        Dry {
            rates_rad_s: self.mass.solve(self.drive + sum(self.brakes, impulses)),
            impulses,
            part: 1.0,
            held: [false; 4],
            contact: Contact::Slipping(signs),
        }
    }

    /// How far a motion contradicts the signs of its impulses: the greatest sine, squared with its sign.
    fn contradiction(&self, dry: &Dry) -> f64 {
        let Contact::Slipping(signs) = dry.contact else {
            return f64::INFINITY;
        };
        let motion = dry.rates_rad_s;
        let acting = self
            .brakes
            .iter()
            .zip(signs)
            .filter(|(brake, _)| brake.acts());
        let sines = acting.map(|(brake, sign)| {
            let rate = -sign * brake.rate_row.dot(motion);
            rate * rate.abs() / (brake.rate_row.norm_squared() * motion.norm_squared())
        });
        sines.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The signs of the rates in the sector on one side of the direction that a brake lets through.
    fn signs(&self, brake: &DryBrake, way: f64, side: f64) -> [f64; 4] {
        let direction = brake.rate_row.left() * way;
        self.brakes.map(|other| {
            let component = other.rate(direction);
            if component == 0.0 {
                side * other.rate_row.dot(brake.rate_row).signum()
            } else {
                component.signum()
            }
        })
    }
}

/// What impulses of the brakes come to.
#[inline]
fn sum(brakes: &[DryBrake; 4], impulses: [f64; 4]) -> Plane {
    let each = brakes.iter().zip(impulses);
    each.fold(Vector::zero(), |sum, (brake, impulse)| {
        sum + brake.force_row * impulse
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const MASS: Mass<f64> = Mass {
        aa: 0.53,
        ab: 0.11,
        bb: 0.37,
    };

    fn brakes(bounds: [f64; 4], rates_rad_s: Plane) -> [DryBrake; 4] {
        let rows = [(1.0, 0.0), (-1.3, 0.7), (0.0, 1.0), (0.4, -1.9)];
        let mut brakes = rows.map(|(x, y)| {
            let row = Vector::new(x, y);
            DryBrake {
                force_row: row,
                rate_row: row,
                bound: 0.0,
                start_rad_s: row.dot(rates_rad_s),
            }
        });
        for (brake, bound) in brakes.iter_mut().zip(bounds) {
            brake.bound = bound;
        }
        brakes
    }

    fn from_rest(drive: Plane, bounds: [f64; 4]) -> Dry {
        let brakes = brakes(bounds, Vector::zero());
        dry_motion(&MASS, Vector::zero(), drive, &brakes, Contact::Rest)
    }

    #[test]
    fn a_load_that_the_brakes_can_hold_moves_nothing() {
        let dry = from_rest(Vector::new(0.23, -0.31), [0.17, 0.23, 0.19, 0.13]);
        assert_eq!(dry.rates_rad_s, Vector::zero());
        assert_eq!(dry.held, [true; 4]);
    }

    #[test]
    fn no_brake_leaves_the_motion_free() {
        let drive = Vector::new(0.23, -0.31);
        let dry = from_rest(drive, [0.0; 4]);
        assert_eq!(dry.rates_rad_s, MASS.solve(drive));
        assert_eq!(dry.held, [false; 4]);
    }

    #[test]
    fn a_brake_that_went_on_holding_still_does() {
        let bounds = [0.017, 0.41, 0.019, 0.013];
        let drive = Vector::new(0.43, 0.7);
        let fresh = from_rest(drive, bounds);
        assert_eq!(fresh.held, [false, true, false, false]);
        let brakes = brakes(bounds, fresh.rates_rad_s * 0.3);
        let momentum = MASS.times(fresh.rates_rad_s * 0.3);
        let again = dry_motion(&MASS, momentum, drive - momentum, &brakes, fresh.contact);
        assert_eq!(again.held, fresh.held);
        assert!((again.rates_rad_s - fresh.rates_rad_s).norm() < 1e-15);
    }

    #[test]
    fn a_joint_that_turns_back_is_braked_one_way_and_then_the_other() {
        // Brake B alone, on a diagonal mass: 0.37·v falls from 0.011 under −0.043 − 0.019 to nothing, and on under −0.043 + 0.019.
        let mass = Mass { ab: 0.0, ..MASS };
        let rates = Vector::new(0.0, 0.011 / 0.37);
        let brakes = brakes([0.0, 0.0, 0.019, 0.0], rates);
        let impulse = Vector::new(0.0, -0.043);
        let last = Contact::Slipping([0.0, 0.0, 1.0, 0.0]);
        let dry = dry_motion(&mass, mass.times(rates), impulse, &brakes, last);
        let left = 1.0 - 0.011 / 0.062;
        assert!((dry.part - left).abs() < 1e-15);
        assert!((dry.rates_rad_s.y + 0.024 * left / 0.37).abs() < 1e-15);
    }
}
