//! This file decides which joints stick and which slide over a step: dry friction as a set, solved exactly.
//!
//! With two degrees of freedom the velocity v at the end of a step makes ½·v·Mv − r·v + Σ hᵢ·|bᵢ·v| least (Moreau 1988): r is
//! the momentum without friction, hᵢ the greatest friction impulse of joint i and bᵢ·v its rate. The function is strictly convex and
//! quadratic between the lines bᵢ·v = 0, so that its least value is at rest, on one line, or in one sector. The candidates are
//! few and each is a velocity; the one with the least value is the answer, without tolerance or iteration.

use super::linkage::{Pair, cross, dot, plus, turned};
use super::mass::Dynamics;

/// What is asked of one step.
pub struct Contact<'a> {
    /// Mass matrix at the middle of the step.
    pub form: &'a Dynamics,
    /// Momentum at the end if there were no friction, N·m·s.
    pub momentum: Pair,
    /// Rows along which friction acts, at the middle of the step.
    pub forces: [Pair; 4],
    /// Rows that make the joints' rates at its end.
    pub rates: [Pair; 4],
    /// Greatest friction impulses, N·m·s; a joint with none never sticks.
    pub impulses: [f64; 4],
}

/// The answer: the rates at the end of the step and the direction of each joint, 0 where it sticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    pub rates: Pair,
    pub signs: [f64; 4],
}

/// Rows within this sine are one line: E and C of the 3-brake layout, whose difference is rounding.
const PARALLEL: f64 = 1e-9;

impl Contact<'_> {
    /// The motion; `last` is that of the step before, which is nearly always still right.
    pub fn settle(&self, last: [f64; 4]) -> Motion {
        if last == [0.0; 4] && self.holds() {
            return Motion {
                rates: [0.0; 2],
                signs: last,
            };
        }
        match self.with_signs(last) {
            Some(motion) if self.agrees(&motion, last) => motion,
            _ => self.least(),
        }
    }

    /// Share of the step after which the first joint that slides would be at rest if all went on as they are, its rate going
    /// straight from that at the start; infinite when none would.
    pub fn until_rest(&self, signs: [f64; 4], start: [f64; 4]) -> f64 {
        let Some(onward) = self.with_signs(signs) else {
            return f64::INFINITY;
        };
        let each = self.frictional().map(|k| {
            let (before, after) = (sign(&start, k), dot(self.row(k), onward.rates));
            let turns =
                sign(&signs, k) != 0.0 && before * sign(&signs, k) > 0.0 && before * after < 0.0;
            if turns {
                before / (before - after)
            } else {
                f64::INFINITY
            }
        });
        each.fold(f64::INFINITY, f64::min)
    }

    /// Whether friction can hold everything: the momentum is inside the zonotope of all sets, whose faces are along the rows.
    fn holds(&self) -> bool {
        let mut rows = self.frictional().map(|k| self.force(k)).peekable();
        // The rows themselves count where all are parallel.
        rows.peek().is_some()
            && rows.flat_map(|row| [turned(row), row]).all(|normal| {
                let room: f64 = self
                    .frictional()
                    .map(|k| self.bound(k) * dot(self.force(k), normal).abs())
                    .sum();
                dot(self.momentum, normal).abs() <= room
            })
    }

    /// The velocity if the joints that slid still slide and those that stuck still stick.
    fn with_signs(&self, signs: [f64; 4]) -> Option<Motion> {
        let mut stuck = self.frictional().filter(|k| sign(&signs, *k) == 0.0);
        match stuck.next() {
            None => Some(self.in_sector(signs)),
            Some(first) => {
                let line = self.row(first);
                stuck
                    .all(|k| is_parallel(self.row(k), line))
                    .then(|| self.on_line(first, signs))
            }
        }
    }

    /// Whether sliding joints slide as supposed and sticking ones are held within their bounds.
    fn agrees(&self, motion: &Motion, signs: [f64; 4]) -> bool {
        let slides = self.frictional().all(|k| {
            let sign = sign(&signs, k);
            sign == 0.0 || sign * dot(self.row(k), motion.rates) > 0.0
        });
        let Some(held) = self.frictional().find(|k| sign(&signs, *k) == 0.0) else {
            return slides;
        };
        // Held along one line: the momentum that is missing acts along that row, within the sum of the bounds.
        let missing = self.missing(motion.rates, signs);
        let along = normal(self.force(held));
        let room: f64 = self
            .frictional()
            .filter(|k| sign(&signs, *k) == 0.0)
            .map(|k| self.bound(k) * dot(self.force(k), along).abs())
            .sum();
        slides && dot(missing, along).abs() <= room
    }

    /// Momentum without friction, less that of a velocity and of the sliding joints.
    fn missing(&self, rates: Pair, signs: [f64; 4]) -> Pair {
        let left = plus(self.momentum, -1.0, self.form.times(rates));
        self.frictional().fold(left, |left, k| {
            plus(left, -self.bound(k) * sign(&signs, k), self.force(k))
        })
    }

    /// The best of all candidates.
    fn least(&self) -> Motion {
        let mut best = Motion {
            rates: [0.0; 2],
            signs: [0.0; 4],
        };
        let mut least = 0.0;
        let mut consider = |motion: Motion| {
            let value = self.value(motion.rates);
            if value < least {
                least = value;
                best = motion;
            }
        };
        for pattern in 0..16_u32 {
            let signs = [0, 1, 2, 3].map(|k| if pattern >> k & 1 == 1 { 1.0 } else { -1.0 });
            consider(self.in_sector(signs));
            self.frictional()
                .for_each(|k| consider(self.on_line(k, signs)));
        }
        Motion {
            signs: self.signs_of(&best),
            ..best
        }
    }

    /// The signs that a velocity has, joints on its line stuck.
    fn signs_of(&self, motion: &Motion) -> [f64; 4] {
        [0, 1, 2, 3].map(|k| match sign(&motion.signs, k) {
            sign if sign == 0.0 || self.bound(k) == 0.0 => 0.0,
            _ => dot(self.row(k), motion.rates).signum(),
        })
    }

    /// The function that is least at the answer.
    fn value(&self, rates: Pair) -> f64 {
        let smooth = 0.5 * dot(rates, self.form.times(rates)) - dot(self.momentum, rates);
        let friction: f64 = self
            .frictional()
            .map(|k| self.bound(k) * dot(self.row(k), rates).abs())
            .sum();
        smooth + friction
    }

    fn in_sector(&self, signs: [f64; 4]) -> Motion {
        let left = self.missing([0.0; 2], signs);
        Motion {
            rates: self.form.solve(left),
            signs,
        }
    }

    /// The velocity with one joint and all its parallels at rest.
    fn on_line(&self, held: usize, signs: [f64; 4]) -> Motion {
        let line = self.row(held);
        let signs = [0, 1, 2, 3].map(|k| match is_parallel(self.row(k), line) {
            true => 0.0,
            false => sign(&signs, k),
        });
        let free = turned(line);
        // Across the row of the holding force, so that it drops out.
        let across = turned(self.force(held));
        let left = self.missing([0.0; 2], signs);
        let speed = dot(across, left) / dot(across, self.form.times(free));
        Motion {
            rates: free.map(|x| x * speed),
            signs,
        }
    }

    fn frictional(&self) -> impl Iterator<Item = usize> + '_ {
        let impulses = self.impulses.iter().enumerate();
        impulses
            .filter(|(_, impulse)| **impulse > 0.0)
            .map(|(k, _)| k)
    }

    fn row(&self, k: usize) -> Pair {
        self.rates.get(k).copied().unwrap_or_default()
    }

    fn force(&self, k: usize) -> Pair {
        self.forces.get(k).copied().unwrap_or_default()
    }

    fn bound(&self, k: usize) -> f64 {
        sign(&self.impulses, k)
    }
}

fn sign(values: &[f64; 4], k: usize) -> f64 {
    values.get(k).copied().unwrap_or(0.0)
}

fn normal(row: Pair) -> Pair {
    let length = dot(row, row).sqrt();
    row.map(|x| x / length)
}

fn is_parallel(a: Pair, b: Pair) -> bool {
    cross(a, b).abs() <= PARALLEL * (dot(a, a) * dot(b, b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FORM: Dynamics = Dynamics {
        mass: [0.55, 0.11, 0.37],
        bias: [0.0; 2],
    };

    fn contact(momentum: Pair, rows: [Pair; 4], impulses: [f64; 4]) -> Contact<'static> {
        Contact {
            form: &FORM,
            momentum,
            forces: rows,
            rates: rows,
            impulses,
        }
    }

    fn row() -> impl Strategy<Value = Pair> {
        [-1.7..1.7_f64, -1.7..1.7_f64]
            .prop_filter("a row has a length", |[x, y]| x.hypot(*y) > 0.05)
    }

    proptest! {
        /// The friction that the velocity asks for is inside every set: M·v − r + Σ bᵢ·λᵢ = 0 with λᵢ = hᵢ·sign where a joint
        /// slides; what is left lies in the sum of the sets of those that stick (support function in 64 directions).
        #[test]
        fn the_motion_meets_the_inclusion(
            momentum in [-2.3..2.3_f64, -2.3..2.3_f64],
            rows in [row(), row(), row(), row()],
            impulses in [0.0..1.1_f64, 0.0..1.1_f64, 0.0..0.3_f64, 0.0..0.3_f64],
            none: bool,
        ) {
            let impulses = if none { [0.0, impulses[1], 0.0, impulses[3]] } else { impulses };
            let contact = contact(momentum, rows, impulses);
            let motion = contact.settle([1.0, -1.0, 0.0, 1.0]);
            let missing = contact.missing(motion.rates, motion.signs);
            let scale = 1e-12 * (1.0 + momentum[0].abs() + momentum[1].abs());
            for k in 0..4 {
                let rate = dot(rows[k], motion.rates);
                if impulses[k] > 0.0 && motion.signs[k] == 0.0 {
                    prop_assert!(rate.abs() < 1e-12, "joint {k} creeps at {rate}");
                } else if impulses[k] > 0.0 {
                    prop_assert!(rate * motion.signs[k] > 0.0);
                }
            }
            for k in 0..64 {
                let (s, c) = libm::sincos(f64::from(k) * 0.098_174_770_424_681);
                let room: f64 = (0..4)
                    .filter(|k| motion.signs[*k] == 0.0)
                    .map(|k| impulses[k] * dot(rows[k], [c, s]).abs())
                    .sum();
                prop_assert!(dot(missing, [c, s]) <= room + scale, "{motion:?}");
            }
            // A second call that starts from the answer finds it again.
            prop_assert_eq!(contact.settle(motion.signs).signs, motion.signs);
        }
    }

    #[test]
    fn two_parallel_joints_share_what_they_hold() {
        let rows = [[1.0, 0.0], [-1.0, 1.0], [0.0, 1.0], [1.0, -1.0]];
        // Along E: 0.61 is more than either of E and C holds and less than both.
        let motion = contact([-0.61, 0.61], rows, [0.0, 0.4, 0.0, 0.3]).settle([0.0; 4]);
        assert_eq!(motion.rates, [0.0; 2]);
        let motion = contact([-0.71, 0.71], rows, [0.0, 0.4, 0.0, 0.3]).settle([0.0; 4]);
        assert_eq!(motion.signs, [0.0, 1.0, 0.0, -1.0]);
    }
}
