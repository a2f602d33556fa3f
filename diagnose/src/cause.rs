//! This file names a cause: a mechanism that a model may lack, and its place.

use rigproof_model::effects::{Form, Law, form, law, law_of_torque};
use rigproof_spec::effect::Mechanism;

/// A joint by its index in the plant's own order. The plant knows its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointId(pub usize);

/// Where something acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// The plant as a whole, or its only joint.
    Whole,
    /// One joint of several.
    Joint(JointId),
    /// Every joint of a kind, with common parameters.
    Every,
    /// One axis of a sensor.
    Axis(usize),
}

/// The factor of a cause's law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scales {
    /// None: the parameters are efforts.
    Nothing,
    /// The torque of the brake at its place: the parameters are shares of it.
    Torque,
}

/// Something that a model may lack: a mechanism at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cause {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The place where it acts.
    pub at: Place,
    /// The factor of its law.
    pub scales: Scales,
}

impl Cause {
    /// A mechanism of the whole plant.
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

    /// The same cause as a share of the brake's torque.
    pub const fn of_torque(self) -> Cause {
        Cause {
            scales: Scales::Torque,
            ..self
        }
    }

    /// The law of a resistance with these parameters, an effort or a share of the brake's torque;
    /// `None` for another form.
    pub fn law(self, parameters: &[f64]) -> Option<Box<dyn Law>> {
        match self.scales {
            Scales::Nothing => law(self.mechanism, parameters),
            Scales::Torque => law_of_torque(self.mechanism, parameters),
        }
    }

    /// Whether it changes the drive: it acts on the effort that everything else gives.
    pub fn is_of_drive(self) -> bool {
        matches!(form(self.mechanism), Some(Form::Drive(_)))
    }

    /// Whether it is a composed variant: shared by joints, in proportion to a torque, or on one
    /// axis of a sensor.
    pub const fn is_composed(self) -> bool {
        matches!(self.at, Place::Every | Place::Axis(_)) || matches!(self.scales, Scales::Torque)
    }
}
