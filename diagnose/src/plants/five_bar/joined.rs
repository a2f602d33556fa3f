//! This file joins recordings of one five-bar, and computes signals over all of them.

use super::run::FiveBarRun;
use crate::plants::joined::Joins;
use rayon::prelude::*;

impl Joins for FiveBarRun {
    fn append(&mut self, run: &FiveBarRun) {
        let more = |own: &mut Vec<f64>, new: &Vec<f64>| own.extend_from_slice(new);
        let all = |own: &mut [Vec<f64>], new: &[Vec<f64>]| {
            own.iter_mut()
                .zip(new)
                .for_each(|(own, new)| more(own, new));
        };
        all(&mut self.theta, &run.theta);
        all(&mut self.force, &run.force);
        all(&mut self.yields, &run.yields);
        all(&mut self.yield_errors, &run.yield_errors);
        let levers = self.levers.iter_mut().zip(&run.levers);
        levers.for_each(|(own, new)| all(own, new));
        let joints = self.joints.iter_mut().zip(&run.joints);
        joints.for_each(|(own, new)| own.extend_from_slice(new));
        self.poses.extend_from_slice(&run.poses);
        self.forms.extend_from_slice(&run.forms);
        let currents = self.currents.iter_mut().zip(&run.currents);
        currents.for_each(|(own, new)| {
            if let (Some(own), Some(new)) = (own, new) {
                more(own, new);
            }
        });
        // No window may span the seam.
        if let Some(last) = self.recorded.last_mut() {
            *last = false;
        }
        self.recorded.extend_from_slice(&run.recorded);
        self.remarks.extend_from_slice(&run.remarks);
        self.switched.extend_from_slice(&run.switched);
        self.theta_noise = self.theta_noise.max(run.theta_noise);
        self.still_rad = self.still_rad.max(run.still_rad);
        self.cutoff_hz = self.cutoff_hz.max(run.cutoff_hz);
        self.force_noise = self.force_noise.max(run.force_noise);
        self.speed_floor = self.speed_floor.max(run.speed_floor);
    }

    fn keep_parts(&mut self, parts: Vec<FiveBarRun>) {
        self.parts = parts;
    }
}

/// Signals of both outputs over a joined run, computed separately for each recording.
pub fn over_parts(
    run: &FiveBarRun,
    of: impl Fn(&FiveBarRun) -> Option<Vec<Vec<f64>>> + Sync,
) -> Option<Vec<Vec<f64>>> {
    if run.parts.is_empty() {
        return of(run);
    }
    let each: Option<Vec<Vec<Vec<f64>>>> = run.parts.par_iter().map(&of).collect();
    let count = run.len();
    let mut whole: Vec<Vec<f64>> = Vec::new();
    let mut first = 0;
    for (part, signals) in run.parts.iter().zip(each?) {
        whole.resize_with(signals.len(), || vec![0.0; 2 * count]);
        for (whole, signal) in whole.iter_mut().zip(&signals) {
            let (a, b) = signal.split_at(signal.len() / 2);
            for (own, begin) in [(a, first), (b, count + first)] {
                let slots = whole.iter_mut().skip(begin);
                slots.zip(own).for_each(|(slot, x)| *slot = *x);
            }
        }
        first += part.len();
    }
    Some(whole)
}
