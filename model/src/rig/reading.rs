//! This file says what can be seen of the rig: where it is, how it moves, what its brakes do and where its energy went.

use nalgebra::Vector2;
use rigproof_spec::joint::Joint;

use super::{Contact, Parameters, Rig};
use crate::brake::Brake;
use crate::linkage::Pose;
use crate::motion::two_coordinate::TwoCoordinate;

impl Rig {
    /// What the rig is made of.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The configuration of the linkage.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The tip, x and y, m.
    pub fn tip_m(&self) -> [f64; 2] {
        self.pose.tip_m
    }

    /// The velocity of the tip, x and y, m/s.
    pub fn tip_velocity_m_s(&self) -> [f64; 2] {
        self.form.tip_velocity_m_s(self.rates_rad_s)
    }

    /// θA and θB, rad: what the encoders see.
    pub fn base_angles_rad(&self) -> [f64; 2] {
        self.theta_rad
    }

    /// The rates of θA and θB, rad/s.
    pub fn base_rates_rad_s(&self) -> [f64; 2] {
        self.rates_rad_s
    }

    /// The angles of joints A, E, B, C, rad.
    pub fn joint_angles_rad(&self) -> [f64; 4] {
        super::joint_angles_rad(&self.pose)
    }

    /// The rates of joints A, E, B, C, rad/s; exactly zero where a brake holds.
    pub fn joint_rates_rad_s(&self) -> [f64; 4] {
        self.contacts
            .joint_rates(&self.form, Vector2::from(self.rates_rad_s))
    }

    /// What the brakes A, E, B, C exert on their joints, in the sense of the joint's angle, N·m.
    pub fn brake_torques_nm(&self) -> [f64; 4] {
        self.torques_nm
    }

    /// The yield torques of the brakes A, E, B, C, N·m; zero where there is none.
    pub fn yield_torques_nm(&self) -> [f64; 4] {
        self.yields_nm
    }

    /// Which of the joints A, E, B, C are held by their brake.
    pub fn stuck(&self) -> [bool; 4] {
        self.contacts.held()
    }

    /// What the brakes A, E, B, C do.
    pub fn contacts(&self) -> [Contact; 4] {
        self.contacts.of()
    }

    /// The brake of a joint, if it has one.
    pub fn brake(&self, joint: Joint) -> Option<&Brake> {
        self.brakes.get(joint as usize).and_then(Option::as_ref)
    }

    /// The two-coordinate form of the motion now.
    pub fn form(&self) -> &TwoCoordinate {
        &self.form
    }

    /// Time since the start, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// How often a brake has changed what it does inside a step: stuck, slipped, entered or left its backlash, or changed the
    /// form of its time constant.
    pub fn events(&self) -> u64 {
        self.events
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy_j(&self) -> f64 {
        self.form.kinetic_energy_j(self.rates_rad_s)
    }

    /// Energy that the brakes have taken since the start, J.
    pub fn dissipated_j(&self) -> f64 {
        self.dissipated_j
    }

    /// Work that the tip force has done since the start, J.
    pub fn work_j(&self) -> f64 {
        self.work_j
    }
}
