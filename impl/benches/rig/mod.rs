//! This file is the rig that is timed and counted: a controller, a plant with its brakes, and a hand that follows a line badly.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::command::Command;
use rigproof_impl::encoder::COUNTS_PER_TURN;
use rigproof_impl::law::Proportional;
use rigproof_impl::path::Line;
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, SAMPLE_STEP_S};

/// Ticks of a run: 10 s at 1 kHz.
pub const TICKS: usize = 10_000;
/// Where the line runs that is to be followed, m.
const LINE_M: [[f64; 2]; 2] = [[-0.117, 0.371], [0.113, 0.397]];
/// The gain of (6.13), N·s/m: the low gain of table 6.1 in the unit that is meant (erratum `gain-unit`).
const GAIN_N_S_PER_M: f64 = 500.0;
/// Stiffness that draws the hand along, N/m.
const PULL_N_PER_M: f64 = 173.0;

/// The controller that is timed.
pub type Controller = Tick<f64, Proportional<f64, Line<f64>>>;

/// Four brakes, proportional control, stick-slip and backlash, a hand.
#[derive(Clone)]
pub struct ClosedLoop {
    pub controller: Controller,
    pub plant: Plant,
    number: u32,
}

/// What the hand wants in every tick: a place, m, computed beforehand so that no sine is timed.
pub fn hand() -> Vec<Vector<f64>> {
    let place = |tick: usize| {
        let t = tick as f64 * SAMPLE_STEP_S;
        let along = 0.107 * libm::sin(1.7 * t) + 0.013 * libm::sin(11.3 * t);
        let beside = 0.061 * libm::sin(2.9 * t + 0.7) + 0.011 * libm::sin(17.9 * t);
        Vector::new(along, 0.383 + beside)
    };
    (0..TICKS).map(place).collect()
}

impl ClosedLoop {
    /// At rest on the 4-brake layout.
    pub fn new() -> ClosedLoop {
        let layout = Layout::FourBrake;
        let [from_m, to_m] = LINE_M;
        let line = Line::through(from_m, to_m).unwrap();
        let law = Proportional::new(
            Actuation::thesis(layout),
            line,
            BLEND_BOUNDARY_M,
            GAIN_N_S_PER_M,
        );
        let start_rad = [1.963, 0.892];
        ClosedLoop {
            controller: Tick::new(&Settings::thesis(layout), law.unwrap()).unwrap(),
            plant: Plant::new(&Parameters::of(layout), start_rad, [0.0; 2], &[]).unwrap(),
            number: 0,
        }
    }

    /// What the controller is told now, with the hand drawn to a place.
    pub fn sensed(&self, hand_m: Vector<f64>) -> Sensed<f64> {
        let per_rad = f64::from(COUNTS_PER_TURN) / core::f64::consts::TAU;
        Sensed {
            number: self.number,
            counts: self
                .plant
                .base_angles_rad()
                .map(|angle| (angle * per_rad) as i32),
            tip_force_n: (hand_m - self.plant.tip_m()) * PULL_N_PER_M,
        }
    }

    /// One tick of the controller and one step of the plant.
    pub fn step(&mut self, hand_m: Vector<f64>) -> (Sensed<f64>, Command<f64>) {
        let sensed = self.sensed(hand_m);
        let command = self.controller.tick(&sensed);
        let outcome = self
            .plant
            .step(sensed.tip_force_n.into(), command.currents_a, SAMPLE_STEP_S);
        assert_eq!(outcome, Outcome::Moved);
        self.number = self.number.wrapping_add(1);
        (sensed, command)
    }
}

/// What every tick of a run was told and answered.
pub fn record() -> Vec<(Sensed<f64>, Command<f64>)> {
    let mut rig = ClosedLoop::new();
    hand().into_iter().map(|place| rig.step(place)).collect()
}
