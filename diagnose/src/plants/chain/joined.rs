//! This file joins recordings of one arm.

use super::run::ChainRun;
use crate::plants::joined::Joins;

impl Joins for ChainRun {
    fn append(&mut self, run: &ChainRun) {
        let [before, more] = [self.len(), run.len()];
        // A signal holds one joint's samples after another's.
        let both = |own: &mut Vec<f64>, new: &[f64]| {
            let stretches = own.chunks(before.max(1)).zip(new.chunks(more.max(1)));
            *own = stretches
                .flat_map(|(own, new)| [own, new].concat())
                .collect();
        };
        both(&mut self.effort, &run.effort);
        both(&mut self.known, &run.known);
        both(&mut self.payload, &run.payload);
        for ((_, own), (_, new)) in self.links.iter_mut().zip(&run.links) {
            both(own, new);
        }
        for (own, new) in self.motions.iter_mut().zip(&run.motions) {
            own.extend_from_slice(new);
        }
        for (own, new) in self.noise.iter_mut().zip(&run.noise) {
            own.iter_mut()
                .zip(new)
                .for_each(|(own, new)| *own = own.max(*new));
        }
        // No window may span the seam.
        if let Some(last) = self.recorded.last_mut() {
            *last = false;
        }
        self.seams.push(before);
        self.recorded.extend_from_slice(&run.recorded);
        self.speed_floor = self.speed_floor.max(run.speed_floor);
    }

    /// No law of an arm has a memory. What is differenced ends at each seam.
    fn keep_parts(&mut self, _: Vec<ChainRun>) {}
}
