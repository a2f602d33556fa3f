//! This file is what parameters of mechanisms measure, and their dimensions on a plant that slides or turns.

use crate::units::Dimension;

/// What a parameter measures, whether the plant turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A plain number.
    Number,
    /// Seconds.
    Time,
    /// Metres or radians.
    Travel,
    /// Metres or radians per second.
    Speed,
    /// Newtons or newton metres.
    Effort,
    /// Effort over travel.
    EffortPerTravel,
    /// Effort over speed.
    EffortPerSpeed,
    /// Effort over cubed travel.
    EffortPerCubicTravel,
    /// Effort over time.
    EffortPerTime,
    /// One over travel.
    PerTravel,
    /// Effort over acceleration: mass or moment of inertia.
    Inertia,
    /// Amperes.
    Current,
    /// One over joule.
    PerEnergy,
    /// One over time.
    PerTime,
    /// Metres per squared second, whatever the plant does.
    Acceleration,
    /// Metres, whatever the plant does.
    Length,
    /// Kilograms, whatever the plant does.
    Mass,
    /// Kilograms times squared metres, whatever the plant does.
    MomentOfInertia,
    /// Kilograms times metres, whatever the plant does.
    FirstMoment,
    /// Newtons, whatever the plant does.
    Force,
    /// Newtons per metre, whatever the plant does.
    ForcePerLength,
    /// Radians, whatever the plant does.
    Angle,
}

/// Whether a plant slides or turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Metres and newtons.
    Linear,
    /// Radians and newton metres.
    Rotary,
}

impl Quantity {
    /// The physical dimension for a sliding or a turning plant.
    pub const fn dimension(self, motion: Motion) -> Dimension {
        let (travel, effort) = match motion {
            Motion::Linear => (Dimension::LENGTH, Dimension::FORCE),
            Motion::Rotary => (Dimension::ANGLE, Dimension::TORQUE),
        };
        let speed = travel.per(Dimension::TIME);
        match self {
            Quantity::Number => Dimension::NUMBER,
            Quantity::Time => Dimension::TIME,
            Quantity::Travel => travel,
            Quantity::Speed => speed,
            Quantity::Effort => effort,
            Quantity::EffortPerTravel => effort.per(travel),
            Quantity::EffortPerSpeed => effort.per(speed),
            Quantity::EffortPerCubicTravel => effort.per(travel.power(3)),
            Quantity::EffortPerTime => effort.per(Dimension::TIME),
            Quantity::PerTravel => Dimension::NUMBER.per(travel),
            Quantity::Inertia => effort.per(speed.per(Dimension::TIME)),
            Quantity::Current => Dimension::CURRENT,
            Quantity::PerEnergy => Dimension::NUMBER.per(Dimension::FORCE.times(Dimension::LENGTH)),
            Quantity::PerTime => Dimension::NUMBER.per(Dimension::TIME),
            Quantity::Acceleration => Dimension::LENGTH.per(Dimension::TIME.power(2)),
            Quantity::Mass => Dimension::FORCE
                .per(Dimension::LENGTH)
                .times(Dimension::TIME.power(2)),
            Quantity::FirstMoment => Dimension::FORCE.times(Dimension::TIME.power(2)),
            Quantity::MomentOfInertia => Dimension::FORCE
                .times(Dimension::LENGTH)
                .times(Dimension::TIME.power(2)),
            Quantity::Force => Dimension::FORCE,
            Quantity::ForcePerLength => Dimension::FORCE.per(Dimension::LENGTH),
            Quantity::Length => Dimension::LENGTH,
            Quantity::Angle => Dimension::ANGLE,
        }
    }

    /// The dimension on a plant whose brakes may be driven by something else than a current.
    pub const fn driven(self, motion: Motion, driving: Dimension) -> Dimension {
        match self {
            Quantity::Current => driving,
            other => other.dimension(motion),
        }
    }

    /// The dimension of a value that is a share of an effort: over that effort where it is one.
    pub const fn dimension_of_share(self, motion: Motion) -> Dimension {
        let own = self.dimension(motion);
        match self {
            Quantity::Effort
            | Quantity::EffortPerTravel
            | Quantity::EffortPerSpeed
            | Quantity::EffortPerCubicTravel
            | Quantity::EffortPerTime => own.per(Quantity::Effort.dimension(motion)),
            _ => own,
        }
    }
}
