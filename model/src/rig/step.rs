//! This file moves the rig from step to step, and ends a step of the integrator where a brake changes what it does.

use nalgebra::Vector2;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::current_limit;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use super::flow::{Flow, State};
use super::{Parameters, Rig, TipForce, check_finite, check_step};
use crate::error::ModelError;
use crate::motion::two_coordinate::two_coordinate;

/// How often a step is halved to find where a brake changes what it does: 1 ms to 1e-15 s.
const HALVINGS: u32 = 40;
/// Most changes within one step of the integrator.
const MOST_EVENTS: u32 = 400;

impl Rig {
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
