//! This file is what can be left out, and where.

use rigproof_model::effects::{Form, form};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;

/// Something that can be left out: a mechanism, and on a linkage the joint at which it acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cause {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The joint; `None` on a plant of one joint and for what belongs to the whole linkage.
    pub joint: Option<Joint>,
}

impl Cause {
    /// A mechanism without a joint.
    pub const fn of(mechanism: Mechanism) -> Cause {
        Cause {
            mechanism,
            joint: None,
        }
    }

    /// Whether the whole linkage stands otherwise than recorded: the columns are rows of their own, not averages of a signal.
    pub fn moves_linkage(self) -> bool {
        self.joint.is_some() && form(self.mechanism).is_some_and(Form::is_of_encoder)
    }

    /// The name in reports: `viscous`, `viscous at E`.
    pub fn name(self) -> String {
        match self.joint {
            Some(joint) => format!("{} at {}", self.mechanism.name(), joint.letter()),
            None => self.mechanism.name().to_owned(),
        }
    }
}
