//! This file is what is known of a mechanism besides its law: one record a mechanism, which every
//! other room looks up.

use super::Entry;
use rigproof_spec::effect::Mechanism;

/// What is known of a mechanism.
#[derive(Clone, Copy)]
pub struct Facts {
    /// The family of physics.
    pub family: Family,
    /// Whether its law is one of a family, such as a peak, a memory or heat. A true law of another
    /// form then leaves a part of the effect unexplained, and the name is still right. Otherwise an
    /// unexplained part is something else, and the mechanism may only substitute for it.
    pub has_forms: bool,
    /// Its description in plain words.
    pub words: Words,
    /// The plants on which it is a candidate.
    pub asked: Asked,
    /// Its position among the candidates of one place of the five-bar: lower ones are tried and
    /// offered first, equal ones in the order of the library.
    pub turn: u8,
    /// How common it is among what models leave out.
    pub usual: Usual,
    /// Its trial shapes.
    pub shapes: Shapes,
    /// The torque or force with which it holds its joint at rest.
    pub at_rest: AtRest,
    /// The simpler mechanism that it becomes when one of its parameters goes to a limit.
    pub limit: Option<Limit>,
    /// The mechanism that its unknown zero adds, as a second coefficient.
    pub zero: Option<Mechanism>,
    /// Another mechanism that no recording of a plant of one joint can distinguish from it.
    pub twin: Option<Mechanism>,
    /// The mechanism of which it is another form.
    pub form_of: Option<Mechanism>,
    /// Whether it is also a candidate as a share of a brake's torque.
    pub of_torque: bool,
    /// Whether settled rows show it, without a time between them: a candidate of a static sweep.
    pub in_a_sweep: bool,
    /// Whether it is a candidate at each joint of a serial arm.
    pub at_arm: bool,
    /// Whether it is a candidate at a transmission whose twist is recorded.
    pub at_transmission: bool,
    /// Whether it is compared in sets of mechanisms only, not one at a time.
    pub in_sets: bool,
    /// The value of its first number at which a mechanism without a coefficient does nothing, if
    /// there is one.
    pub nothing: Option<f64>,
    /// The two mechanisms whose sum it equals once it has slid. The first gives the shape.
    pub both: Option<[Mechanism; 2]>,
    /// The size of a small change of its parameters.
    pub refit: Refit,
}

impl Facts {
    /// The facts of a mechanism with one form, without shape, limit or holding force.
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
            in_a_sweep: false,
            at_arm: false,
            at_transmission: false,
            in_sets: false,
            nothing: None,
            both: None,
            refit: Refit {
                leads: false,
                sizes: &[],
            },
        }
    }
}

/// The family of physics to which a mechanism belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Friction that depends on the present motion.
    FrictionOfMotion,
    /// A force that depends on the past motion.
    MemoryOfMotion,
    /// A force that depends on the position.
    Position,
    /// A constant force.
    Constant,
    /// What a drive does with its command.
    Drive,
    /// What a brake does with its current.
    Brake,
    /// Masses and inertias.
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

/// A mechanism in the words of somebody who repairs machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// What it is, to follow "the model leaves out".
    pub what: &'static str,
    /// What to look for on the rig.
    pub look_for: &'static str,
}

/// The plants on which a mechanism is a candidate. Every candidate costs time, and the rules of a
/// plant are chosen with its candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// On a plant of one joint: an axis or a bench.
    pub alone: Alone,
    /// On the five-bar.
    pub five_bar: Where,
}

/// When a mechanism is a candidate on a plant of one joint.
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
    /// Where a brake is stated by its characteristic.
    WithCharacteristic,
    /// Where something drives: an axis, or a brake with its current.
    WithDrive,
    /// On an axis.
    Driven,
    /// On an axis, and on a bench with a simulated effort that it transmits.
    Loaded,
    /// On an axis whose inertia is known.
    WithInertia,
}

/// Where a mechanism is a candidate on the five-bar.
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
    /// For the linkage as a whole.
    Whole,
}

/// The trial shapes: numbers, or the kind of grid that a plant computes from its own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shapes {
    /// It has none.
    None,
    /// These numbers.
    Values(&'static [f64]),
    /// A geometric progression.
    Geometric {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// None, which is the plainer law, or a geometric progression.
    Optional {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// A geometric progression, each value with both signs.
    BothSigns {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// Stribeck speeds, with exponents.
    Peak,
    /// Travels of presliding.
    Bristle,
    /// The same, with exponents of the presliding curve.
    BristleCurve,
    /// Rates of a memory of the displacement.
    Memory,
    /// Periods over the travel, from the spectrum of the residual.
    Period,
    /// None, which is once a turn, or the same periods.
    Pitch,
    /// Time constants from half a sample on.
    Lag,
    /// Delays from a sample on.
    Delay,
    /// Shifts in time of both signs.
    Shift,
    /// Currents below the greatest command, also with how sharply the current bends towards them.
    CurrentLimit,
    /// Efforts below the greatest command, also with how sharply the effort bends towards them.
    EffortLimit,
    /// A geometric progression for both edges of a brake together, for the rising one and for the
    /// falling one.
    Edges {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// Exponents of a curve that ends at the greatest command.
    CommandExponent(&'static [f64]),
    /// Rates at which the effort reaches the greatest command in a time.
    EffortRate,
    /// Anchors in the plane, around where the tip moves.
    Anchor,
    /// A geometric progression of shares of the load at the greatest effort, of the load and of its
    /// powers.
    OfLoad {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// Widths of a gap, as shares of the travel.
    Gap,
    /// A geometric progression in shares of the travel, about zero and about the middle of the
    /// travel.
    OfTravel {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
    /// Positions inside the travel, each with the side beyond it.
    Stop,
    /// Resonances and damping ratios.
    Resonance,
    /// Half widths of a current hysteresis, A: a geometric progression. A plant may add the current
    /// at which it closes.
    CurrentPlay {
        /// The least.
        low: f64,
        /// The greatest.
        high: f64,
        /// Their number.
        count: usize,
    },
}

impl Shapes {
    /// Whether the shape is a period over the travel.
    pub const fn is_a_period(self) -> bool {
        matches!(self, Shapes::Period | Shapes::Pitch)
    }
}

/// How common a mechanism is among those that models leave out.
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

/// The greatest torque or force with which a mechanism holds its joint at rest, from its
/// parameters.
#[derive(Clone, Copy)]
pub enum AtRest {
    /// It does not hold.
    Nothing,
    /// A dry friction level, N·m or N.
    Dry(fn(&[f64]) -> f64),
    /// A force against a push, N·m or N.
    Level(fn(&[f64]) -> f64),
    /// A share of the brake's torque.
    OfBrake(fn(&[f64]) -> f64),
    /// A lever arm for the force on the tip, m.
    OfLoad(fn(&[f64]) -> f64),
}

/// The first parameter.
pub(super) fn first(numbers: &[f64]) -> f64 {
    numbers.first().copied().unwrap_or(0.0)
}

/// The first parameter; 0 if it is negative.
pub(super) fn first_if_positive(numbers: &[f64]) -> f64 {
    first(numbers).max(0.0)
}

/// The simpler mechanism that a richer one becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// The simpler one.
    pub of: Mechanism,
    /// The index of the parameter that goes to a limit.
    pub parameter: usize,
    /// The limit.
    pub end: End,
}

/// The limit of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At 0.
    Nothing,
    /// At infinity.
    Everything,
}

/// The size of a small change of a mechanism's parameters, for a refit by free runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refit {
    /// Whether its first parameter counts in the scale of the plant's efforts.
    pub leads: bool,
    /// The scale of each parameter relative to that of the efforts; empty for one that is scaled by
    /// itself.
    pub sizes: &'static [f64],
}

impl Entry {
    /// Whether it is a mechanism or has it as its limit: a recording that cannot separate them
    /// holds either.
    pub fn is_or_has_limit(&self, mechanism: Mechanism) -> bool {
        self.mechanism == mechanism || self.facts.limit.is_some_and(|limit| limit.of == mechanism)
    }
}

#[cfg(test)]
mod tests {
    use super::super::LIBRARY;
    use super::*;
    use std::iter::once;

    /// A mechanism's row in the catalogue.
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
            Alone::WithCharacteristic => "on a bench with a characteristic",
            Alone::WithDrive => "with a drive or a brake's current",
            Alone::Driven => "on an axis",
            Alone::Loaded => "on an axis, and on a bench with a simulated effort",
            Alone::WithInertia => "on an axis of known inertia",
        };
        let sweep = match facts.in_a_sweep {
            true => "; in a static sweep",
            false => "",
        };
        let five_bar = match facts.asked.five_bar {
            Where::Nowhere => "no",
            Where::Brakes => "at brakes",
            Where::Bearings => "at joints without a brake",
            Where::Joints => "at every joint",
            Where::Encoders => "at encoders",
            Where::Whole => "as a whole",
        };
        let arm = match (facts.at_arm, facts.at_transmission) {
            (true, true) => "at joints and in gears",
            (true, false) => "at joints",
            (false, true) => "in gears",
            (false, false) => "no",
        };
        format!(
            "| `{}` | {} | {forms} | {limit} | {alone}{sweep} | {five_bar} | {arm} | {} |",
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
