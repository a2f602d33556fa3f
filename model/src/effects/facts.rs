//! This file is what is known of a mechanism beside its law: one record a mechanism, which every other room looks up.

use super::Entry;
use rigproof_spec::effect::Mechanism;

/// What is known of a mechanism.
#[derive(Clone, Copy)]
pub struct Facts {
    /// What kind of thing it is.
    pub family: Family,
    /// Whether laws of several forms describe it, such as a peak, a memory or heat. A law of another form then leaves a part of the effect, and
    /// the name is right. Without, what it leaves is something else, which it may only stand in for.
    pub has_forms: bool,
    /// It in plain words.
    pub words: Words,
    /// Which plants it is looked for on.
    pub asked: Asked,
    /// Its turn among those of one place of the five-bar: what is tried and offered earlier has a lower one, equal ones come in the order of
    /// the library.
    pub turn: u8,
    /// How common it is among what models leave out.
    pub usual: Usual,
    /// The shapes that are tried.
    pub shapes: Shapes,
    /// What it holds its joint with at rest.
    pub at_rest: AtRest,
    /// The mechanism that it comes to where one of its parameters goes to an end.
    pub limit: Option<Limit>,
    /// The mechanism that its own zero is: the second number that a fit gives it where that zero is not known.
    pub zero: Option<Mechanism>,
    /// Another one that no recording of a plant of one joint tells from it.
    pub twin: Option<Mechanism>,
    /// The mechanism of which it is another form: what one is, the other is.
    pub form_of: Option<Mechanism>,
    /// Whether it is also looked for as a share of a brake's torque.
    pub of_torque: bool,
    /// Whether it is looked for at each joint of a serial arm.
    pub at_arm: bool,
    /// Whether it is weighed in sets of mechanisms only, not looked for one at a time.
    pub in_sets: bool,
    /// Two that it is together, once it has slid. The first gives the shape.
    pub both: Option<[Mechanism; 2]>,
    /// How great a change of its parameters is small.
    pub refit: Refit,
}

impl Facts {
    /// Facts of a mechanism without shape, of one form, that holds nothing and comes to no other.
    pub(super) const fn of(family: Family, asked: Asked, words: Words) -> Facts {
        Facts {
            family,
            has_forms: false,
            words,
            asked,
            turn: 0,
            usual: Usual::Rare,
            shapes: Shapes::None,
            at_rest: AtRest::Nothing,
            limit: None,
            zero: None,
            twin: None,
            form_of: None,
            of_torque: false,
            at_arm: false,
            in_sets: false,
            both: None,
            refit: Refit {
                leads: false,
                sizes: &[],
            },
        }
    }
}

/// What kind of thing a mechanism is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Friction that the motion of the moment gives.
    FrictionOfMotion,
    /// A force that depends on the way the motion came.
    MemoryOfMotion,
    /// A force that the position gives.
    Position,
    /// A force that is there whatever moves.
    Constant,
    /// What a drive does with its command.
    Drive,
    /// What a brake does with its current.
    Brake,
    /// Masses.
    Inertia,
    /// What a sensor or its clock shows.
    Sensor,
}

impl Family {
    /// The name on a page.
    pub const fn name(self) -> &'static str {
        match self {
            Family::FrictionOfMotion => "friction of motion",
            Family::MemoryOfMotion => "memory of motion",
            Family::Position => "position",
            Family::Constant => "constant",
            Family::Drive => "drive",
            Family::Brake => "brake",
            Family::Inertia => "inertia",
            Family::Sensor => "sensor",
        }
    }
}

/// A mechanism in the words of somebody who mends machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// What it is, to stand after "the model leaves out".
    pub what: &'static str,
    /// What one would look for on the rig.
    pub look_for: &'static str,
}

/// Which plants a mechanism is looked for on. What is tried costs time in every diagnosis, and the rules of a plant are chosen with what it is
/// asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// On a plant of one joint: an axis or a bench.
    pub alone: Alone,
    /// On the five-bar.
    pub five_bar: Where,
}

/// When a plant of one joint is asked for a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alone {
    /// Never.
    Never,
    /// Always.
    Always,
    /// Where a drive or brake with known numbers acts.
    WithKnown,
    /// Where a brake acts whose current is recorded.
    WithBrake,
    /// Where something drives: an axis, or a brake with its current.
    WithDrive,
    /// On an axis.
    Driven,
    /// On an axis whose inertia is known.
    WithInertia,
    /// On a bench.
    Imposed,
}

/// Where on the five-bar a mechanism is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    /// Nowhere.
    Nowhere,
    /// At every joint with a brake.
    Brakes,
    /// At every joint without a brake.
    Bearings,
    /// At every joint.
    Joints,
    /// At both encoders.
    Encoders,
    /// Of the linkage as a whole.
    Whole,
}

/// The shapes that are tried: numbers, or the kind of grid that a plant lays over its own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shapes {
    /// It has none.
    None,
    /// These numbers.
    Values(&'static [f64]),
    /// So many from low to high in equal ratios.
    Geometric {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// How many.
        count: usize,
    },
    /// So many from low to high in equal ratios, each with both signs.
    BothSigns {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// How many.
        count: usize,
    },
    /// Speeds of a peak near standstill, with its exponents.
    Peak,
    /// Travels over which a bristle bends.
    Bristle,
    /// The same with exponents of the curve on which it bends.
    BristleCurve,
    /// Rates of a memory of the displacement.
    Memory,
    /// Periods over the travel, from the spectrum of what is left.
    Period,
    /// Time constants from half a sample on.
    Lag,
    /// Delays from a sample on.
    Delay,
    /// Shifts in time of both signs.
    Shift,
    /// Currents below the greatest that was given.
    CurrentLimit,
    /// Efforts below the greatest that was given.
    EffortLimit,
    /// Anchors in the plane, around where the tip moves.
    Anchor,
    /// Widths of a gap, shares of the travel.
    Gap,
    /// Resonances and damping ratios.
    Resonance,
    /// Half widths of a play of the current, A: so many from low to high in equal ratios; a plant may add where its sides close.
    CurrentPlay {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// How many.
        count: usize,
    },
}

/// How common a mechanism is among what models leave out, from the plainest to the most seldom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usual {
    /// Most models leave some of it out.
    Plain,
    /// Frequent.
    Frequent,
    /// Common.
    Common,
    /// Now and then.
    Seldom,
    /// Rare.
    Rare,
    /// Hardly ever.
    Exceptional,
}

/// The most that a mechanism holds its joint with at rest, from its numbers; where it goes from one level to another the higher one.
#[derive(Clone, Copy)]
pub enum AtRest {
    /// It does not hold.
    Nothing,
    /// A dry level, N·m or N.
    Dry(fn(&[f64]) -> f64),
    /// A force that stands against a push, N·m or N.
    Level(fn(&[f64]) -> f64),
    /// A share of the brake's torque.
    OfBrake(fn(&[f64]) -> f64),
    /// A lever arm of the force on the tip, m.
    OfLoad(fn(&[f64]) -> f64),
}

/// The first number.
pub(super) fn first(numbers: &[f64]) -> f64 {
    numbers.first().copied().unwrap_or(0.0)
}

/// The first number, nothing where it is negative.
pub(super) fn first_if_positive(numbers: &[f64]) -> f64 {
    first(numbers).max(0.0)
}

/// The mechanism that a richer one comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// The simpler one.
    pub of: Mechanism,
    /// The parameter that goes to an end, by its place in the vocabulary.
    pub parameter: usize,
    /// Which end.
    pub end: End,
}

/// Where the limit of a parameter is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At 0.
    Nothing,
    /// Beyond every value.
    Everything,
}

/// How great a change of a mechanism's parameters is small, when a plant is fitted to its free run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refit {
    /// Whether its first number counts for the size of the efforts of the plant.
    pub leads: bool,
    /// The size of each parameter over that of the efforts; nothing for one that is measured by itself alone.
    pub sizes: &'static [f64],
}

impl Entry {
    /// Whether it is a mechanism or has it as its limit: both are that one in a recording that does not tell them apart.
    pub fn is_or_has_limit(&self, mechanism: Mechanism) -> bool {
        self.mechanism == mechanism || self.facts.limit.is_some_and(|limit| limit.of == mechanism)
    }
}

#[cfg(test)]
mod tests {
    use super::super::LIBRARY;
    use super::*;
    use std::iter::once;

    /// A mechanism's row on the page.
    fn row(entry: &Entry) -> String {
        let facts = entry.facts;
        let forms = match facts.has_forms {
            true => "several",
            false => "one",
        };
        let limit = facts.limit.map_or(String::new(), |limit| {
            let end = match limit.end {
                End::Nothing => "0",
                End::Everything => "beyond every value",
            };
            let parameter = entry.mechanism.parameters()[limit.parameter].name;
            format!("`{}` where `{parameter}` goes to {end}", limit.of.name())
        });
        let alone = match facts.asked.alone {
            Alone::Never => "no",
            Alone::Always => "yes",
            Alone::WithKnown => "with a known drive or brake",
            Alone::WithBrake => "with a brake's current",
            Alone::WithDrive => "with a drive or a brake's current",
            Alone::Driven => "on an axis",
            Alone::Imposed => "on a bench",
            Alone::WithInertia => "on an axis of known inertia",
        };
        let five_bar = match facts.asked.five_bar {
            Where::Nowhere => "no",
            Where::Brakes => "at brakes",
            Where::Bearings => "at joints without a brake",
            Where::Joints => "at every joint",
            Where::Encoders => "at encoders",
            Where::Whole => "as a whole",
        };
        format!(
            "| `{}` | {} | {forms} | {limit} | {alone} | {five_bar} | {} |",
            entry.mechanism.name(),
            facts.family.name(),
            once(&entry.mechanism.called())
                .chain(entry.mechanism.also())
                .copied()
                .collect::<Vec<_>>()
                .join(", ")
        )
    }

    #[test]
    fn the_page_prints_what_is_known_of_every_mechanism() {
        let page = include_str!("../../../docs/mechanisms.md");
        let (_, own) = page.split_once("## What else is known").unwrap();
        let printed: Vec<&str> = own.lines().filter(|l| l.starts_with("| `")).collect();
        let expected: Vec<String> = LIBRARY.iter().map(row).collect();
        assert_eq!(printed, expected);
    }
}
