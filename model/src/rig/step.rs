//! This file moves the rig from step to step, and ends a step of the integrator where a brake changes what it does.

use nalgebra::Vector2;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::current_limit;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use super::flow::{Flow, State};
use super::{Parameters, Rig, TipForce, check_finite, check_step};
use crate::error::ModelError;
use crate::motion::two_coordinate::two_coordinate;

/// How closely the moment is found at which a brake changes what it does, s. In less time a rate moves by less than rounding
/// may put it back, and the same change would be found again.
const RESOLUTION_S: f64 = 1e-14;
/// Changes within one step of the integrator after which they count as crowded.
const CROWD: u32 = 20;
/// Longest implicit step through a crowd of changes, s.
const CROWDED_STEP_S: f64 = 1e-5;
/// Most changes within one step of the integrator, implicit steps included.
const MOST_EVENTS: u32 = 1000;

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
        let currents_a = self.given_currents(currents_a, step_s);
        self.decide(tip_force)?;
        let mut left_s = step_s;
        let mut events = 0;
        while left_s > 0.0 {
            if events >= CROWD {
                let taken_s = left_s.min(CROWDED_STEP_S);
                self.push_through(tip_force, currents_a, taken_s)?;
                left_s -= taken_s;
            } else {
                let flow = Flow::new(self, tip_force, currents_a);
                let end = flow.after(&flow.start(), left_s)?;
                if !flow.ended(&end)? {
                    return self.arrive(tip_force, currents_a, end, left_s);
                }
                let (end, taken_s) = first_change(&flow, end, left_s)?;
                self.arrive(tip_force, currents_a, end, taken_s)?;
                self.decide(tip_force)?;
                left_s -= taken_s;
                self.events += 1;
            }
            events += 1;
            if events > MOST_EVENTS {
                return Err(ModelError::Events {
                    events,
                    time_s: self.time_s,
                });
            }
        }
        Ok(())
    }

    /// One implicit step through changes that crowd: the rates after it and the impulses of the brakes solve the dry friction
    /// together, so that whatever the brakes do on the way, the step has one end and gives no energy away.
    fn push_through(
        &mut self,
        tip_force: &impl TipForce,
        currents_a: [f64; 4],
        step_s: f64,
    ) -> Result<(), ModelError> {
        let tip_force_n = tip_force.force_n(self.pose.tip_m, self.tip_velocity_m_s());
        check_finite("force on the tip", "N", tip_force_n)?;
        self.feel(tip_force_n);
        let momentum = self.form.mass * Vector2::from(self.rates_rad_s);
        let drive = momentum + self.drive(tip_force_n) * step_s;
        let impulses = self.yields_nm.map(|yield_nm| yield_nm * step_s);
        let (contacts, rates) = self.contacts.after(&self.form, &drive, impulses);
        self.contacts = contacts;
        let flow = Flow::new(self, tip_force, currents_a);
        let mut end = flow.start();
        (end[0], end[1]) = (end[0] + rates.x * step_s, end[1] + rates.y * step_s);
        (end[2], end[3]) = (rates.x, rates.y);
        let exponents = flow.exponents(contacts.joint_rates(&self.form, rates), step_s);
        for (entry, exponent) in end.iter_mut().skip(4).zip(exponents) {
            *entry = exponent;
        }
        let [v_x, v_y] = self.form.tip_velocity_m_s(rates.into());
        let work_j = (tip_force_n[0] * v_x + tip_force_n[1] * v_y) * step_s;
        let before_j = self.kinetic_energy_j();
        let after_j = flow.instant(&end)?.form.kinetic_energy_j(rates.into());
        (end[8], end[9]) = (work_j, before_j + work_j - after_j);
        self.arrive(tip_force, currents_a, end, step_s)
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
        self.effects_follow(&instant.pose, [true; 4], taken_s);
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
        self.feel(tip_force_n);
        let before = self.rates_rad_s;
        let (contacts, rates) = self.contacts.decide(
            &self.form,
            Vector2::from(before),
            self.drive(tip_force_n),
            self.yields_nm,
        );
        self.contacts = contacts;
        self.go_on_with(before, rates);
        self.torques_nm = contacts
            .balance(&self.form, self.drive(tip_force_n), self.yields_nm)
            .torques_nm;
        Ok(())
    }

    /// Goes on with rates that lack what rounding left of the held joints' rates; the brakes take its energy.
    pub(super) fn go_on_with(&mut self, before: [f64; 2], rates: Vector2<f64>) {
        let rates: [f64; 2] = rates.into();
        if rates != before {
            self.dissipated_j +=
                self.form.kinetic_energy_j(before) - self.form.kinetic_energy_j(rates);
            let Parameters { arms, inertia, .. } = &self.parameters;
            self.form = two_coordinate(arms, inertia, &self.pose, rates);
        }
        self.rates_rad_s = rates;
    }

    pub(super) fn check_currents(&self, currents_a: [f64; 4]) -> Result<(), ModelError> {
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
    while after_s - before_s > RESOLUTION_S {
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

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::layout::Layout;

    fn pull([x, y]: [f64; 2], [v_x, v_y]: [f64; 2]) -> [f64; 2] {
        let (d_x, d_y) = (x - 0.017, y - 0.389);
        [
            -310.0 * d_x - 170.0 * d_y - 3.1 * v_x,
            -310.0 * d_y + 170.0 * d_x - 3.1 * v_y,
        ]
    }

    /// How far the tip of a rig that takes implicit steps alone is from one that takes none, m, after stops and starts.
    fn apart_m(step_s: f64) -> f64 {
        let start = Rig::new(Layout::FourBrake, [0.078, 0.366]).unwrap();
        let (mut exact, mut implicit) = (start.clone(), start);
        for k in 0..24_usize {
            let mut currents_a = [0.31, 0.17, 0.23, 0.29];
            currents_a[(k / 4) % 4] = 0.83;
            exact.step_under(&pull, currents_a, 0.01).unwrap();
            for _ in 0..(0.01 / step_s).round() as u32 {
                implicit.push_through(&pull, currents_a, step_s).unwrap();
                let torques = implicit.brake_torques_nm();
                for (torque, rate) in torques.iter().zip(implicit.joint_rates_rad_s()) {
                    assert!(torque * rate <= 0.0);
                }
            }
        }
        let balance_j = implicit.work_j() - implicit.kinetic_energy_j() - implicit.dissipated_j();
        assert!(balance_j.abs() < 1e-12, "{balance_j} J");
        let (one, other) = (exact.tip_m(), implicit.tip_m());
        libm::hypot(one[0] - other[0], one[1] - other[1])
    }

    #[test]
    fn implicit_steps_come_to_the_same_motion() {
        let [coarse_m, fine_m] = [1e-4, 1e-5].map(apart_m);
        assert!(coarse_m < 3e-4, "{coarse_m} m");
        assert!(fine_m < coarse_m / 7.0, "{fine_m} of {coarse_m} m");
    }
}
