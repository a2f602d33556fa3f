//! This file puts a rig into a state that it, or another program of the same rig, has reached.

use nalgebra::Vector2;
use rigproof_spec::joint::Joint;

use super::contact::Contacts;
use super::{Parameters, Rig};
use crate::brake::{Brake, BrakeState};
use crate::error::ModelError;

/// Everything that the next step of a rig depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The brakes of A, E, B, C; not read where there is none.
    pub brakes: [BrakeState; 4],
    /// Which of A, E, B, C are held by their brake.
    pub held: [bool; 4],
}

impl Rig {
    /// A rig that goes on from a moment; what is left of a held joint's rate is taken away.
    ///
    /// # Errors
    /// Those of [`Rig::moving`].
    pub fn resumed(parameters: Parameters, moment: &Moment) -> Result<Rig, ModelError> {
        let mut rig = Rig::moving(parameters, moment.theta_rad, moment.rates_rad_s)?;
        let all = Joint::ALL.into_iter().zip(&moment.brakes);
        for (brake, (joint, state)) in rig.brakes.iter_mut().zip(all) {
            *brake = brake.map(|_| Brake::resumed(joint, state));
        }
        let joint_rates = rig.form.joint_rates_rad_s(moment.rates_rad_s);
        let braked = rig.brakes.map(|brake| brake.is_some());
        rig.contacts = Contacts::resumed(braked, moment.held, joint_rates);
        let rates = rig
            .contacts
            .project(&rig.form, Vector2::from(moment.rates_rad_s));
        rig.go_on_with(moment.rates_rad_s, rates);
        rig.settle();
        Ok(rig)
    }
}
