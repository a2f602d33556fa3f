//! This file says what a controller of an axis is: it is told where the axis is and where it is to be, and answers with an effort.

use crate::controller::Failure;

/// What is fixed about a trial. Travel in m (N, kg) or rad (N·m, kg·m²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Whether the axis turns; it slides otherwise.
    pub is_rotary: bool,
    /// Time from one tick to the next, s.
    pub sample_s: f64,
    /// Mass, kg, or moment of inertia, kg·m², as it was found.
    pub inertia: f64,
    /// Greatest magnitude of an effort, N or N·m.
    pub greatest_effort: f64,
    /// Resolution of the sensed position, m or rad; 0 where it is not known.
    pub position_quantum: f64,
}

impl Settings {
    /// Its numbers, in the order in which they are told.
    pub const fn numbers(&self) -> [f64; 4] {
        [
            self.sample_s,
            self.inertia,
            self.greatest_effort,
            self.position_quantum,
        ]
    }

    /// Of its numbers.
    pub const fn of(is_rotary: bool, numbers: [f64; 4]) -> Settings {
        let [sample_s, inertia, greatest_effort, position_quantum] = numbers;
        Settings {
            is_rotary,
            sample_s,
            inertia,
            greatest_effort,
            position_quantum,
        }
    }
}

/// What a tick is told. Positions in m or rad, velocities in m/s or rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Number of the sample, from 0.
    pub number: u32,
    /// Where the axis is, as its encoder shows it.
    pub position: f64,
    /// How fast it moves: the change of that position over a few samples.
    pub velocity: f64,
    /// The effort that the drive gave at the end of the sample before, N or N·m.
    pub effort: f64,
    /// Where it is to be.
    pub target_position: f64,
    /// How fast it is to move.
    pub target_velocity: f64,
}

impl Sensed {
    /// Its numbers, in the order in which they are told.
    pub const fn numbers(&self) -> [f64; 5] {
        [
            self.position,
            self.velocity,
            self.effort,
            self.target_position,
            self.target_velocity,
        ]
    }

    /// Of its numbers.
    pub const fn of(number: u32, numbers: [f64; 5]) -> Sensed {
        let [position, velocity, effort, target_position, target_velocity] = numbers;
        Sensed {
            number,
            position,
            velocity,
            effort,
            target_position,
            target_velocity,
        }
    }
}

/// A controller at work in one trial.
pub trait Controller {
    /// The effort of one tick, N or N·m; nothing about it is promised.
    ///
    /// # Errors
    /// [`Failure`]: the controller did not answer. It is not asked again in this trial.
    fn tick(&mut self, sensed: &Sensed) -> Result<f64, Failure>;

    /// The trial is over; after a tick that failed it is not called.
    ///
    /// # Errors
    /// [`Failure`]: it broke in what it does at the end, or left something running.
    fn end(&mut self) -> Result<(), Failure> {
        Ok(())
    }
}

/// Where a trial is begun, for sources whose controllers live in processes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Anywhere.
    Any,
    /// Where the last trial on this thread was.
    Same,
    /// Where no trial was: with another number, at another time, elsewhere in memory.
    New,
}

/// What makes controllers: one for every trial, on any thread.
pub trait Source: Sync {
    /// A controller that has seen nothing.
    ///
    /// # Errors
    /// [`Failure`]: it could not be begun.
    fn begin(&self, settings: &Settings, place: Place)
    -> Result<Box<dyn Controller + '_>, Failure>;
}

impl<F> Source for F
where
    F: Fn(&Settings) -> Box<dyn Controller> + Sync,
{
    fn begin(&self, settings: &Settings, _: Place) -> Result<Box<dyn Controller + '_>, Failure> {
        Ok(self(settings))
    }
}
