//! This file moves many rigs at once: the free plant, eight rigs to a block, one number of each side by side.
//!
//! A lane computes what [`Motion::step_free`] computes, in its order: sums, products, quotients and roots, which every width of
//! vector unit rounds alike. So a rig moves the same, bit for bit, alone, in a block and on any processor. The widest unit that
//! is there is found when the program runs.
#![expect(
    clippy::indexing_slicing,
    reason = "indices run over the lanes of a block"
)]

extern crate std;

mod lane;

use pulp::{Arch, NullaryFnOnce};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use crate::linkage::linkage;
use crate::plant::motion::{Checks, Mechanism, Motion, Outcome, Scheme};
use crate::vector::Vector;
use lane::Lane;

/// Rigs in a block.
pub const LANES: usize = 8;

/// One number of each rig of a block.
pub type Lanes = [f64; LANES];

/// Rigs of one kind, to be moved together.
#[derive(Clone, Copy, Debug)]
pub struct Batch {
    arch: Arch,
    mechanism: Mechanism<Lane>,
}

/// Eight rigs in motion, without brakes.
///
/// A rig whose step does not come to [`Outcome::Moved`] stands where it is from there on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    theta_rad: [Lanes; 2],
    rates_rad_s: [Lanes; 2],
    accelerations_rad_s2: [Lanes; 2],
    ae: [Lanes; 2],
    bc: [Lanes; 2],
    /// As numbers, so that they go side by side with the others.
    outcomes: Lanes,
}

impl Batch {
    /// Rigs of these arms and masses.
    pub fn new(arms: &Arms, inertia: &Inertia, scheme: Scheme) -> Batch {
        Batch {
            arch: Arch::new(),
            mechanism: Mechanism::new(arms, inertia, scheme),
        }
    }

    /// One step of every rig under a force on its tip, x and y, N; a block of forces for every block of rigs.
    pub fn step_free(&self, blocks: &mut [Block], forces_n: &[[Lanes; 2]], step_s: f64) {
        let mechanism = &self.mechanism;
        self.arch.dispatch(FreeStep {
            mechanism,
            blocks,
            forces_n,
            step_s,
        });
    }
}

/// A step of every block, for whichever vector unit there is.
struct FreeStep<'a> {
    mechanism: &'a Mechanism<Lane>,
    blocks: &'a mut [Block],
    forces_n: &'a [[Lanes; 2]],
    step_s: f64,
}

impl NullaryFnOnce for FreeStep<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        // Copies, which the compiler can see to lie apart.
        let (mechanism, step_s) = (*self.mechanism, self.step_s);
        for (block, force_n) in self.blocks.iter_mut().zip(self.forces_n) {
            let (mut moved, force_n) = (*block, *force_n);
            moved.step_free(&mechanism, &force_n, step_s);
            *block = moved;
        }
    }
}

impl Block {
    /// Eight rigs; `None` where the linkage of one is not sound.
    pub fn new(
        batch: &Batch,
        theta_rad: [[f64; 2]; LANES],
        rates_rad_s: [[f64; 2]; LANES],
    ) -> Option<Block> {
        let none = [0.0; LANES];
        let mut block = Block {
            theta_rad: [none; 2],
            rates_rad_s: [none; 2],
            accelerations_rad_s2: [none; 2],
            ae: [none; 2],
            bc: [none; 2],
            outcomes: [MOVED; LANES],
        };
        for lane in 0..LANES {
            let motion = Motion::new(
                &batch.mechanism,
                vector(theta_rad[lane]),
                vector(rates_rad_s[lane]),
            )?;
            block.put(lane, &motion);
        }
        Some(block)
    }

    /// θA and θB of a rig, rad.
    pub fn base_angles_rad(&self, lane: usize) -> Option<[f64; 2]> {
        (lane < LANES).then(|| numbers(&self.theta_rad, lane))
    }

    /// Their rates, rad/s.
    pub fn base_rates_rad_s(&self, lane: usize) -> Option<[f64; 2]> {
        (lane < LANES).then(|| numbers(&self.rates_rad_s, lane))
    }

    /// What the last step of each rig came to.
    pub fn outcomes(&self) -> [Outcome; LANES] {
        self.outcomes.map(|found| {
            let known = CODES.into_iter().find(|(code, _)| *code == found);
            known.map_or(Outcome::Undefined, |(_, outcome)| outcome)
        })
    }

    #[inline(always)]
    fn step_free(&mut self, mechanism: &Mechanism<Lane>, force_n: &[Lanes; 2], step_s: f64) {
        for lane in 0..LANES {
            let motion = self.motion(mechanism, lane);
            let force_n = vector(numbers(force_n, lane));
            let (next, checks) = motion.after_free(mechanism, force_n, Lane(step_s));
            let before = self.outcomes[lane];
            let outcome = if before == MOVED {
                code(checks)
            } else {
                before
            };
            self.outcomes[lane] = outcome;
            let moved = outcome == MOVED;
            let kept = Motion {
                theta_rad: either(moved, next.theta_rad, motion.theta_rad),
                rates_rad_s: either(moved, next.rates_rad_s, motion.rates_rad_s),
                accelerations_rad_s2: either(
                    moved,
                    next.accelerations_rad_s2,
                    motion.accelerations_rad_s2,
                ),
                ae: either(moved, next.ae, motion.ae),
                bc: either(moved, next.bc, motion.bc),
                ..motion
            };
            self.put(lane, &kept);
        }
    }

    #[inline(always)]
    fn motion(&self, mechanism: &Mechanism<Lane>, lane: usize) -> Motion<Lane> {
        let (ae, bc) = (
            vector(numbers(&self.ae, lane)),
            vector(numbers(&self.bc, lane)),
        );
        Motion {
            theta_rad: vector(numbers(&self.theta_rad, lane)),
            rates_rad_s: vector(numbers(&self.rates_rad_s, lane)),
            accelerations_rad_s2: vector(numbers(&self.accelerations_rad_s2, lane)),
            ae,
            bc,
            linkage: linkage(&mechanism.shape, ae, bc),
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, motion: &Motion<Lane>) {
        put(&mut self.theta_rad, lane, motion.theta_rad);
        put(&mut self.rates_rad_s, lane, motion.rates_rad_s);
        put(
            &mut self.accelerations_rad_s2,
            lane,
            motion.accelerations_rad_s2,
        );
        put(&mut self.ae, lane, motion.ae);
        put(&mut self.bc, lane, motion.bc);
    }
}

/// Outcomes as numbers.
const CODES: [(f64, Outcome); 4] = [
    (MOVED, Outcome::Moved),
    (SINGULAR, Outcome::Singular),
    (TOO_FAST, Outcome::TooFast),
    (UNDEFINED, Outcome::Undefined),
];
const MOVED: f64 = 0.0;
const SINGULAR: f64 = 1.0;
const TOO_FAST: f64 = 2.0;
const UNDEFINED: f64 = 3.0;

#[inline(always)]
fn code(checks: Checks) -> f64 {
    let stopped = if checks.singular { SINGULAR } else { MOVED };
    let stopped = if checks.too_fast { TOO_FAST } else { stopped };
    if checks.undefined { UNDEFINED } else { stopped }
}

#[inline(always)]
fn vector([x, y]: [f64; 2]) -> Vector<Lane> {
    Vector::new(Lane(x), Lane(y))
}

#[inline(always)]
fn numbers(of: &[Lanes; 2], lane: usize) -> [f64; 2] {
    [of[0][lane], of[1][lane]]
}

#[inline(always)]
fn put(place: &mut [Lanes; 2], lane: usize, vector: Vector<Lane>) {
    place[0][lane] = vector.x.0;
    place[1][lane] = vector.y.0;
}

#[inline(always)]
fn either(first: bool, one: Vector<Lane>, other: Vector<Lane>) -> Vector<Lane> {
    let pick = |one: Lane, other: Lane| if first { one } else { other };
    Vector::new(pick(one.x, other.x), pick(one.y, other.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::geometry::arms;
    use rigproof_spec::inertia::inertia;
    use rigproof_spec::layout::Layout;

    const STEP_S: f64 = 1e-3;

    fn start(lane: usize) -> ([f64; 2], [f64; 2]) {
        let share = lane as f64 / 7.3;
        let rates_rad_s = [0.71 - 1.9 * share, 3.7 * share - 0.83];
        ([2.17 - 0.11 * share, 0.83 + 0.07 * share], rates_rad_s)
    }

    fn force_n(lane: usize, step: usize) -> [f64; 2] {
        let phase = 0.0137 * step as f64 + 0.9 * lane as f64;
        let (sine, cosine) = libm::sincos(phase);
        [7.3 * sine, -5.9 * cosine]
    }

    #[test]
    fn a_rig_moves_the_same_alone_and_in_a_block() {
        for layout in [Layout::ThreeBrake, Layout::FourBrake] {
            for scheme in [Scheme::Midpoint, Scheme::SemiImplicitEuler] {
                let (arms, inertia) = (arms(layout), inertia(layout));
                let batch = Batch::new(&arms, &inertia, scheme);
                let lanes = [0, 1, 2, 3, 4, 5, 6, 7];
                let (theta, rates) = (lanes.map(|i| start(i).0), lanes.map(|i| start(i).1));
                let mut blocks = [Block::new(&batch, theta, rates).unwrap()];
                let alone = Mechanism::<f64>::new(&arms, &inertia, scheme);
                let mut motions =
                    lanes.map(|i| Motion::new(&alone, theta[i].into(), rates[i].into()).unwrap());
                let mut outcomes = [Outcome::Moved; LANES];
                for step in 0..2000 {
                    let forces = lanes.map(|i| force_n(i, step));
                    let forces_n = [[forces.map(|[x, _]| x), forces.map(|[_, y]| y)]];
                    batch.step_free(&mut blocks, &forces_n, STEP_S);
                    for i in lanes {
                        if outcomes[i] == Outcome::Moved {
                            outcomes[i] = motions[i].step_free(&alone, forces[i].into(), STEP_S);
                        }
                        assert_eq!(
                            blocks[0].base_angles_rad(i),
                            Some(motions[i].theta_rad.into())
                        );
                        let rates = motions[i].rates_rad_s;
                        assert_eq!(blocks[0].base_rates_rad_s(i), Some(rates.into()));
                    }
                    assert_eq!(blocks[0].outcomes(), outcomes);
                }
                // Pushed about like this, some are driven out of their assembly and some are not.
                assert!(
                    outcomes.contains(&Outcome::Singular),
                    "{layout:?} {outcomes:?}"
                );
                assert!(
                    motions
                        .iter()
                        .all(|motion| motion.rates_rad_s.norm() > 0.01)
                );
            }
        }
    }

    #[test]
    fn a_rig_that_cannot_be_moved_stands() {
        let layout = Layout::ThreeBrake;
        let batch = Batch::new(&arms(layout), &inertia(layout), Scheme::Midpoint);
        let mut rates = [[0.31, -0.17]; LANES];
        rates[2] = [900.0, 3.0];
        let mut blocks = [Block::new(&batch, [[2.17, 0.83]; LANES], rates).unwrap()];
        let before = blocks[0];
        let mut forces_n = [[[1.3; LANES], [0.4; LANES]]];
        forces_n[0][1][5] = f64::NAN;
        batch.step_free(&mut blocks, &forces_n, STEP_S);
        let mut expected = [Outcome::Moved; LANES];
        (expected[2], expected[5]) = (Outcome::TooFast, Outcome::Undefined);
        assert_eq!(blocks[0].outcomes(), expected);
        for lane in [2, 5] {
            assert_eq!(
                blocks[0].base_angles_rad(lane),
                before.base_angles_rad(lane)
            );
        }
        assert_ne!(blocks[0].base_angles_rad(3), before.base_angles_rad(3));
        assert_eq!(blocks[0].base_angles_rad(8), None);
    }
}
