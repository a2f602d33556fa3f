//! This file tells a problem within the trials of a brake: what a gain for every trial could do is taken out of every row.

use super::Problem;
use crate::scatter::Trials;
use std::sync::RwLock;

impl Problem<'_> {
    /// The same problem within trials.
    pub fn within(mut self, trials: Trials) -> Self {
        self.trials = Some(trials);
        let mut raw = core::mem::take(&mut self.target.raw);
        self.take_out_trials(&mut raw);
        self.target.raw = raw;
        self.kept = RwLock::default();
        self.whiten_own();
        self
    }

    /// Whether gains of trials are taken out.
    pub fn is_within_trials(&self) -> bool {
        self.trials.is_some()
    }

    pub(super) fn take_out_trials(&self, raw: &mut [f64]) {
        if let Some(trials) = &self.trials {
            trials.take_out(raw, &self.windows.usable);
        }
    }
}
