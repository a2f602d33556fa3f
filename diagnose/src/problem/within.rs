//! This file restricts a problem to what happens within the trials of a brake: a gain for every
//! trial is projected out of every row.

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

    /// Whether the gains of trials are projected out.
    pub fn is_within_trials(&self) -> bool {
        self.trials.is_some()
    }

    pub(super) fn take_out_trials(&self, raw: &mut [f64]) {
        if let Some(trials) = &self.trials {
            trials.take_out(raw, &self.windows.usable);
        }
    }
}
