//! This file is what comparisons with constants leave of a number.

use crate::symbol::Relation;
use crate::width::Width;

/// The numbers from `low` to `high`, both included, and whether it may be no number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least number.
    pub low: f64,
    /// The greatest number.
    pub high: f64,
    /// Whether it may be undefined.
    pub undefined: bool,
}

impl Default for Interval {
    fn default() -> Interval {
        Interval {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            undefined: true,
        }
    }
}

impl Interval {
    /// One constant.
    pub fn of(constant: f64) -> Interval {
        Interval {
            low: constant,
            high: constant,
            undefined: constant.is_nan(),
        }
    }

    /// What is left after `self ? bound` had this outcome.
    #[must_use]
    pub fn compared(self, relation: Relation, bound: f64, holds: bool) -> Interval {
        match (relation, holds) {
            (Relation::Less, true) => self.at_most(bound.next_down()).defined(),
            (Relation::LessOrEqual, true) => self.at_most(bound).defined(),
            (Relation::Equal, true) => self.at_most(bound).at_least(bound).defined(),
            (Relation::Less, false) => self.at_least(bound),
            (Relation::LessOrEqual, false) => self.at_least(bound.next_up()),
            (Relation::Equal, false) => self,
        }
    }

    /// What is left after `bound ? self` had this outcome.
    #[must_use]
    pub fn compared_from(self, bound: f64, relation: Relation, holds: bool) -> Interval {
        match (relation, holds) {
            (Relation::Less, true) => self.at_least(bound.next_up()).defined(),
            (Relation::LessOrEqual, true) => self.at_least(bound).defined(),
            (Relation::Equal, true) => self.at_most(bound).at_least(bound).defined(),
            (Relation::Less, false) => self.at_most(bound),
            (Relation::LessOrEqual, false) => self.at_most(bound.next_down()),
            (Relation::Equal, false) => self,
        }
    }

    /// The numbers that are in both.
    #[must_use]
    pub fn and(self, other: Interval) -> Interval {
        Interval {
            undefined: self.undefined && other.undefined,
            ..self.at_most(other.high).at_least(other.low)
        }
    }

    /// The rounded results of an operation that is monotone in each argument: the ends are results of ends, because rounding keeps order.
    /// Of what may be infinite or undefined nothing is known.
    #[must_use]
    pub fn combined(self, other: Interval, operation: fn(f64, f64) -> f64) -> Interval {
        if !(self.is_bounded() && other.is_bounded()) {
            return Interval::default();
        }
        let ends = [
            (self.low, other.low),
            (self.low, other.high),
            (self.high, other.low),
            (self.high, other.high),
        ];
        let results = ends.map(|(one, two)| operation(one, two));
        Interval {
            low: results.into_iter().fold(f64::INFINITY, f64::min),
            high: results.into_iter().fold(f64::NEG_INFINITY, f64::max),
            undefined: false,
        }
    }

    /// These numbers rounded to a width.
    #[must_use]
    pub fn rounded(self, width: Width) -> Interval {
        Interval {
            low: width.rounded(self.low),
            high: width.rounded(self.high),
            ..self
        }
    }

    /// The negative numbers of these.
    #[must_use]
    pub fn negated(self) -> Interval {
        Interval {
            low: -self.high,
            high: -self.low,
            undefined: self.undefined,
        }
    }

    fn is_bounded(self) -> bool {
        self.low.is_finite() && self.high.is_finite() && !self.undefined
    }

    fn at_most(self, bound: f64) -> Interval {
        Interval {
            high: if bound < self.high { bound } else { self.high },
            ..self
        }
    }

    fn at_least(self, bound: f64) -> Interval {
        Interval {
            low: if bound > self.low { bound } else { self.low },
            ..self
        }
    }

    fn defined(self) -> Interval {
        Interval {
            undefined: false,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RELATIONS: [Relation; 3] = [Relation::Less, Relation::LessOrEqual, Relation::Equal];

    fn outcome(relation: Relation, left: f64, right: f64) -> bool {
        match relation {
            Relation::Less => left < right,
            Relation::LessOrEqual => left <= right,
            Relation::Equal => left == right,
        }
    }

    fn contains(interval: Interval, value: f64) -> bool {
        (interval.low <= value && value <= interval.high) || (value.is_nan() && interval.undefined)
    }

    #[test]
    fn no_result_of_numbers_inside_is_lost() {
        let interval = |low, high| Interval {
            low,
            high,
            undefined: false,
        };
        let (one, two) = (interval(-1.3, 2.7), interval(-0.9, 0.4));
        let operations: [fn(f64, f64) -> f64; 3] = [|a, b| a + b, |a, b| a - b, |a, b| a * b];
        for operation in operations {
            let results = one.combined(two, operation);
            for a in [-1.3, -0.71, 0.0, 1.1, 2.7] {
                assert!(contains(one.negated(), -(-a)) == contains(one, -a));
                for b in [-0.9, -0.31, 0.0, 0.27, 0.4] {
                    assert!(contains(results, operation(a, b)), "{a} and {b}");
                }
            }
        }
        let unbounded = interval(1.7, f64::INFINITY);
        assert_eq!(one.combined(unbounded, |a, b| a * b), Interval::default());
        assert_eq!(
            one.combined(Interval::of(f64::NAN), |a, b| a * b),
            Interval::default()
        );
        assert_eq!(one.and(two), interval(-0.9, 0.4));
    }

    #[test]
    fn no_number_that_compares_so_is_lost() {
        let numbers = [
            f64::NAN,
            f64::NEG_INFINITY,
            -1.3,
            -0.0,
            0.0,
            f64::MIN_POSITIVE,
            1.3,
            2.7,
            f64::INFINITY,
        ];
        for value in numbers {
            for bound in numbers.into_iter().filter(|bound| !bound.is_nan()) {
                for relation in RELATIONS {
                    let all = Interval::default();
                    let left = all.compared(relation, bound, outcome(relation, value, bound));
                    assert!(contains(left, value), "{value} {relation:?} {bound}");
                    let holds = outcome(relation, bound, value);
                    let right = all.compared_from(bound, relation, holds);
                    assert!(contains(right, value), "{bound} {relation:?} {value}");
                }
            }
        }
    }
}
