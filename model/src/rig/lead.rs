//! This file leads the rig along a motion that is imposed on it, and lets its left-out physics follow a motion of either kind.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use nalgebra::Vector2;

use super::contact::Contacts;
use super::left_out::Situation;
use super::{Parameters, Rig, check_finite, check_step, joint_angles_rad};
use crate::error::ModelError;
use crate::linkage::{Pose, forward};
use crate::motion::two_coordinate::{TwoCoordinate, two_coordinate};

impl Rig {
    /// Leads the rig to θA and θB, rad, where they turn at some rates, rad/s: brakes and what the left-out physics remembers follow
    /// as in a step of `step_s` with these currents, A; a brake whose joint turns slips. What moved the rig is not asked for, so that work and
    /// dissipated energy stay as they are.
    ///
    /// `told` says of which joints it is known that they turn: at the others the path is smoothed noise, which is no reversal, and what a
    /// reversal begins anew stands still.
    ///
    /// So a rig comes to the state that a recording implies, and can be let go there.
    ///
    /// # Errors
    /// As [`Rig::step`]; the rig then is as it was before.
    pub fn lead(
        &mut self,
        theta_rad: [f64; 2],
        rates_rad_s: [f64; 2],
        currents_a: [f64; 4],
        told: [bool; 4],
        step_s: f64,
    ) -> Result<(), ModelError> {
        self.check_currents(currents_a)?;
        check_step(step_s)?;
        check_finite("rate of a base joint", "rad/s", rates_rad_s)?;
        let [theta_a, theta_b] = theta_rad;
        let pose = forward::pose(&self.parameters.arms, theta_a, theta_b)?;
        let given_a = self.given_currents(currents_a, step_s);
        let Parameters { arms, inertia, .. } = &self.parameters;
        self.form = two_coordinate(arms, inertia, &pose, rates_rad_s);
        let rates = self.form.joint_rates_rad_s(rates_rad_s);
        let angles = joint_angles_rad(&pose);
        for i in 0..4 {
            if let Some(brake) = &mut self.brakes[i] {
                brake.step(given_a[i], angles[i], rates[i], step_s);
            }
        }
        self.effects_follow(&pose, told, step_s);
        (self.theta_rad, self.rates_rad_s, self.pose) = (theta_rad, rates_rad_s, pose);
        self.time_s += step_s;
        self.contacts = Contacts::starting(self.contacts.exist(), rates);
        self.settle();
        Ok(())
    }

    /// What the brakes get in a step that begins now when they are commanded these currents, A.
    pub(super) fn given_currents(&mut self, commanded_a: [f64; 4], step_s: f64) -> [f64; 4] {
        if self.effects.is_none() {
            return commanded_a;
        }
        self.begin_effects();
        let given_a = match &mut self.effects {
            Some(effects) => effects.currents(commanded_a, self.time_s, step_s),
            None => commanded_a,
        };
        self.settle();
        given_a
    }

    /// Advances what the left-out physics remembers to where the joints stand in `pose`; the brakes are there already.
    pub(super) fn effects_follow(&mut self, pose: &Pose, told: [bool; 4], step_s: f64) {
        let travels_rad = self.travels_rad(pose);
        let own_nm = self.own_yields_nm();
        if let Some(effects) = &mut self.effects {
            effects.follow(travels_rad, told, own_nm, step_s);
        }
    }

    /// What drives θA and θB under a force on the tip, N, beside the dry joints, N·m.
    pub(super) fn drive(&self, tip_force_n: [f64; 2]) -> Vector2<f64> {
        let drive = self.form.drive(tip_force_n);
        match &self.effects {
            Some(effects) => drive + effects.at(&self.present(tip_force_n)).drive,
            None => drive,
        }
    }

    /// What a force on the tip, N, makes of the yields.
    pub(super) fn feel(&mut self, tip_force_n: [f64; 2]) {
        if let Some(effects) = &self.effects {
            self.yields_nm = effects.at(&self.present(tip_force_n)).yields_nm;
        }
    }

    /// Yields and torques as they belong to the present state without a force on the tip.
    pub(super) fn settle(&mut self) {
        self.yields_nm = match &self.effects {
            Some(effects) => effects.at(&self.present([0.0; 2])).yields_nm,
            None => self.own_yields_nm(),
        };
        let balance = self
            .contacts
            .balance(&self.form, self.drive([0.0; 2]), self.yields_nm);
        self.torques_nm = balance.torques_nm;
    }

    /// What the effects look at in a pose on the way from the present one.
    pub(super) fn situation<'a>(
        &'a self,
        pose: &'a Pose,
        form: &'a TwoCoordinate,
        joint_rates_rad_s: [f64; 4],
        own_nm: [f64; 4],
        tip_force_n: [f64; 2],
    ) -> Situation<'a> {
        Situation {
            time_s: self.time_s,
            form,
            tip_m: pose.tip_m,
            inertia: &self.parameters.inertia,
            contacts: self.contacts.of(),
            angles_rad: joint_angles_rad(pose),
            joint_rates_rad_s,
            travels_rad: self.travels_rad(pose),
            own_nm,
            tip_force_n,
        }
    }

    fn present(&self, tip_force_n: [f64; 2]) -> Situation<'_> {
        self.situation(
            &self.pose,
            &self.form,
            self.joint_rates_rad_s(),
            self.own_yields_nm(),
            tip_force_n,
        )
    }

    fn own_yields_nm(&self) -> [f64; 4] {
        self.brakes
            .map(|brake| brake.map_or(0.0, |brake| brake.yield_torque()))
    }

    /// How far the joints are from where they stand now, rad; exactly zero where one is held.
    fn travels_rad(&self, pose: &Pose) -> [f64; 4] {
        let (to, from) = (joint_angles_rad(pose), self.joint_angles_rad());
        let held = self.contacts.held();
        [0, 1, 2, 3].map(|i| if held[i] { 0.0 } else { to[i] - from[i] })
    }
}
