//! This file is a simulation of a model beside a recording, output by output.

use crate::align::Fault;

/// A model beside a recording.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// Times of the samples, s after the recording's first.
    pub time_s: Vec<f64>,
    /// The outputs that are compared.
    pub outputs: Vec<SimulatedOutput>,
    /// The number of free runs, and the number of those that broke off; `None` for one run of the
    /// whole recording.
    pub runs: Option<[usize; 2]>,
}

/// One output of a model beside the recorded one.
#[derive(Clone, Debug)]
pub struct SimulatedOutput {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: String,
    /// The recorded output; `None` if the output is a distance from the recording.
    pub recorded: Option<Vec<f64>>,
    /// As simulated.
    pub simulated: Vec<f64>,
    /// Which samples count.
    pub counts: Vec<bool>,
}

impl SimulatedOutput {
    /// The recorded output, NaN where it does not count; 0 for a distance.
    pub fn counted(&self) -> Vec<f64> {
        let counts = self.counts.iter().enumerate();
        let recorded = |k: usize| match &self.recorded {
            Some(recorded) => recorded.get(k).copied().unwrap_or(f64::NAN),
            None => 0.0,
        };
        counts
            .map(|(k, counts)| if *counts { recorded(k) } else { f64::NAN })
            .collect()
    }
}

/// Why a model cannot be simulated beside a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Unsimulated {
    /// The recording is faulty.
    Recording(Fault),
    /// The model cannot be simulated, and why.
    Model(String),
}
