//! This file is the rig: the five-bar linkage, its three or four brakes and a force on its tip, moved from step to step.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

mod contact;
mod flow;
pub mod release;

use nalgebra::Vector2;
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::current_limit;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::brake::Brake;
use crate::error::ModelError;
use crate::linkage::{Pose, forward, inverse};
use crate::motion::check_inertia;
use crate::motion::two_coordinate::{TwoCoordinate, two_coordinate};

pub use contact::Contact;
use contact::Contacts;
use flow::{Flow, State};

/// Longest step of the integrator, s; longer steps are divided.
pub const LONGEST_STEP_S: f64 = 1e-3;
/// Longest step that [`Rig::step`] takes, s.
pub const GREATEST_STEP_S: f64 = 60.0;
/// How often a step is halved to find where a brake changes what it does: 1 ms to 1e-15 s.
const HALVINGS: u32 = 40;
/// Most changes within one step of the integrator.
const MOST_EVENTS: u32 = 400;

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
        Ok(Rig {
            parameters,
            theta_rad,
            rates_rad_s,
            brakes,
            contacts: Contacts::starting(with_brake, form.joint_rates_rad_s(rates_rad_s)),
            pose,
            form,
            torques_nm: [0.0; 4],
            yields_nm: brakes.map(|brake| brake.map_or(0.0, |brake| brake.yield_torque())),
            longest_step_s: LONGEST_STEP_S,
            events: 0,
            time_s: 0.0,
            work_j: 0.0,
            dissipated_j: 0.0,
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

    /// Advances by `step_s` under a constant force on the tip, x and y, N, and constant currents A, E, B, C, A.
    ///
    /// # Errors
    /// As [`Rig::step_under`].
    pub fn step(
        &mut self,
        tip_force_n: [f64; 2],
        currents_a: [f64; 4],
        step_s: f64,
    ) -> Result<(), ModelError> {
        self.step_under(&|_, _| tip_force_n, currents_a, step_s)
    }

    /// Advances by `step_s` under a force that depends on the tip's position and velocity, and constant currents, A.
    ///
    /// # Errors
    /// [`ModelError::Current`], [`ModelError::CurrentWithoutBrake`], [`ModelError::NotFinite`], [`ModelError::TimeStep`] for
    /// what was given; [`ModelError::Singular`] or [`ModelError::CannotClose`] where the linkage is driven out of its
    /// assembly; [`ModelError::Events`]. The rig then is as it was before.
    pub fn step_under(
        &mut self,
        tip_force: &impl TipForce,
        currents_a: [f64; 4],
        step_s: f64,
    ) -> Result<(), ModelError> {
        self.check_currents(currents_a)?;
        check_step(step_s)?;
        let mut next = self.clone();
        let steps = (step_s / self.longest_step_s * (1.0 - 1e-9))
            .ceil()
            .max(1.0);
        for _ in 0..steps as u64 {
            next.short_step(tip_force, currents_a, step_s / steps)?;
        }
        *self = next;
        Ok(())
    }

    /// One step of the integrator, divided where a brake changes what it does.
    fn short_step(
        &mut self,
        tip_force: &impl TipForce,
        currents_a: [f64; 4],
        step_s: f64,
    ) -> Result<(), ModelError> {
        self.decide(tip_force)?;
        let mut left_s = step_s;
        let mut events = 0;
        while left_s > 0.0 {
            let flow = Flow::new(self, tip_force, currents_a);
            let end = flow.after(&flow.start(), left_s)?;
            if !flow.ended(&end)? {
                self.arrive(tip_force, currents_a, end, left_s)?;
                return Ok(());
            }
            let (end, taken_s) = first_change(&flow, end, left_s)?;
            self.arrive(tip_force, currents_a, end, taken_s)?;
            self.decide(tip_force)?;
            left_s -= taken_s;
            events += 1;
            self.events += 1;
            if events > MOST_EVENTS {
                return Err(ModelError::Events {
                    events,
                    time_s: self.time_s,
                });
            }
        }
        Ok(())
    }

    /// Takes on the state at the end of a stretch.
    fn arrive(
        &mut self,
        tip_force: &impl TipForce,
        currents_a: [f64; 4],
        end: State,
        taken_s: f64,
    ) -> Result<(), ModelError> {
        let flow = Flow::new(self, tip_force, currents_a);
        let instant = flow.instant(&end)?;
        let brakes = flow.brakes_at(&end, &instant.pose);
        let rates = self
            .contacts
            .project(&instant.form, Vector2::new(end[2], end[3]));
        self.brakes = brakes;
        self.theta_rad = [end[0], end[1]];
        self.time_s += taken_s;
        self.work_j += end[8];
        self.dissipated_j += end[9];
        self.pose = instant.pose;
        self.form = instant.form;
        self.torques_nm = instant.balance.torques_nm;
        self.yields_nm = instant.yields_nm;
        self.go_on_with([end[2], end[3]], rates);
        Ok(())
    }

    /// Decides which brakes hold and slip under the force that acts now.
    fn decide(&mut self, tip_force: &impl TipForce) -> Result<(), ModelError> {
        let tip_force_n = tip_force.force_n(self.pose.tip_m, self.tip_velocity_m_s());
        check_finite("force on the tip", "N", tip_force_n)?;
        let before = self.rates_rad_s;
        let (contacts, rates) = self.contacts.decide(
            &self.form,
            Vector2::from(before),
            tip_force_n,
            self.yields_nm,
        );
        self.contacts = contacts;
        self.go_on_with(before, rates);
        self.torques_nm = contacts
            .balance(&self.form, tip_force_n, self.yields_nm)
            .torques_nm;
        Ok(())
    }

    /// Goes on with rates that lack what rounding left of the held joints' rates; the brakes take its energy.
    fn go_on_with(&mut self, before: [f64; 2], rates: Vector2<f64>) {
        let rates: [f64; 2] = rates.into();
        if rates != before {
            self.dissipated_j +=
                self.form.kinetic_energy_j(before) - self.form.kinetic_energy_j(rates);
            let Parameters { arms, inertia, .. } = &self.parameters;
            self.form = two_coordinate(arms, inertia, &self.pose, rates);
        }
        self.rates_rad_s = rates;
    }

    fn check_currents(&self, currents_a: [f64; 4]) -> Result<(), ModelError> {
        for ((joint, brake), value_a) in Joint::ALL.iter().zip(&self.brakes).zip(currents_a) {
            if brake.is_none() && value_a != 0.0 {
                return Err(ModelError::CurrentWithoutBrake {
                    joint: joint.letter(),
                    value_a,
                });
            }
            if !current_limit(value_a).holds() {
                return Err(ModelError::Current {
                    brake: joint.letter(),
                    value_a,
                    greatest_a: GREATEST_CURRENT_A,
                });
            }
        }
        Ok(())
    }

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
        joint_angles_rad(&self.pose)
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

/// The end of the stretch, and how long it took, s: where a brake first changes what it does, from a step that passed it.
fn first_change<F: TipForce>(
    flow: &Flow<'_, F>,
    past: State,
    past_s: f64,
) -> Result<(State, f64), ModelError> {
    let start = flow.start();
    let (mut before_s, mut after_s, mut after) = (0.0, past_s, past);
    for _ in 0..HALVINGS {
        let middle_s = 0.5 * (before_s + after_s);
        let middle = flow.after(&start, middle_s)?;
        if flow.ended(&middle)? {
            (after_s, after) = (middle_s, middle);
        } else {
            before_s = middle_s;
        }
    }
    Ok((after, after_s))
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
