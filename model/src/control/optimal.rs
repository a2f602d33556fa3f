//! This file says which braking force costs least in direction and energy: Swanson's optimal control (§2.2.2).

use nalgebra::{Matrix2, Vector2};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;
use rigproof_spec::settings::{BOUNDARY_RANGE_M, HORIZON_RANGE_S, WEIGHT_RANGE};

use super::desired_velocity::desired_velocity;
use super::force_angle::opposing_force;
use super::path::Path;
use super::{Actuation, Controller, Sensed, setting};
use crate::error::ModelError;
use crate::linkage::Pose;
use crate::motion::two_coordinate::two_coordinate;
use crate::rig::Parameters;

/// Levels of force that are tried on each brake, besides none.
const LEVELS: u32 = 20;

/// What the optimal controller weighs, and how far it looks ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Cost of the squared angle between velocity and desired velocity, 1/rad².
    pub angle: f64,
    /// Cost of the squared change of kinetic energy as a share of the kinetic energy.
    pub energy: f64,
    /// How long a force is imagined to act, s.
    pub horizon_s: f64,
}

/// Optimal control (§2.2.2; decision 0043): "seeks to minimize a cost function based on the angle between desired and
/// actual velocity and the change in kinetic energy".
///
/// Each brake is tried with twenty levels up to the greatest desired force, and none; the velocity after the horizon
/// follows from the mass matrix at the tip, which `inertia` gives in kg for a pose, 2×2, rows and columns x, y. A brake
/// never turns its joint round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimal<P, M> {
    actuation: Actuation,
    path: P,
    boundary_m: f64,
    weights: Weights,
    inertia: M,
}

impl<P: Path, M: Fn(&Pose) -> Option<Matrix2<f64>>> Optimal<P, M> {
    /// The controller on a path.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: the boundary is not between 10⁻⁷ m and 0.61 m, a weight is not between 0 and 10⁶, or
    /// the horizon not between 10⁻⁶ s and 1 s.
    pub fn new(
        actuation: Actuation,
        path: P,
        boundary_m: f64,
        weights: Weights,
        inertia: M,
    ) -> Result<Optimal<P, M>, ModelError> {
        let boundary_m = setting(
            "the boundary of the velocity field",
            boundary_m,
            BOUNDARY_RANGE_M,
            "m",
        )?;
        setting(
            "the weight of the angle",
            weights.angle,
            WEIGHT_RANGE,
            "1/rad²",
        )?;
        setting(
            "the weight of the energy",
            weights.energy,
            WEIGHT_RANGE,
            "1",
        )?;
        setting("the horizon", weights.horizon_s, HORIZON_RANGE_S, "s")?;
        Ok(Optimal {
            actuation,
            path,
            boundary_m,
            weights,
            inertia,
        })
    }

    fn cost(
        &self,
        mass: &Matrix2<f64>,
        before: Vector2<f64>,
        after: Vector2<f64>,
        desired: Vector2<f64>,
    ) -> f64 {
        let angle_rad = libm::atan2(desired.perp(&after), desired.dot(&after));
        let energy = |velocity: Vector2<f64>| 0.5 * velocity.dot(&(mass * velocity));
        let change = (energy(after) - energy(before)) / energy(before);
        self.weights.angle * angle_rad * angle_rad + self.weights.energy * change * change
    }
}

impl<P: Path, M: Fn(&Pose) -> Option<Matrix2<f64>>> Controller for Optimal<P, M> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let (rows, nearest) = match self.actuation.situation(&self.path, sensed) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let Some((mass, mobility)) =
            (self.inertia)(&sensed.pose).and_then(|mass| Some((mass, mass.try_inverse()?)))
        else {
            return Command::none(Reason::SingularPose);
        };
        let velocity = sensed.decisive_velocity_m_s();
        if velocity == Vector2::zeros() {
            return Command::none(Reason::NothingToDo);
        }
        let push_n = Vector2::from(sensed.tip_force_n);
        let desired = desired_velocity(&nearest, push_n, self.boundary_m).direction;
        let pushed = velocity + mobility * push_n * self.weights.horizon_s;
        let mut lowest = self.cost(&mass, velocity, pushed, desired);
        let mut best: Option<(Joint, Vector2<f64>, f64)> = None;
        for (joint, row) in &rows {
            let Some(against) = opposing_force(*row, velocity) else {
                continue;
            };
            let brake = against / libm::hypot(row.x, row.y);
            let slowed = mobility * brake * self.weights.horizon_s;
            let stop_n = -row.dot(&pushed) / row.dot(&slowed);
            if stop_n.is_nan() || row.dot(&pushed) * row.dot(&velocity) <= 0.0 {
                continue;
            }
            for level in 1..=LEVELS {
                let share = f64::from(level) / f64::from(LEVELS);
                let force_n = (share * self.actuation.greatest_force_n()).min(stop_n);
                let cost = self.cost(&mass, velocity, pushed + slowed * force_n, desired);
                if cost < lowest {
                    lowest = cost;
                    best = Some((*joint, *row, force_n));
                }
            }
        }
        match best {
            Some((joint, row, force_n)) => {
                let current_a = self.actuation.current_for_force(joint, row, force_n);
                Actuation::one(joint, current_a)
            }
            None => Command::none(Reason::NoneHelps),
        }
    }
}

/// The mass matrix of a rig as its tip feels it, kg, 2×2, rows and columns x, y: the kinetic energy is half of v·M·v.
///
/// `None` at a singularity.
pub fn tip_mass(parameters: &Parameters, pose: &Pose) -> Option<Matrix2<f64>> {
    crate::linkage::singularity::check(pose).ok()?;
    let Parameters { arms, inertia, .. } = parameters;
    let form = two_coordinate(arms, inertia, pose, [0.0; 2]);
    let rates_from_tip = form.tip.try_inverse()?;
    Some(rates_from_tip.transpose() * form.mass * rates_from_tip)
}
