//! This file says how the rig moves while its brakes hold and slip as they do: a fourth-order Runge-Kutta step.
#![expect(
    clippy::indexing_slicing,
    reason = "indices run over the four joints and the ten entries of a state"
)]

use nalgebra::{SVector, Vector2};

use super::{Rig, TipForce};
use crate::brake::{Brake, Course};
use crate::error::ModelError;
use crate::linkage::{Pose, forward};
use crate::motion::two_coordinate::{TwoCoordinate, two_coordinate};

use super::contact::{Balance, Contact};

/// Part of a holding brake's bound by which the load may exceed it before it lets go: above what rounding leaves.
const RELEASE: f64 = 1e-10;

/// θA, θB (rad), their rates (rad/s), the time constants run since the step began by the brakes A, E, B, C, the work of
/// the tip force (J) and what the brakes took (J).
pub type State = SVector<f64, 10>;

/// One stretch of motion in which no brake changes what it does.
pub struct Flow<'a, F: TipForce> {
    rig: &'a Rig,
    force: &'a F,
    currents_a: [f64; 4],
    courses: [Option<Course>; 4],
}

/// Everything at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    pub pose: Pose,
    pub form: TwoCoordinate,
    pub balance: Balance,
    pub joint_rates_rad_s: [f64; 4],
    pub tip_force_n: [f64; 2],
    pub yields_nm: [f64; 4],
    /// What the left-out physics does to θA and θB, N·m.
    pub left_out: Vector2<f64>,
}

impl<'a, F: TipForce> Flow<'a, F> {
    /// The stretch that begins now.
    pub fn new(rig: &'a Rig, force: &'a F, currents_a: [f64; 4]) -> Flow<'a, F> {
        let rates = rig.joint_rates_rad_s();
        let courses = [0, 1, 2, 3].map(|i| {
            rig.brakes[i]
                .as_ref()
                .map(|brake| brake.course(currents_a[i], rates[i]))
        });
        Flow {
            rig,
            force,
            currents_a,
            courses,
        }
    }

    /// The state at the beginning.
    pub fn start(&self) -> State {
        let [theta_a, theta_b] = self.rig.theta_rad;
        let [rate_a, rate_b] = self.rig.rates_rad_s;
        State::from([
            theta_a, theta_b, rate_a, rate_b, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        ])
    }

    /// The state after `h` seconds, by the classical Runge-Kutta formula.
    pub fn after(&self, y: &State, h: f64) -> Result<State, ModelError> {
        let k_1 = self.rate(y)?;
        let k_2 = self.rate(&(y + k_1 * (h / 2.0)))?;
        let k_3 = self.rate(&(y + k_2 * (h / 2.0)))?;
        let k_4 = self.rate(&(y + k_3 * h))?;
        Ok(y + (k_1 + k_2 * 2.0 + k_3 * 2.0 + k_4) * (h / 6.0))
    }

    /// Everything at a state of this stretch.
    pub fn instant(&self, y: &State) -> Result<Instant, ModelError> {
        let parameters = &self.rig.parameters;
        let pose = forward::pose(&parameters.arms, y[0], y[1])?;
        let rates = [y[2], y[3]];
        let form = two_coordinate(&parameters.arms, &parameters.inertia, &pose, rates);
        let tip_force_n = self.force.force_n(pose.tip_m, form.tip_velocity_m_s(rates));
        let own_nm = [0, 1, 2, 3].map(|i| match (&self.rig.brakes[i], &self.courses[i]) {
            (Some(brake), Some(course)) => brake.yield_along(course, y[4 + i]),
            _ => 0.0,
        });
        let contacts = &self.rig.contacts;
        let joint_rates_rad_s = contacts.joint_rates(&form, Vector2::from(rates));
        let mut drive = form.drive(tip_force_n);
        let (mut yields_nm, mut left_out) = (own_nm, Vector2::zeros());
        if let Some(effects) = &self.rig.effects {
            let now = self
                .rig
                .situation(&pose, &form, joint_rates_rad_s, own_nm, tip_force_n);
            let done = effects.at(&now);
            (yields_nm, left_out) = (done.yields_nm, done.drive);
            drive += left_out;
        }
        Ok(Instant {
            pose,
            form,
            balance: contacts.balance(&form, drive, yields_nm),
            joint_rates_rad_s,
            tip_force_n,
            yields_nm,
            left_out,
        })
    }

    /// The time constants that the brakes run in `step_s` at some rates of the joints.
    pub fn exponents(&self, joint_rates_rad_s: [f64; 4], step_s: f64) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| match &self.courses[i] {
            Some(course) => course.rate_per_s(joint_rates_rad_s[i]) * step_s,
            None => 0.0,
        })
    }

    fn rate(&self, y: &State) -> Result<State, ModelError> {
        let instant = self.instant(y)?;
        let omega = instant.form.joint_rates_rad_s([y[2], y[3]]);
        let [v_x, v_y] = instant.form.tip_velocity_m_s([y[2], y[3]]);
        let [f_x, f_y] = instant.tip_force_n;
        let acceleration = instant.balance.acceleration;
        let mut rate = State::zeros();
        (rate[0], rate[1]) = (y[2], y[3]);
        (rate[2], rate[3]) = (acceleration.x, acceleration.y);
        for i in 0..4 {
            if let Some(course) = &self.courses[i] {
                rate[4 + i] = course.rate_per_s(instant.joint_rates_rad_s[i]);
            }
            rate[9] -= instant.balance.torques_nm[i] * omega[i];
        }
        if self.rig.effects.is_some() {
            rate[9] -= instant.left_out.dot(&Vector2::new(y[2], y[3]));
        }
        rate[8] = f_x * v_x + f_y * v_y;
        Ok(rate)
    }

    /// Whether some brake has changed what it does by the time of a state: a slipping joint turned back, a held one is
    /// asked for more than its brake has, a brake is on another course.
    pub fn ended(&self, y: &State) -> Result<bool, ModelError> {
        let instant = self.instant(y)?;
        let omega = instant.form.joint_rates_rad_s([y[2], y[3]]);
        let turned = |i: usize| matches!(self.rig.contacts.of()[i], Contact::Slips(sign) if sign * omega[i] < 0.0);
        if (0..4).any(turned) || instant.balance.share > 1.0 + RELEASE {
            return Ok(true);
        }
        let brakes = self.brakes_at(y, &instant.pose);
        Ok((0..4).any(|i| match (&brakes[i], &self.courses[i]) {
            (Some(brake), Some(course)) => {
                brake.course(self.currents_a[i], instant.joint_rates_rad_s[i]) != *course
            }
            _ => false,
        }))
    }

    /// The brakes at a state.
    pub fn brakes_at(&self, y: &State, pose: &Pose) -> [Option<Brake>; 4] {
        let angles = super::joint_angles_rad(pose);
        [0, 1, 2, 3].map(|i| {
            let (mut brake, course) = (self.rig.brakes[i]?, self.courses[i]?);
            brake.follow(&course, y[4 + i], angles[i]);
            Some(brake)
        })
    }
}
