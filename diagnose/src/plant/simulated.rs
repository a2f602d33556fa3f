//! This file is a model beside a recording: what both say of each output.

use crate::align::Fault;

/// A model beside a recording.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// Times of the samples, s after the recording's first.
    pub time_s: Vec<f64>,
    /// The outputs that are compared.
    pub outputs: Vec<SimulatedOutput>,
    /// How many free runs there were and how many of them broke off; `None` for one run of the whole.
    pub runs: Option<[usize; 2]>,
}

/// One output of a model beside the recorded one.
#[derive(Clone, Debug)]
pub struct SimulatedOutput {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: String,
    /// As recorded; `None` for a distance from what was recorded.
    pub recorded: Option<Vec<f64>>,
    /// As simulated.
    pub simulated: Vec<f64>,
    /// Which samples count.
    pub counts: Vec<bool>,
}

impl SimulatedOutput {
    /// The recorded output where it counts, not a number elsewhere; 0 for a distance.
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

/// Why a model cannot be set beside a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Unsimulated {
    /// The recording is at fault.
    Recording(Fault),
    /// The model cannot be simulated: why.
    Model(String),
}
