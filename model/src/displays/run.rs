//! This file joins a body and a device to a display, and runs it in a hand.

use rigproof_spec::methods::SAMPLE_STEP_S;

use super::{Aim, Device, Now, Plant};
use crate::error::ModelError;
use crate::operator::Hand;

/// Longest step in which body and rows are solved together, s (decision 0240).
pub const STEP_S: f64 = 1e-4;

/// A body with the device that resists it.
#[derive(Debug)]
pub struct Display {
    plant: Plant,
    device: Box<dyn Device>,
    step_s: f64,
}

impl Display {
    /// A device on a body.
    pub fn new(plant: Plant, device: impl Device + 'static) -> Display {
        Display {
            plant,
            device: Box::new(device),
            step_s: STEP_S,
        }
    }

    /// The same display with another step, s, for studies of convergence.
    #[must_use]
    pub fn with_step_s(self, step_s: f64) -> Display {
        Display { step_s, ..self }
    }

    /// The body.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// One tick: the device decides, then body and rows move under a constant force, N; `seen` is called after every step.
    ///
    /// # Errors
    /// Those of [`Plant::advance`].
    pub fn tick(
        &mut self,
        aim: &Aim<'_>,
        tip_force_n: [f64; 2],
        tick_s: f64,
        mut seen: impl FnMut(&Plant),
    ) -> Result<(), ModelError> {
        let now = Now {
            place: self.plant.place(),
            rates: self.plant.rates(),
            tip_velocity_m_s: self.plant.tip_velocity_m_s(),
            tip_force_n,
        };
        self.device.decide(aim, &now);
        let steps = (tick_s / self.step_s * (1.0 - 1e-9)).ceil().max(1.0);
        for _ in 0..steps as u64 {
            let step_s = tick_s / steps;
            let (place, rates) = (self.plant.place(), self.plant.rates());
            let rows = self.device.rows(place, rates, step_s);
            self.plant.advance(tip_force_n, &rows, step_s)?;
            seen(&self.plant);
        }
        Ok(())
    }
}

/// What happened in a run, a sample a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// The tip at the start of the tick, x and y, m.
    pub tips_m: Vec<[f64; 2]>,
    /// The hand's force over it, x and y, N.
    pub forces_n: Vec<[f64; 2]>,
    /// Work of the hand over the whole run, J.
    pub work_j: f64,
    /// What the display took of it, J.
    pub dissipated_j: f64,
    /// Whether the end was reached in time.
    pub arrived: bool,
}

/// Runs a display in a hand, at 1000 Hz, until `ended` or for `longest_s`.
///
/// # Errors
/// Those of [`Display::tick`].
pub fn run(
    display: &mut Display,
    aim: &Aim<'_>,
    hand: &mut dyn Hand,
    longest_s: f64,
    ended: impl Fn([f64; 2]) -> bool,
) -> Result<Run, ModelError> {
    let mut run = Run::default();
    for _ in 0..libm::round(longest_s / SAMPLE_STEP_S) as u64 {
        let tip_m = display.plant.place().tip_m;
        if ended(tip_m) {
            run.arrived = true;
            break;
        }
        let velocity = display.plant.tip_velocity_m_s();
        let tip_force_n = hand.push(tip_m, velocity, SAMPLE_STEP_S);
        run.tips_m.push(tip_m);
        run.forces_n.push(tip_force_n);
        display.tick(aim, tip_force_n, SAMPLE_STEP_S, |_| {})?;
    }
    run.work_j = display.plant.work_j();
    run.dissipated_j = display.plant.dissipated_j();
    Ok(run)
}
