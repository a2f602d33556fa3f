//! This file names the laws that every sample is held to, and counts how they fared.

use rigproof_spec::laws::Margin;
use serde::{Deserialize, Serialize};

use crate::declared::{Choice, Declared};

/// A law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "`words` says what each is")]
pub enum Law {
    Answers,
    CurrentLimit,
    BrakedJoints,
    Safe,
    Repeats,
    Dissipation,
    Passivity,
    BrakeCount,
    Lock,
    Gap,
    FreeSide,
    TipForce,
    Influence,
    QuarterTurn,
    Reference,
}

/// How many laws there are.
pub const LAWS: usize = 15;

impl Law {
    /// Every law, those first that every controller can be held to.
    pub const ALL: [Law; LAWS] = [
        Law::Answers,
        Law::CurrentLimit,
        Law::BrakedJoints,
        Law::Safe,
        Law::Repeats,
        Law::Dissipation,
        Law::Passivity,
        Law::BrakeCount,
        Law::Lock,
        Law::Gap,
        Law::FreeSide,
        Law::TipForce,
        Law::Influence,
        Law::QuarterTurn,
        Law::Reference,
    ];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Law::Answers => "answers",
            Law::CurrentLimit => "current_limit",
            Law::BrakedJoints => "braked_joints",
            Law::Safe => "safe",
            Law::Repeats => "repeats",
            Law::Dissipation => "dissipation",
            Law::Passivity => "passivity",
            Law::BrakeCount => "brake_count",
            Law::Lock => "lock",
            Law::Gap => "gap",
            Law::FreeSide => "free_side",
            Law::TipForce => "tip_force",
            Law::Influence => "influence",
            Law::QuarterTurn => "quarter_turn",
            Law::Reference => "reference",
        }
    }

    /// What it says.
    pub const fn words(self) -> &'static str {
        match self {
            Law::Answers => "it answers every sample: no crash, no refusal, in time",
            Law::CurrentLimit => "every current is a number from 0 to 1 A",
            Law::BrakedJoints => "no current for a joint without a brake",
            Law::Safe => {
                "on a fault of a sensor no brake has current, but for the last command held over two samples"
            }
            Law::Repeats => {
                "the same samples, told to a fresh controller, give the same currents bit for bit"
            }
            Law::Dissipation => "every brake takes power from its joint",
            Law::Passivity => "the rig never holds more energy than the hand put in",
            Law::BrakeCount => "no more brakes at once than declared, unless all lock",
            Law::Lock => {
                "all brakes lock only where the hand pushes away from the path or the tip moves back"
            }
            Law::Gap => "no brake acts inside the declared gap around the path",
            Law::FreeSide => "no brake acts on the free side of the obstacle",
            Law::TipForce => "no brake is asked for more than the greatest force at the tip",
            Law::Influence => {
                "the brake that acts is one that takes most rightly from the unwanted velocity"
            }
            Law::QuarterTurn => {
                "the brake that acts leads between the path's direction and the way to it"
            }
            Law::Reference => {
                "the currents are those of the reference's controller, ties aside, on every sample that is set beside it"
            }
        }
    }

    /// The unit of its margin.
    pub const fn unit(self) -> &'static str {
        match self {
            Law::Answers => "answers",
            Law::CurrentLimit
            | Law::BrakedJoints
            | Law::Safe
            | Law::Repeats
            | Law::Gap
            | Law::FreeSide
            | Law::Reference => "A",
            Law::Dissipation => "W",
            Law::Passivity => "J",
            Law::BrakeCount => "brakes",
            Law::Lock => "N or m/s",
            Law::TipForce => "N",
            Law::Influence => "ranks",
            Law::QuarterTurn => "1",
        }
    }

    /// Why the law cannot be judged for a controller; `None` where it can.
    pub fn not_looked_at(self, declared: &Declared) -> Option<&'static str> {
        let without = |is_declared: bool, why: &'static str| (!is_declared).then_some(why);
        match self {
            Law::BrakeCount => without(
                declared.most_brakes.is_some(),
                "how many brakes may act at once is not declared",
            ),
            Law::Lock if declared.locks == Some(false) => {
                Some("the controller declares that it never locks: brake_count looks at that")
            }
            Law::Lock => without(
                declared.locks == Some(true) && declared.boundary_m.is_some(),
                "locking or the boundary of the velocity field is not declared",
            ),
            Law::Gap => without(
                declared.gap_m.is_some_and(|gap_m| gap_m > 0.0),
                "no gap is declared",
            ),
            Law::FreeSide => without(declared.solid.is_some(), "no obstacle is declared"),
            Law::TipForce => without(
                declared.within_force,
                "a greatest force at the tip is not declared",
            ),
            Law::Influence => without(
                declared.choice == Some(Choice::Influence) && declared.boundary_m.is_some(),
                "choice by influence (§6.3) is not declared",
            ),
            Law::QuarterTurn => without(
                declared.choice == Some(Choice::QuarterTurn) && declared.boundary_m.is_some(),
                "choice by the quarter turn (§6.2) is not declared",
            ),
            Law::Reference => without(
                declared.reference.is_some(),
                "it does not claim to be a law of the rig",
            ),
            _ => None,
        }
    }
}

/// How one law fared over samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Written", into = "Written")]
pub struct Fared {
    /// Samples that were held to it.
    pub samples: u64,
    /// Samples in which it was broken.
    pub broken: u64,
    /// The first of them.
    pub first: Option<u32>,
    /// The least margin; that of a law without samples is the greatest number, one that is no number the least.
    pub worst: f64,
}

/// As it stands in a journal: samples, broken, first, worst.
type Written = (u64, u64, Option<u32>, f64);

impl From<Written> for Fared {
    fn from((samples, broken, first, worst): Written) -> Fared {
        Fared {
            samples,
            broken,
            first,
            worst,
        }
    }
}

impl From<Fared> for Written {
    fn from(fared: Fared) -> Written {
        (fared.samples, fared.broken, fared.first, fared.worst)
    }
}

impl Default for Fared {
    fn default() -> Fared {
        Fared {
            samples: 0,
            broken: 0,
            first: None,
            worst: f64::MAX,
        }
    }
}

impl Fared {
    /// Counts a sample.
    #[inline]
    pub fn add(&mut self, tick: u32, margin: Margin) {
        self.samples += 1;
        if !margin.holds() {
            self.broken += 1;
            self.first.get_or_insert(tick);
        }
        // What is no number is below every number.
        if margin.0.is_nan() {
            self.worst = f64::MIN;
        } else if margin.0 < self.worst {
            // A zero has no sign here.
            self.worst = margin.0.max(f64::MIN) + 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_has_its_place_and_its_name() {
        for (index, law) in Law::ALL.into_iter().enumerate() {
            assert_eq!(law as usize, index);
            let written = serde_json::to_string(&law).unwrap();
            assert_eq!(written, format!("\"{}\"", law.name()));
        }
    }

    #[test]
    fn every_broken_sample_is_counted_and_the_worst_is_kept() {
        let mut fared = Fared::default();
        for (tick, margin) in [(3, 0.7), (4, -0.2), (5, 0.1), (6, -0.9), (7, -0.3)] {
            fared.add(tick, Margin(margin));
        }
        assert_eq!((fared.samples, fared.broken), (5, 3));
        assert_eq!((fared.first, fared.worst), (Some(4), -0.9));
        fared.add(8, Margin(f64::NAN));
        assert_eq!((fared.broken, fared.worst), (4, f64::MIN));
        fared.add(9, Margin(-0.1));
        assert_eq!(fared.broken, 5);
    }
}
