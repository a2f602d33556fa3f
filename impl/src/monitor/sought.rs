//! This file asks what the last rows say each number is now, a bounded part of the work in every sample.
//!
//! Everything is taken to be as it was learned but one number, which may have changed to anything: its estimate and variance are
//! those of least squares with the change as one more unknown. The others follow what was learned and what is certified.

use super::constants::{NUMBERS, WATCHED};
use super::estimate::Seen;
use super::information::{Information, Row, along, dot};
use crate::number::{Scalar, most};

/// A watched number as the last rows say that it is, if it alone has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// How far it is from the middle of what is certified.
    pub now: f64,
    /// The variance of that; infinite where the rows say nothing.
    pub variance: f64,
}

impl Number {
    /// Nothing is known.
    const NONE: Number = Number {
        now: 0.0,
        variance: f64::INFINITY,
    };

    /// The square of how many standard deviations it is beyond the nearer of its ends; 0 inside, and where the rows do not tell it to within
    /// the width of its interval: what is left of other errors then looks like a change far larger than any.
    pub fn beyond_squared(&self, low: f64, high: f64) -> f64 {
        let (width, beyond) = (high - low, most(self.now - high, low - self.now));
        if beyond > 0.0 && self.variance.is_within(width * width) {
            let missed = MISSED_WIDTH * width;
            beyond * beyond / (self.variance + missed * missed)
        } else {
            0.0
        }
    }
}

/// Standard deviation of a number that stays however many rows there are, as a share of the width of its interval: errors of the model
/// shift a number by a little and do not average out.
const MISSED_WIDTH: f64 = 0.1;

/// Rows with fewer than which the mean square of what is unexplained is as if there were so many.
const FEWEST_ROWS: f64 = 16.0;
/// Share of a number's information that rounding may leave where the others explain all of it.
const ROUNDING: f64 = 1e-9;

/// What is done in a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Idle,
    /// Adds up a part of the window.
    Sum(usize),
    /// Joins it with what was learned.
    Join,
    /// A row of the factor.
    Factor(usize),
    /// What all rows say of the numbers.
    Solve,
    /// What the window says of a number that changed.
    Change(usize),
    /// What that makes of the number.
    Number(usize),
    /// What no number explains.
    Unexplained,
}

/// The work on one look, and what the last whole one said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sought {
    stage: Stage,
    window: Information,
    /// U with Uᵀ·U the information on all numbers: what stands right of the diagonal, and the inverses of the diagonal.
    factor: [[f64; NUMBERS]; NUMBERS],
    inverses: [f64; NUMBERS],
    /// U⁻ᵀ times what all rows say.
    solved: [f64; NUMBERS],
    /// U⁻ᵀ times the information of the window on the number that is asked for.
    change: [f64; NUMBERS],
    numbers: [Number; WATCHED],
    /// All numbers as all rows say that they are.
    all: [f64; NUMBERS],
    surprise: f64,
}

impl Sought {
    /// Nothing asked yet.
    pub const NONE: Sought = Sought {
        stage: Stage::Idle,
        window: Information::NONE,
        factor: [[0.0; NUMBERS]; NUMBERS],
        inverses: [0.0; NUMBERS],
        solved: [0.0; NUMBERS],
        change: [0.0; NUMBERS],
        numbers: [Number::NONE; WATCHED],
        all: [0.0; NUMBERS],
        surprise: 0.0,
    };

    /// The watched numbers of the last look.
    pub fn numbers(&self) -> &[Number; WATCHED] {
        &self.numbers
    }

    /// Mean square of what no number explained in the last look: 1 where the model is right.
    pub fn surprise(&self) -> f64 {
        self.surprise
    }

    /// What is expected to be left in a row, N·m·s, with all numbers as the last look found them.
    pub fn expected(&self, row: &Row) -> f64 {
        dot(&row.of, &self.all)
    }

    /// Begins a look, where none is at work.
    pub fn begin(&mut self) {
        if self.stage == Stage::Idle {
            self.window = Information::NONE;
            self.stage = Stage::Sum(0);
        }
    }

    /// Goes on by a stage; true where that ended a look.
    pub fn go_on(&mut self, seen: &Seen) -> bool {
        self.stage = match self.stage {
            Stage::Idle => return false,
            Stage::Sum(part) => match seen.last.get(part) {
                Some(last) => {
                    self.window.add(last);
                    Stage::Sum(part + 1)
                }
                None => Stage::Join,
            },
            Stage::Join => {
                self.join(seen);
                Stage::Factor(0)
            }
            Stage::Factor(place) => {
                if self.factor(place, &seen.at_rest) {
                    Stage::Factor(place + 1)
                } else {
                    Stage::Solve
                }
            }
            Stage::Solve => {
                self.solved = self.forward(self.solved);
                Stage::Change(0)
            }
            Stage::Change(place) => match self.window.of.get(place) {
                Some(of) if place < WATCHED => {
                    self.change = self.forward(*of);
                    Stage::Number(place)
                }
                _ => Stage::Unexplained,
            },
            Stage::Number(place) => {
                self.number(place);
                Stage::Change(place + 1)
            }
            Stage::Unexplained => {
                self.all = self.backward();
                self.surprise = self.unexplained();
                self.stage = Stage::Idle;
                return true;
            }
        };
        false
    }

    /// The information on all numbers: of the window, of what was learned, and of what is certified.
    fn join(&mut self, seen: &Seen) {
        self.factor = self.window.of;
        self.solved = self.window.score;
        let learned = seen.learned.of.iter().chain([&seen.learned.score]);
        let all = self.factor.iter_mut().chain([&mut self.solved]);
        for (own, learned) in all.zip(learned) {
            along(own, 1.0, learned);
        }
        for (place, (row, at_rest)) in self.factor.iter_mut().zip(seen.at_rest).enumerate() {
            if let Some(own) = row.get_mut(place) {
                *own += at_rest;
            }
        }
    }

    /// A row of the factor by Cholesky; false where there is none. A pivot is never below what is certified of its number.
    fn factor(&mut self, place: usize, at_rest: &[f64; NUMBERS]) -> bool {
        let Some((above, rest)) = self.factor.split_at_mut_checked(place) else {
            return false;
        };
        let (Some(own), Some(at_rest)) = (rest.first_mut(), at_rest.get(place)) else {
            return false;
        };
        let mut pivot = own.get(place).copied().unwrap_or(0.0);
        for row in above {
            let step = row.get(place).copied().unwrap_or(0.0);
            pivot -= step * step;
            along(own, -step, row);
        }
        let inverse = 1.0 / libm::sqrt(most(pivot, *at_rest));
        for (column, value) in own.iter_mut().enumerate() {
            *value = if column > place {
                *value * inverse
            } else {
                0.0
            };
        }
        if let Some(own) = self.inverses.get_mut(place) {
            *own = inverse;
        }
        true
    }

    /// U⁻ᵀ times a vector.
    #[inline]
    fn forward(&self, mut of: [f64; NUMBERS]) -> [f64; NUMBERS] {
        let rows = self.factor.iter().zip(&self.inverses);
        for (place, (row, inverse)) in rows.enumerate() {
            let Some(own) = of.get_mut(place) else { break };
            *own *= inverse;
            let step = -*own;
            along(&mut of, step, row);
        }
        of
    }

    /// The number at a place. With A the information of everything and W that of the window, a change d of it alone adds
    /// 2·d·(s − W·θ) − d²·(W − W·A⁻¹·W) to the likelihood.
    fn number(&mut self, place: usize) {
        let mut unit = [0.0; NUMBERS];
        if let Some(own) = unit.get_mut(place) {
            *own = 1.0;
        }
        let unit = self.forward(unit);
        let of = |all: &[f64; NUMBERS]| all.get(place).copied().unwrap_or(0.0);
        let all = self.window.of.get(place).map_or(0.0, of);
        let information = all - dot(&self.change, &self.change);
        let Some(number) = self.numbers.get_mut(place) else {
            return;
        };
        *number = if information > ROUNDING * all {
            let score = of(&self.window.score) - dot(&self.change, &self.solved);
            let own = 1.0 - dot(&unit, &self.change);
            let inverse = 1.0 / information;
            Number {
                now: dot(&unit, &self.solved) + own * score * inverse,
                variance: dot(&unit, &unit) + own * own * inverse,
            }
        } else {
            Number::NONE
        };
    }

    /// All numbers where all rows say that they are.
    fn backward(&self) -> [f64; NUMBERS] {
        let mut numbers = [0.0; NUMBERS];
        let rows = self.factor.iter().zip(&self.inverses).zip(&self.solved);
        for (place, ((row, inverse), solved)) in rows.enumerate().rev() {
            let value = (solved - dot(row, &numbers)) * inverse;
            if let Some(own) = numbers.get_mut(place) {
                *own = value;
            }
        }
        numbers
    }

    /// Mean square of what is left in the window with these numbers.
    fn unexplained(&self) -> f64 {
        let mut square = self.window.square;
        let rows = self.window.of.iter().zip(&self.window.score);
        for (number, (of, score)) in self.all.iter().zip(rows) {
            square += number * (dot(of, &self.all) - 2.0 * score);
        }
        most(square, 0.0) * (1.0 / most(self.window.rows, FEWEST_ROWS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::estimate::PARTS;

    /// Numbers in -1 to 1 from a sequence that never repeats here.
    fn draw(seed: &mut u64) -> f64 {
        *seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Rows of numbers with noise of a standard deviation of 0.1.
    fn rows<const COUNT: usize>(truth: &[f64; NUMBERS], seed: &mut u64) -> [Row; COUNT] {
        [0; COUNT].map(|_| {
            let of = [0; NUMBERS].map(|_| draw(seed));
            let noise = 0.1 * libm::sqrt(3.0) * draw(seed);
            Row {
                left: dot(&of, truth) + noise,
                of,
                variance: 0.01,
            }
        })
    }

    /// Least squares with one unknown more, by elimination: the number and its variance.
    fn by_elimination(at_rest: &[f64; NUMBERS], all: [&[Row]; 2], place: usize) -> (f64, f64) {
        const MORE: usize = NUMBERS + 1;
        let mut normal = [[0.0; MORE + 2]; MORE];
        for (place, at_rest) in at_rest.iter().enumerate() {
            normal[place][place] = *at_rest;
        }
        let [before, last] = all;
        let rows = before.iter().map(|row| (0.0, row));
        for (share, row) in rows.chain(last.iter().map(|row| (1.0, row))) {
            let mut of = [0.0; MORE];
            of[..NUMBERS].copy_from_slice(&row.of);
            of[NUMBERS] = share * row.of[place];
            for one in 0..MORE {
                for other in 0..MORE {
                    normal[one][other] += of[one] * of[other] / row.variance;
                }
                normal[one][MORE] += of[one] * row.left / row.variance;
            }
        }
        // The variance of the number and its change is the contrast's solution along itself.
        normal[place][MORE + 1] += 1.0;
        normal[NUMBERS][MORE + 1] += 1.0;
        for pivot in 0..MORE {
            let own = normal[pivot];
            for other in (0..MORE).filter(|other| *other != pivot) {
                let step = normal[other][pivot] / own[pivot];
                for column in 0..MORE + 2 {
                    normal[other][column] -= step * own[column];
                }
            }
        }
        let of = |column: usize| [place, NUMBERS].map(|row| normal[row][column] / normal[row][row]);
        (of(MORE).iter().sum(), of(MORE + 1).iter().sum())
    }

    #[test]
    fn a_number_that_changed_is_what_least_squares_with_its_change_says() {
        let mut seed = 91;
        let before = [0; NUMBERS].map(|_| 0.3 * draw(&mut seed));
        for place in 0..WATCHED {
            let mut after = before;
            after[place] += 1.1;
            let (old, new): ([Row; 300], [Row; 41]) =
                (rows(&before, &mut seed), rows(&after, &mut seed));
            let mut seen = Seen {
                at_rest: [0; NUMBERS].map(|_| 7.0 + draw(&mut seed)),
                learned: Information::NONE,
                last: [Information::NONE; PARTS],
            };
            old.iter().for_each(|row| seen.learned.take(row, row.left));
            for (row, part) in new.iter().zip((0..PARTS).cycle()) {
                seen.last[part].take(row, row.left);
            }
            let mut sought = Sought::NONE;
            sought.begin();
            let stages = (1..200).find(|_| sought.go_on(&seen));
            // As often as the samples that are left between two looks.
            assert!(stages.is_some_and(|stages| stages < 100), "{stages:?}");
            let number = sought.numbers()[place];
            let (now, variance) = by_elimination(&seen.at_rest, [&old, &new], place);
            assert!((number.now - now).abs() < 1e-9, "{} {now}", number.now);
            assert!((number.variance / variance - 1.0).abs() < 1e-9);
            assert!((now - after[place]).abs() < 4.0 * libm::sqrt(variance));
            assert!(number.beyond_squared(-0.3, 0.3) > 9.0);
        }
    }

    #[test]
    fn what_nothing_was_seen_of_is_not_beyond_its_ends() {
        let mut sought = Sought::NONE;
        let seen = Seen {
            at_rest: [310.0; NUMBERS],
            learned: Information::NONE,
            last: [Information::NONE; PARTS],
        };
        sought.begin();
        while !sought.go_on(&seen) {}
        let beyond = sought
            .numbers()
            .map(|number| number.beyond_squared(-0.02, 0.02));
        assert_eq!(beyond, [0.0; WATCHED]);
        assert_eq!(sought.surprise(), 0.0);
    }
}
