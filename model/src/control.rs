//! The controllers of thesis chapter 6 and of those it compares itself with: from what is sensed to four brake currents.

mod actuation;
pub mod desired_velocity;
pub mod force_angle;
pub mod force_limit;
mod impedance;
mod method;
mod obstacle;
mod optimal;
pub mod path;
mod proportional;
mod sdof;
pub mod torque_translation;
mod velocity_ratio;

pub use actuation::Actuation;
pub use impedance::{Impedance, Virtual};
pub use method::{GainUnit, Uncontrolled, controller};
use nalgebra::Vector2;
pub use obstacle::{Obstacle, Side};
pub use optimal::{Optimal, Weights, tip_mass};
pub use proportional::{Proportional, influence};
use rigproof_spec::command::Command;
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::STANDING_TIP_M_S;
pub use rigproof_spec::settings::{GREATEST_DISTANCE_M, SHORTEST_PIECE_M};

pub use sdof::Sdof;
pub use velocity_ratio::VelocityRatio;
pub(crate) use velocity_ratio::excess_speeds;

use crate::error::ModelError;
use crate::linkage::Pose;

/// A joint with its row of the Jacobian, 1/m: the force at the tip of 1 N·m on it, N.
pub type JointRow = (Joint, Vector2<f64>);

/// What a controller is told in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Where the linkage is.
    pub pose: Pose,
    /// Velocity of the tip, x and y, m/s.
    pub tip_velocity_m_s: [f64; 2],
    /// Speeds of joints A, E, B and C, rad/s.
    pub omega_rad_s: [f64; 4],
    /// Force of the operator on the tip, x and y, N.
    pub tip_force_n: [f64; 2],
}

impl Sensed {
    /// Every number a controller is told.
    pub fn inputs(&self) -> [f64; 15] {
        let pose = &self.pose;
        let [tip_x, tip_y] = pose.tip_m;
        let [velocity_x, velocity_y] = self.tip_velocity_m_s;
        let [omega_a, omega_e, omega_b, omega_c] = self.omega_rad_s;
        let [force_x, force_y] = self.tip_force_n;
        [
            pose.theta_a_rad,
            pose.theta_e_rad,
            pose.theta_b_rad,
            pose.theta_c_rad,
            pose.theta_d_rad,
            tip_x,
            tip_y,
            velocity_x,
            velocity_y,
            omega_a,
            omega_e,
            omega_b,
            omega_c,
            force_x,
            force_y,
        ]
    }

    /// The velocity of the tip that a controller decides by, m/s: exactly zero where the tip is slower than [`STANDING_TIP_M_S`] (gap
    /// `tip-at-rest`).
    pub fn decisive_velocity_m_s(&self) -> Vector2<f64> {
        let [x, y] = self.tip_velocity_m_s;
        if libm::hypot(x, y) < STANDING_TIP_M_S {
            Vector2::zeros()
        } else {
            Vector2::new(x, y)
        }
    }

    /// Whether every number is finite.
    pub fn is_defined(&self) -> bool {
        self.inputs().iter().all(|input| input.is_finite())
    }
}

/// A control law: one command a tick, whatever it is told.
pub trait Controller {
    /// What to ask of the brakes now.
    fn command(&mut self, sensed: &Sensed) -> Command;
}

impl<T: Controller + ?Sized> Controller for Box<T> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        (**self).command(sensed)
    }
}

/// Checks one setting of a controller.
fn setting(
    setting: &'static str,
    value: f64,
    [least, greatest]: [f64; 2],
    unit: &'static str,
) -> Result<f64, ModelError> {
    if (least..=greatest).contains(&value) {
        Ok(value)
    } else {
        Err(ModelError::SettingRange {
            setting,
            value,
            least,
            greatest,
            unit,
        })
    }
}
