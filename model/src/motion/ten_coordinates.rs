//! This file moves the linkage in ten coordinates with nothing that holds its constraints: what the thesis integrates.

use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use super::acceleration::{Equations, equations};
use super::constraints::{constraint_matrix, constraints};
use super::coordinates::{Ten, coordinates, rates};
use super::two_coordinate::two_coordinate;
use crate::error::ModelError;
use crate::linkage::Pose;

/// A linkage whose ten coordinates are integrated each for itself (§5.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TenCoordinates {
    arms: Arms,
    inertia: Inertia,
    /// q in the order of (5.42), m and rad.
    pub q: Ten,
    /// q̇, m/s and rad/s.
    pub q_dot: Ten,
}

impl TenCoordinates {
    /// The linkage at a pose, with θA and θB turning at their rates, rad/s.
    pub fn new(
        arms: &Arms,
        inertia: &Inertia,
        pose: &Pose,
        rates_rad_s: [f64; 2],
    ) -> TenCoordinates {
        let form = two_coordinate(arms, inertia, pose, rates_rad_s);
        TenCoordinates {
            arms: *arms,
            inertia: *inertia,
            q: coordinates(arms, inertia, pose),
            q_dot: rates(&form, rates_rad_s),
        }
    }

    /// The equations of motion now (5.66).
    pub fn equations(&self) -> Equations {
        equations(&self.arms, &self.inertia, &self.q, &self.q_dot)
    }

    /// Advances by the simplest rule that the text of §5.3 allows: the new rates from the last acceleration, the new
    /// coordinates from the new rates.
    ///
    /// # Errors
    /// [`ModelError::NoAcceleration`].
    pub fn step_euler(&mut self, forces: &Ten, step_s: f64) -> Result<(), ModelError> {
        let q_ddot = self.equations().acceleration(forces)?.q_ddot;
        self.q_dot += q_ddot * step_s;
        self.q += self.q_dot * step_s;
        Ok(())
    }

    /// Advances by a classical Runge-Kutta step under forces Q that depend on q and q̇.
    ///
    /// # Errors
    /// [`ModelError::NoAcceleration`].
    pub fn step_runge_kutta(
        &mut self,
        forces: impl Fn(&Ten, &Ten) -> Ten,
        step_s: f64,
    ) -> Result<(), ModelError> {
        let accelerated = |q: &Ten, q_dot: &Ten| {
            equations(&self.arms, &self.inertia, q, q_dot)
                .acceleration(&forces(q, q_dot))
                .map(|acceleration| acceleration.q_ddot)
        };
        let (q, v_1) = (self.q, self.q_dot);
        let a_1 = accelerated(&q, &v_1)?;
        let v_2 = v_1 + a_1 * (step_s / 2.0);
        let a_2 = accelerated(&(q + v_1 * (step_s / 2.0)), &v_2)?;
        let v_3 = v_1 + a_2 * (step_s / 2.0);
        let a_3 = accelerated(&(q + v_2 * (step_s / 2.0)), &v_3)?;
        let v_4 = v_1 + a_3 * step_s;
        let a_4 = accelerated(&(q + v_3 * step_s), &v_4)?;
        self.q += (v_1 + v_2 * 2.0 + v_3 * 2.0 + v_4) * (step_s / 6.0);
        self.q_dot += (a_1 + a_2 * 2.0 + a_3 * 2.0 + a_4) * (step_s / 6.0);
        Ok(())
    }

    /// How far the linkage has come apart: the greatest of |C₁| … |C₈|, m.
    pub fn drift_m(&self) -> f64 {
        constraints(&self.arms, &self.inertia, &self.q).amax()
    }

    /// How fast it is coming apart: the greatest of |A·q̇|, m/s.
    pub fn drift_rate_m_s(&self) -> f64 {
        (constraint_matrix(&self.arms, &self.inertia, &self.q) * self.q_dot).amax()
    }
}
