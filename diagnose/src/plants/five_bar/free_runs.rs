//! This file compares free runs of a five-bar before and after calibration.

use super::free_run::{Model, horizons};
use super::undone::undone_first;
use crate::diagnose::write::Stand;
use crate::evidence::intervals;
use crate::report::{FITTED_PART, HELD_OUT_PART, Horizon};
use rigproof_trace::rig::five_bar::FiveBar;

impl Stand<'_, FiveBar> {
    /// The errors of free runs with the nominal and with all effects of the calibration, and the
    /// protocol.
    pub(super) fn free_runs(&self, calibration: &FiveBar) -> (Vec<Horizon>, String) {
        let bare = self.bare();
        let intervals = intervals(self.problem, &bare);
        let nominal = Stand {
            selection: &bare,
            ..*self
        };
        // The encoders are inverted already: the runs have the true angles.
        let (undone, _) = undone_first(self.plant);
        let model = |calibration: &FiveBar| {
            let mut own = calibration.clone();
            own.effects.drain(..undone.len());
            Model::of(&own)
        };
        let before = model(&nominal.with_numbers(&intervals));
        let after = model(calibration);
        let first = (self.test_from_s / self.test.step_s).round() as usize;
        // Only the first of several recordings, since a run cannot cross a seam.
        let fitted = self.train.parts.first().unwrap_or(self.train);
        let parts = [
            (HELD_OUT_PART, self.test, first..self.test.len()),
            (FITTED_PART, fitted, 0..fitted.len()),
        ];
        let (mut all, mut said) = (Vec::new(), Vec::new());
        for (name, run, part) in parts {
            match horizons(&before, &after, run, part, name) {
                Ok((horizons, words)) => {
                    all.extend(horizons);
                    said.push(words);
                }
                Err(error) => return (Vec::new(), format!("no free runs: {error}")),
            }
        }
        let how = format!(
            "free runs of the reference rig from the smoothed recorded state, brakes and memories led along the recording to there, steps of at most 1 ms, force straight between samples, currents held; angles of A and B and tip against the recording, {}",
            said.join(", ")
        );
        (all, how)
    }
}
