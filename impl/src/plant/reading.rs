//! This file says what can be seen of the plant.

use super::Plant;
use super::brake::Brake;
use super::form::form;
use super::friction::Contact;
use super::setup::elbows;
use super::turn::angles_between;
use crate::linkage::{Linkage, Shape};
use crate::vector::Vector;

impl Plant {
    /// θA and θB, rad: what the encoders see.
    pub fn base_angles_rad(&self) -> [f64; 2] {
        self.motion.theta_rad.into()
    }

    /// Their rates, rad/s.
    pub fn base_rates_rad_s(&self) -> [f64; 2] {
        self.motion.rates_rad_s.into()
    }

    /// The arms.
    pub fn linkage(&self) -> &Linkage<f64> {
        &self.motion.linkage
    }

    /// Their lengths.
    pub fn shape(&self) -> &Shape<f64> {
        &self.mechanism.shape
    }

    /// The tip, m.
    pub fn tip_m(&self) -> Vector<f64> {
        self.motion.linkage.tip_m
    }

    /// The velocity of the tip, m/s.
    pub fn tip_velocity_m_s(&self) -> Vector<f64> {
        self.motion.linkage.tip_velocity(self.motion.rates_rad_s)
    }

    /// The angles of joints A, E, B, C, rad.
    pub fn joint_angles_rad(&self) -> [f64; 4] {
        let [_, e, _, c] = self.looked_rad;
        let [by_e, by_c] = angles_between(self.elbows, elbows(&self.motion.linkage));
        let theta = self.motion.theta_rad;
        [theta.x, e + by_e, theta.y, c + by_c]
    }

    /// The rates of joints A, E, B, C, rad/s; exactly zero where a brake holds, never against the sign of a slip by what the end of a
    /// step is foreseen to be.
    pub fn joint_rates_rad_s(&self) -> [f64; 4] {
        let v = self.motion.rates_rad_s;
        let [turning_ed, turning_cd] = self.motion.linkage.turning().map(|row| row.dot(v));
        let mut rates = [v.x, turning_ed - v.x, v.y, turning_cd - v.y];
        for (rate, held) in rates.iter_mut().zip(self.held) {
            *rate = if held { 0.0 } else { *rate };
        }
        for (rate, torque_nm) in rates.iter_mut().zip(self.torques_nm) {
            *rate = if *rate * torque_nm > 0.0 { 0.0 } else { *rate };
        }
        rates
    }

    /// What the brakes A, E, B, C exerted on their joints in the end of the last step, in the sense of the joint's angle, N·m.
    pub fn brake_torques_nm(&self) -> [f64; 4] {
        self.torques_nm
    }

    /// The yield torques of the brakes A, E, B, C, N·m; zero where there is none.
    pub fn yield_torques_nm(&self) -> [f64; 4] {
        let mut yields_nm = self.brakes.map(|brake| brake.yield_nm());
        for (yield_nm, brake) in yields_nm.iter_mut().zip(&self.characteristics) {
            *yield_nm = if brake.is_some() { *yield_nm } else { 0.0 };
        }
        yields_nm
    }

    /// The torques of the brakes A, E, B, C without current, N·m; zero where there is none.
    pub fn off_state_nm(&self) -> [f64; 4] {
        self.characteristics
            .map(|of| of.map_or(0.0, |of| of.off_state_nm()))
    }

    /// Which of the joints A, E, B, C were held at the end of the last step.
    pub fn stuck(&self) -> [bool; 4] {
        self.held
    }

    /// What the brakes did in the last step.
    pub fn contact(&self) -> Contact {
        self.contact
    }

    /// The brakes A, E, B, C; what stands where there is none is never stepped.
    pub fn brakes(&self) -> &[Brake; 4] {
        &self.brakes
    }

    /// Time since the start, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy_j(&self) -> f64 {
        let rates = self.motion.rates_rad_s;
        let form = form(&self.mechanism.bodies, &self.motion.linkage, rates);
        form.kinetic_energy_j(rates)
    }
}
