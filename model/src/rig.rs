//! This file is the rig: the five-bar linkage, its three or four brakes and a force on its tip, moved from step to step.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

mod contact;
mod effects;
mod flow;
mod lead;
mod left_out;
mod reading;
pub mod release;
mod resume;
mod step;

use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

use crate::brake::Brake;
use crate::error::ModelError;
use crate::linkage::{Pose, forward, inverse};
use crate::motion::check_inertia;
use crate::motion::two_coordinate::{TwoCoordinate, two_coordinate};

pub use contact::Contact;
use contact::Contacts;
pub use effects::JointEffect;
use left_out::LeftOut;
pub use resume::Moment;

/// Longest step of the integrator, s; longer steps are divided.
pub const LONGEST_STEP_S: f64 = 1e-3;
/// Longest step that [`Rig::step`] takes, s.
pub const GREATEST_STEP_S: f64 = 60.0;
/// What a rig is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Which joints carry a brake.
    pub layout: Layout,
    /// The arm lengths.
    pub arms: Arms,
    /// Masses, inertias and centres of mass.
    pub inertia: Inertia,
}

impl Parameters {
    /// The thesis's rig in one of its layouts: tables 4.1 and 5.1.
    pub const fn of(layout: Layout) -> Parameters {
        Parameters {
            layout,
            arms: arms(layout),
            inertia: inertia(layout),
        }
    }
}

/// A force on the tip that may depend on where the tip is and how it moves; smooth within a step.
pub trait TipForce {
    /// The force on the tip, x and y, N, at a tip position, m, and a tip velocity, m/s.
    fn force_n(&self, tip_m: [f64; 2], tip_velocity_m_s: [f64; 2]) -> [f64; 2];
}

impl<F: Fn([f64; 2], [f64; 2]) -> [f64; 2]> TipForce for F {
    fn force_n(&self, tip_m: [f64; 2], tip_velocity_m_s: [f64; 2]) -> [f64; 2] {
        self(tip_m, tip_velocity_m_s)
    }
}

/// The rig in motion: thesis §5.3 with exact dry friction.
///
/// State: θA, θB and their rates; of every brake its yield torque and backlash; which brakes hold. The other angles follow
/// from the closed linkage, so that it cannot come apart. Joints are in the order A, E, B, C; a joint without a brake has
/// current and torque 0.
///
/// Brakes resist only: a slipping brake exerts its yield torque against its joint's rate, a held one what keeps its joint
/// at rest, at most its yield torque (§5.3.5). Where three or more brakes hold, their torques are not unique; those that
/// load each brake least by its yield are reported.
///
/// # Differs from the thesis
///
/// Which brakes hold is decided exactly (erratum `lumped-rule-drives`), and a held joint stands (erratum `karnopp-creep`). The
/// stops of §4.5 are not in the way (gap `stops-in-motion`). What the thesis leaves out can be put in: [`Rig::with_effects`].
///
/// ```
/// use rigproof_model::rig::Rig;
/// use rigproof_spec::layout::Layout;
/// let mut rig = Rig::new(Layout::ThreeBrake, [0.03, 0.41])?;
/// for _ in 0..70 {
///     rig.step([2.7, -4.1], [0.0, 0.31, 0.0, 0.0], 1e-3)?;
/// }
/// let balance_j = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
/// assert!(balance_j.abs() < 1e-9 * rig.work_j());
/// # Ok::<(), rigproof_model::error::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    parameters: Parameters,
    theta_rad: [f64; 2],
    rates_rad_s: [f64; 2],
    brakes: [Option<Brake>; 4],
    contacts: Contacts,
    pose: Pose,
    form: TwoCoordinate,
    torques_nm: [f64; 4],
    yields_nm: [f64; 4],
    longest_step_s: f64,
    events: u64,
    time_s: f64,
    work_j: f64,
    dissipated_j: f64,
    effects: Option<LeftOut>,
}

impl Rig {
    /// The thesis's rig at rest with its tip at a point, x and y, m; brakes without current, in the middle of their backlash.
    ///
    /// # Errors
    /// Those of [`inverse::pose`].
    pub fn new(layout: Layout, tip_m: [f64; 2]) -> Result<Rig, ModelError> {
        let parameters = Parameters::of(layout);
        let pose = inverse::pose(&parameters.arms, tip_m)?;
        let theta_rad = [pose.theta_a_rad, pose.theta_b_rad];
        Rig::moving(parameters, theta_rad, [0.0; 2])
    }

    /// Any rig at θA and θB, rad, turning at their rates, rad/s.
    ///
    /// # Errors
    /// Those of [`forward::pose`]; [`ModelError::Mass`]; [`ModelError::NotFinite`].
    pub fn moving(
        parameters: Parameters,
        theta_rad: [f64; 2],
        rates_rad_s: [f64; 2],
    ) -> Result<Rig, ModelError> {
        check_inertia(&parameters.inertia)?;
        check_finite("rate of a base joint", "rad/s", rates_rad_s)?;
        let [theta_a, theta_b] = theta_rad;
        let pose = forward::pose(&parameters.arms, theta_a, theta_b)?;
        let form = two_coordinate(&parameters.arms, &parameters.inertia, &pose, rates_rad_s);
        let braked = parameters.layout.brakes();
        let angles = joint_angles_rad(&pose);
        let brakes = [0, 1, 2, 3].map(|i| {
            let joint = Joint::ALL[i];
            braked
                .contains(&joint)
                .then(|| Brake::new(joint, angles[i]))
        });
        let with_brake = brakes.map(|brake| brake.is_some());
        let contacts = Contacts::starting(with_brake, form.joint_rates_rad_s(rates_rad_s));
        let yields_nm = brakes.map(|brake| brake.map_or(0.0, |brake| brake.yield_torque()));
        Ok(Rig {
            parameters,
            theta_rad,
            rates_rad_s,
            brakes,
            contacts,
            pose,
            form,
            torques_nm: contacts
                .balance(&form, form.drive([0.0; 2]), yields_nm)
                .torques_nm,
            yields_nm,
            longest_step_s: LONGEST_STEP_S,
            events: 0,
            time_s: 0.0,
            work_j: 0.0,
            dissipated_j: 0.0,
            effects: None,
        })
    }

    /// The same rig with another longest step of the integrator, s, for studies of convergence.
    ///
    /// # Errors
    /// [`ModelError::TimeStep`]: it is not above 0 s and at most [`GREATEST_STEP_S`].
    pub fn with_longest_step_s(self, longest_step_s: f64) -> Result<Rig, ModelError> {
        check_step(longest_step_s)?;
        Ok(Rig {
            longest_step_s,
            ..self
        })
    }

    /// The same rig, its brakes in the middle of a backlash that is entered after `entry_deg` of travel, for studies of what
    /// the entry travel changes.
    pub fn with_backlash_entry_deg(self, entry_deg: f64) -> Rig {
        let angles = self.joint_angles_rad();
        let brakes = [0, 1, 2, 3]
            .map(|i| self.brakes[i].map(|brake| brake.with_backlash_entry(angles[i], entry_deg)));
        Rig { brakes, ..self }
    }
}

fn joint_angles_rad(pose: &Pose) -> [f64; 4] {
    [
        pose.theta_a_rad,
        pose.theta_e_rad,
        pose.theta_b_rad,
        pose.theta_c_rad,
    ]
}

fn check_finite(
    quantity: &'static str,
    unit: &'static str,
    values: [f64; 2],
) -> Result<(), ModelError> {
    for value in values {
        if !value.is_finite() {
            return Err(ModelError::NotFinite {
                quantity,
                value,
                unit,
            });
        }
    }
    Ok(())
}

fn check_step(value_s: f64) -> Result<(), ModelError> {
    if value_s > 0.0 && value_s <= GREATEST_STEP_S {
        return Ok(());
    }
    Err(ModelError::TimeStep {
        value_s,
        greatest_s: GREATEST_STEP_S,
    })
}
