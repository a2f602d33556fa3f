//! This file runs the fixed-step implementation: its equations of motion alone, and its plant.

use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Outcome, Parameters, Plant, Scheme};

use crate::case::{Case, SETTLING_S};
use crate::engine::{Engine, Sample};

/// The linkage without brakes.
#[derive(Clone)]
pub struct Free {
    mechanism: Mechanism<f64>,
    motion: Motion<f64>,
    /// Steps a tick.
    steps: u32,
    step_s: f64,
}

impl Free {
    /// At the start of a case, with so many steps a tick.
    pub fn new(case: &Case, scheme: Scheme, steps: u32) -> Free {
        let Parameters { arms, inertia, .. } = Parameters::of(case.layout);
        let mechanism = Mechanism::new(&arms, &inertia, scheme);
        let start = case.start();
        let theta_rad = [start.theta_a_rad, start.theta_b_rad].into();
        let motion = Motion::new(&mechanism, theta_rad, [0.0; 2].into()).unwrap();
        Free {
            mechanism,
            motion,
            steps,
            step_s: case.tick_s() / f64::from(steps),
        }
    }
}

impl Engine for Free {
    fn tick(&mut self, force_n: [f64; 2]) {
        for _ in 0..self.steps {
            let outcome = self
                .motion
                .step_free(&self.mechanism, force_n.into(), self.step_s);
            assert_eq!(outcome, Outcome::Moved);
        }
    }

    fn sample(&self) -> Sample {
        Sample {
            base_rad: self.motion.theta_rad.into(),
            rates_rad_s: self.motion.rates_rad_s.into(),
            tip_m: self.motion.linkage.tip_m.into(),
        }
    }
}

/// The plant with its brakes, the currents as the case says.
#[derive(Clone)]
pub struct Braked {
    plant: Plant,
    currents_a: [f64; 4],
    /// Steps a tick.
    steps: u32,
    step_s: f64,
}

impl Braked {
    /// At the start of a case, its yield torques settled, with so many steps a tick.
    pub fn new(case: &Case, scheme: Scheme, steps: u32) -> Braked {
        let parameters = Parameters {
            scheme,
            ..Parameters::of(case.layout)
        };
        let start = case.start();
        let theta_rad = [start.theta_a_rad, start.theta_b_rad];
        let plant = Plant::new(&parameters, theta_rad, [0.0; 2], &[]).unwrap();
        let mut braked = Braked {
            plant,
            currents_a: case.currents_a(),
            steps,
            step_s: case.tick_s() / f64::from(steps),
        };
        for _ in 0..libm::round(SETTLING_S / case.tick_s()) as usize {
            braked.tick([0.0; 2]);
        }
        braked
    }
}

impl Engine for Braked {
    fn tick(&mut self, force_n: [f64; 2]) {
        for _ in 0..self.steps {
            let outcome = self.plant.step(force_n, self.currents_a, self.step_s);
            assert_eq!(outcome, Outcome::Moved);
        }
    }

    fn sample(&self) -> Sample {
        Sample {
            base_rad: self.plant.base_angles_rad(),
            rates_rad_s: self.plant.base_rates_rad_s(),
            tip_m: self.plant.tip_m().into(),
        }
    }
}
