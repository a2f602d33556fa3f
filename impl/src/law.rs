//! This file is what a control law is told and what it answers.

mod any;
mod desired_velocity;
mod impedance;
mod obstacle;
mod optimal;
mod proportional;
mod sdof;
mod uncontrolled;
mod velocity_ratio;

pub use any::{AnyLaw, PathLaw};
pub use desired_velocity::Field;
pub use impedance::{Impedance, Virtual};
pub use obstacle::{Obstacle, Side};
pub use optimal::{Optimal, Weights};
pub use proportional::Proportional;
pub use sdof::Sdof;
pub use uncontrolled::Uncontrolled;
pub use velocity_ratio::VelocityRatio;

use rigproof_spec::methods::STANDING_TIP_M_S;

use crate::actuation::Actuation;
use crate::command::Command;
use crate::linkage::Linkage;
use crate::number::Real;
use crate::vector::Vector;

/// What a control law knows in one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation<R> {
    /// Where the arms are.
    pub linkage: Linkage<R>,
    /// The rows of the Jacobian, 1/m, A, E, B, C.
    pub rows: [Vector<R>; 4],
    /// Velocity of the tip, m/s.
    pub tip_velocity_m_s: Vector<R>,
    /// Force of the operator on the tip, N.
    pub tip_force_n: Vector<R>,
}

impl<R: Real> Situation<R> {
    /// The velocity of the tip that a law decides by, m/s: exactly zero where the tip is slower than [`STANDING_TIP_M_S`] (gap
    /// `tip-at-rest`), so that no square that vanishes decides.
    #[inline]
    pub fn decisive_velocity_m_s(&self) -> Vector<R> {
        let velocity_m_s = self.tip_velocity_m_s;
        if velocity_m_s.norm_squared() < R::of(STANDING_TIP_M_S * STANDING_TIP_M_S) {
            Vector::zero()
        } else {
            velocity_m_s
        }
    }
}

/// A control law: one command a tick, whatever it is told, in bounded work.
pub trait Law<R> {
    /// What to ask of the brakes now.
    fn command(&mut self, now: &Situation<R>) -> Command<R>;

    /// The arms and brakes that it is made for; `None` for a law of any rig. A tick takes no law of another rig than its own.
    fn actuation(&self) -> Option<&Actuation<R>>;
}
