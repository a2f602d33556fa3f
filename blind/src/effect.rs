//! This file is the one description of hidden physics: a law in one of its forms, what it scales, where it acts, its numbers, and from when.

use crate::form::{Form, Stage};
use rigproof_spec::effect::{Motion, Quantity};
use rigproof_spec::joint::Joint;
use rigproof_spec::units::Dimension;

/// What a force is a share of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scales {
    /// Nothing: the numbers are efforts.
    Nothing,
    /// The torque that the brake or the drive gives.
    Drive,
}

/// Where an effect acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// The machine as a whole, or its only joint.
    Whole,
    /// One joint of a five-bar.
    Joint(Joint),
    /// One joint of a serial arm, counted from the base, or the link that it moves.
    Arm(usize),
    /// Every joint with a brake, with the same numbers.
    Every,
    /// One axis of a sensor: 0 for x, 1 for y.
    Sensor(usize),
}

/// Hidden physics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    pub form: Form,
    /// The numbers of the form, in its order; what it does not have is 0.
    pub values: [f64; 4],
    pub scales: Scales,
    pub at: At,
    /// From when it acts, s; `None` when it always does.
    pub onset_s: Option<f64>,
}

impl Form {
    /// The form with its numbers, always and on the whole.
    pub fn of<const N: usize>(self, numbers: [f64; N]) -> Effect {
        let mut values = [0.0; 4];
        for (value, number) in values.iter_mut().zip(numbers) {
            *value = number;
        }
        Effect {
            form: self,
            values,
            scales: Scales::Nothing,
            at: At::Whole,
            onset_s: None,
        }
    }
}

impl Effect {
    /// The same at another place.
    pub const fn at(self, at: At) -> Effect {
        Effect { at, ..self }
    }

    /// The same at a joint.
    pub const fn joint(self, joint: Joint) -> Effect {
        self.at(At::Joint(joint))
    }

    /// The same as a share of the brake's torque.
    pub const fn of_drive(self) -> Effect {
        Effect {
            scales: Scales::Drive,
            ..self
        }
    }

    /// The first number, which is the strength of most forms.
    pub const fn first(&self) -> f64 {
        let [first, ..] = self.values;
        first
    }

    /// Whether the law acts at that time.
    pub fn acts(&self, time_s: f64) -> bool {
        self.onset_s.is_none_or(|onset_s| time_s >= onset_s)
    }

    /// Whether it acts at a joint.
    pub fn is_at(&self, joint: Joint) -> bool {
        self.at == At::Joint(joint) || self.at == At::Every
    }

    /// The name in the answer: the vocabulary's where it has one.
    pub const fn name(&self) -> &'static str {
        self.form.facts().mechanism
    }

    pub const fn stage(&self) -> Stage {
        self.form.facts().stage
    }

    /// Whether the effect is known only by what it does to the nominal equations, not as a force of its own.
    pub const fn is_residual(&self) -> bool {
        matches!(self.stage(), Stage::Body | Stage::Sensor)
    }

    /// The same effect with its strength multiplied, its shape kept.
    pub fn scaled(self, factor: f64) -> Effect {
        let mut effect = self;
        for (number, value) in effect.values.iter_mut().zip(self.form.facts().values) {
            if value.strong {
                *number *= factor;
            }
        }
        effect
    }

    /// The numbers with their names and units.
    pub fn parameters(&self, motion: Motion) -> Vec<(&'static str, f64, Dimension)> {
        let facts = self.form.facts();
        let each = facts.values.iter().zip(self.values);
        each.filter(|(value, _)| !value.name.is_empty())
            .map(|(value, number)| {
                let dimension = match (value.quantity, self.scales) {
                    (Quantity::Effort, Scales::Drive) => Dimension::NUMBER,
                    // The vocabulary has no quantity for cycles a second.
                    _ if value.name == "frequency" => Dimension::NUMBER.per(Dimension::TIME),
                    (quantity, _) => quantity.dimension(motion),
                };
                (value.name, number, dimension)
            })
            .collect()
    }
}
