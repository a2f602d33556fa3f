//! This file runs the reference: the rig with its brakes, or its equations of motion alone where nothing resists.

use rigproof_model::linkage::forward;
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::rig::{Parameters, Rig};

use crate::case::{Case, SETTLING_S};
use crate::engine::{Engine, Sample};

/// Equation (5.40) without brakes, by the classical Runge-Kutta formula.
#[derive(Clone)]
pub struct Free {
    parameters: Parameters,
    /// θA, θB, rad, and their rates, rad/s.
    state: [f64; 4],
    /// Steps a tick.
    steps: u32,
    step_s: f64,
}

impl Free {
    /// At the start of a case, with so many steps a tick.
    pub fn new(case: &Case, steps: u32) -> Free {
        let start = case.start();
        Free {
            parameters: Parameters::of(case.layout),
            state: [start.theta_a_rad, start.theta_b_rad, 0.0, 0.0],
            steps,
            step_s: case.tick_s() / f64::from(steps),
        }
    }

    fn rate(&self, [a, b, rate_a, rate_b]: [f64; 4], force_n: [f64; 2]) -> [f64; 4] {
        let Parameters { arms, inertia, .. } = &self.parameters;
        let pose = forward::pose(arms, a, b).unwrap();
        let form = two_coordinate(arms, inertia, &pose, [rate_a, rate_b]);
        let [a_2, b_2] = form.acceleration_rad_s2(force_n, [0.0; 4]);
        [rate_a, rate_b, a_2, b_2]
    }
}

impl Engine for Free {
    fn tick(&mut self, force_n: [f64; 2]) {
        let h = self.step_s;
        for _ in 0..self.steps {
            let y = self.state;
            let plus = |k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| y[i] + h * k[i]);
            let k_1 = self.rate(y, force_n);
            let k_2 = self.rate(plus(k_1, h / 2.0), force_n);
            let k_3 = self.rate(plus(k_2, h / 2.0), force_n);
            let k_4 = self.rate(plus(k_3, h), force_n);
            let mean = [0, 1, 2, 3].map(|i| (k_1[i] + 2.0 * (k_2[i] + k_3[i]) + k_4[i]) / 6.0);
            self.state = plus(mean, h);
        }
    }

    fn sample(&self) -> Sample {
        let [a, b, rate_a, rate_b] = self.state;
        Sample {
            base_rad: [a, b],
            rates_rad_s: [rate_a, rate_b],
            tip_m: forward::pose(&self.parameters.arms, a, b).unwrap().tip_m,
        }
    }
}

/// The rig with its brakes.
#[derive(Clone)]
pub struct Braked {
    rig: Rig,
    currents_a: [f64; 4],
    tick_s: f64,
}

impl Braked {
    /// At the start of a case, its yield torques settled, with so many steps a tick.
    pub fn new(case: &Case, steps: u32) -> Braked {
        let rig = Rig::new(case.layout, case.start_m()).unwrap();
        let currents_a = case.currents_a();
        let mut rig = rig
            .with_longest_step_s(case.tick_s() / f64::from(steps))
            .unwrap();
        rig.step([0.0; 2], currents_a, SETTLING_S).unwrap();
        Braked {
            rig,
            currents_a,
            tick_s: case.tick_s(),
        }
    }
}

impl Engine for Braked {
    fn tick(&mut self, force_n: [f64; 2]) {
        self.rig
            .step(force_n, self.currents_a, self.tick_s)
            .unwrap();
    }

    fn sample(&self) -> Sample {
        Sample {
            base_rad: self.rig.base_angles_rad(),
            rates_rad_s: self.rig.base_rates_rad_s(),
            tip_m: self.rig.tip_m(),
        }
    }
}
