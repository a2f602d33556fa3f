//! The other passive displays of chapter 2: each is a body and the rows that resist it, and a hand moves them all.

mod choice;
mod clutch;
mod local_paths;
mod osaka;
mod padyc;
mod plant;
mod pter;
mod run;
mod scooter;

pub use clutch::Clutch;
pub use local_paths::with_local_paths;
pub use osaka::Osaka;
pub use padyc::Padyc;
pub use plant::{Body, Place, Plant, Resisted, Rows};
pub use pter::Pter;
pub use run::{Display, Run, run};
pub use scooter::Scooter;

use crate::control::Side;
use crate::control::path::{Line, Path};

/// What a display is to do.
#[derive(Clone, Copy, Debug)]
pub enum Aim<'a> {
    /// Nothing: the hand is to feel no display.
    Free,
    /// Keep the tip out of the solid side of a boundary.
    Wall(&'a Line, Side),
    /// Lead the tip along a path.
    Path(&'a dyn Path),
    /// Help the tip to a point, x and y, m, and no further.
    Point([f64; 2]),
}

/// What a display's control is told at a tick.
#[derive(Clone, Copy, Debug)]
pub struct Now<'a> {
    /// Where it is.
    pub place: &'a Place,
    /// The rates of its two coordinates.
    pub rates: [f64; 2],
    /// The tip's velocity, x and y, m/s.
    pub tip_velocity_m_s: [f64; 2],
    /// The hand's force on the tip, x and y, N.
    pub tip_force_n: [f64; 2],
}

/// What makes a body a display: a control that decides at every tick, and rows that resist in every step.
pub trait Device: core::fmt::Debug {
    /// Decides what to ask of the actuators until the next tick.
    fn decide(&mut self, aim: &Aim<'_>, now: &Now<'_>);

    /// Lets a step pass in the actuators and says what resists in it.
    fn rows(&mut self, place: &Place, rates: [f64; 2], step_s: f64) -> Rows;
}
