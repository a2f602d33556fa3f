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
}

/// Something that can be left out: a mechanism, and the place where it acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cause {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Where it acts.
    pub at: Place,
}

impl Cause {
    /// A mechanism of the whole.
    pub const fn of(mechanism: Mechanism) -> Cause {
        Cause::at(mechanism, Place::Whole)
    }

    /// A mechanism at a place.
    pub const fn at(mechanism: Mechanism, at: Place) -> Cause {
        Cause { mechanism, at }
    }
}
