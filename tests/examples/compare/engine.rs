//! This file says what an engine is here: something that takes a step under a force and can be looked at.

use crate::case::Case;
use crate::timing::{Cost, cost};

/// The rig between two ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// θA and θB, rad.
    pub base_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The tip, m.
    pub tip_m: [f64; 2],
}

/// A rig that stands at the start of a case.
pub trait Engine: Clone {
    /// Moves on by a tick under a force on the tip, N.
    fn tick(&mut self, force_n: [f64; 2]);
    /// Where it is.
    fn sample(&self) -> Sample;
}

/// The run of a case, a sample between all ticks, the start first.
pub fn run(engine: &impl Engine, case: &Case) -> Vec<Sample> {
    let mut engine = engine.clone();
    let mut samples = vec![engine.sample()];
    for force_n in case.forces_n() {
        engine.tick(force_n);
        samples.push(engine.sample());
    }
    samples
}

/// What a tick of a case costs: nothing is looked at.
pub fn time(engine: &impl Engine, case: &Case, repeats: usize) -> Cost {
    cost(
        repeats,
        &case.forces_n(),
        || engine.clone(),
        |engine, force_n| engine.tick(force_n),
    )
}

/// Greatest distance between the tips of two runs, m.
pub fn apart_m(one: &[Sample], other: &[Sample]) -> f64 {
    one.iter().zip(other).fold(0.0, |most: f64, (a, b)| {
        let ([a_x, a_y], [b_x, b_y]) = (a.tip_m, b.tip_m);
        most.max(libm::hypot(a_x - b_x, a_y - b_y))
    })
}
