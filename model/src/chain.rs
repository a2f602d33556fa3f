//! This file is a serial arm: a fixed base, joints that turn or slide one after another, and the ten inertial numbers of each link.
//!
//! Link `k` is what joint `k` moves before the next joint comes. The effort of a joint is counted positive along its axis, N·m or N.

mod base;
mod dynamics;
mod inertial;
mod mjcf;
mod possible;
mod regressor;
mod urdf;
mod written;
mod xml;

pub use base::{Base, Group};
pub use dynamics::Pose;
pub use inertial::{INERTIAL, Inertial, PARAMETER_NAMES};
pub use regressor::Momentum;
pub use written::{Changes, Stated};
pub use xml::{FormatError, is_mjcf};

use nalgebra::{Matrix3, Vector3};

/// Whether a joint turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It turns: rad, N·m.
    Revolute,
    /// It slides: m, N.
    Prismatic,
}

/// A joint, and the link that it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// The name of the link that it moves; none between two joints of one body.
    pub link: String,
    /// Whether it turns or slides.
    pub kind: Kind,
    /// Its frame at zero in the frame of the link before: rotation.
    pub rotation: Matrix3<f64>,
    /// Its frame's origin in the frame of the link before, m.
    pub origin: Vector3<f64>,
    /// Its axis in its own frame, of length 1.
    pub axis: Vector3<f64>,
    /// The inertial numbers of its link about the frame's origin; links fixed to it are counted in.
    pub inertial: Inertial,
    /// Those of the link alone.
    pub own: Inertial,
    /// Viscous friction that the description states, N·m·s/rad or N·s/m.
    pub damping: f64,
    /// Coulomb friction that the description states, N·m or N.
    pub friction: f64,
    /// Inertia of a rotor that turns or slides with the joint alone, kg·m² or kg.
    pub armature: f64,
}

/// A serial arm on a fixed base.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// What people call it.
    pub name: String,
    /// The joints from the base on.
    pub joints: Vec<Joint>,
    /// The place of the last link, the tip, in the frame of the last joint, m: where a payload is fixed.
    pub tip: Vector3<f64>,
    /// Acceleration of free fall in the frame of the base, m/s².
    pub gravity: Vector3<f64>,
}

impl Chain {
    /// The inertial numbers of all links, ten a link.
    pub fn parameters(&self) -> Vec<f64> {
        let each = self.joints.iter();
        each.flat_map(|joint| joint.inertial.numbers()).collect()
    }

    /// What one kilogram at the tip adds to the inertial numbers, ten a link.
    pub fn of_a_payload(&self) -> Vec<f64> {
        let ball = Inertial::about_centre(1.0, self.tip, Matrix3::zeros());
        let mut numbers = vec![0.0; INERTIAL * self.joints.len().saturating_sub(1)];
        numbers.extend(ball.numbers());
        numbers
    }

    /// The same arm with other inertial numbers, ten a link.
    pub fn with_parameters(&self, numbers: &[f64]) -> Chain {
        let mut other = self.clone();
        for (joint, own) in other.joints.iter_mut().zip(numbers.chunks_exact(INERTIAL)) {
            joint.inertial = Inertial::of(own);
        }
        other
    }
}

#[cfg(test)]
mod tests;
