//! This file is what can be left out, and where.

use rigproof_spec::effect::Mechanism;

/// A joint of a plant, by its place in the plant's own order; the plant has its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointId(pub usize);

/// Where something acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// The plant as a whole, or its only joint.
    Whole,
    /// One joint of several.
    Joint(JointId),
    /// Every joint of a kind, with one set of numbers.
    Every,
    /// One axis of a sensor.
    Axis(usize),
}

/// What the law of a cause is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scales {
    /// Nothing: its numbers are efforts.
    Nothing,
    /// The torque that the brake at its place gives: its numbers are shares.
    Torque,
}

/// Something that can be left out: a mechanism, and the place where it acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cause {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Where it acts.
    pub at: Place,
    /// What it scales.
    pub scales: Scales,
}

impl Cause {
    /// A mechanism of the whole.
    pub const fn of(mechanism: Mechanism) -> Cause {
        Cause::at(mechanism, Place::Whole)
    }

    /// A mechanism at a place.
    pub const fn at(mechanism: Mechanism, at: Place) -> Cause {
        Cause {
            mechanism,
            at,
            scales: Scales::Nothing,
        }
    }

    /// The same as a share of the torque that the brake gives.
    pub const fn of_torque(self) -> Cause {
        Cause {
            scales: Scales::Torque,
            ..self
        }
    }

    /// Whether it is composed: shared by joints, in proportion to a torque, or of one axis of a sensor.
    pub const fn is_composed(self) -> bool {
        matches!(self.at, Place::Every | Place::Axis(_)) || matches!(self.scales, Scales::Torque)
    }
}
