//! This file is what comparisons with constants leave of a number.

use crate::symbol::Relation;

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
