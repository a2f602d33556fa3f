//! This file is what a joint does with the effort that it transmits.

use crate::effects::load_friction;

/// What a joint does with the effort that it transmits: friction by it, and parts of the inertia behind a spring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transmission {
    /// Dry friction as a share of the driving effort.
    pub friction_share: f64,
    /// Dry friction by a power of the driving effort: its share at 1 N or N·m, and the exponent.
    pub friction_power: Option<[f64; 2]>,
    /// Parts that hang on the joint by a damped spring or in a gap.
    pub trailing: [Option<Trailing>; TRAILING_PARTS],
}

impl Transmission {
    /// Adds friction by the parameters of `load_friction`.
    pub fn add_friction(&mut self, parameters: &[f64]) {
        match *parameters {
            [share, exponent, ..] => self.friction_power = Some([share, exponent]),
            [share] => self.friction_share += share,
            [] => {}
        }
    }

    /// Dry friction under a driving effort, N or N·m.
    pub fn friction(&self, effort: f64) -> f64 {
        let by_power = self.friction_power;
        self.friction_share * effort.abs() + by_power.map_or(0.0, |own| load_friction(effort, &own))
    }
}

/// How many parts can hang on a joint.
pub const TRAILING_PARTS: usize = 2;

/// A part of the inertia that follows the joint as a resonator does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trailing {
    /// Its share of the inertia, below 1.
    pub share: f64,
    /// Its resonance with the joint held, rad/s.
    pub resonance_rad_s: f64,
    /// Its damping ratio.
    pub damping: f64,
    /// How far it moves freely to either side before it meets spring and damper, m or rad; 0 where they hold it always.
    pub half_gap: f64,
}

/// The contact at the ends of a gap, rad/s: teeth, shafts and housing give way for milliseconds.
const CONTACT_RAD_S: f64 = 500.0;

impl Trailing {
    /// A part by the parameters of `compliance`: share, resonance, damping and gap; those that are missing are 0.
    pub fn of(numbers: &[f64]) -> Trailing {
        let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
        Trailing {
            share: number(0),
            resonance_rad_s: number(1),
            damping: number(2),
            half_gap: 0.5 * number(3),
        }
    }

    /// A part that is free inside a gap and meets its ends without a bounce.
    pub const fn in_a_gap(share: f64, gap: f64) -> Trailing {
        Trailing {
            share,
            resonance_rad_s: CONTACT_RAD_S,
            damping: 1.0,
            half_gap: 0.5 * gap,
        }
    }

    /// What holds it to the joint gives it this acceleration, m/s² or rad/s², at a displacement from the joint and its rate.
    pub fn pull(&self, [displacement, rate]: [f64; 2]) -> f64 {
        let resonance = self.resonance_rad_s;
        let beyond = displacement - displacement.clamp(-self.half_gap, self.half_gap);
        let pull = -resonance * (2.0 * self.damping * rate + resonance * beyond);
        // The ends of a gap push and never hold.
        match self.half_gap > 0.0 && pull * beyond >= 0.0 {
            true => 0.0,
            false => pull,
        }
    }
}
