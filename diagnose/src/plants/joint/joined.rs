//! This file joins recordings of one axis or bench, and computes columns over all of them.

use super::run::JointRun;
use crate::plant::Columns;
use crate::plants::joined::Joins;
use core::ops::Range;
use rayon::prelude::*;

impl Joins for JointRun {
    fn append(&mut self, run: &JointRun) {
        // No window may span the seam. The rows of a sweep stand alone.
        if !self.is_sweep()
            && let Some(last) = self.recorded.last_mut()
        {
            *last = false;
        }
        let before = self.position.len();
        if let (Some(own), Some(new)) = (&mut self.rows, &run.rows) {
            own.extend(new.iter().map(|row| before + row));
        }
        self.recorded.extend_from_slice(&run.recorded);
        self.remarks.extend_from_slice(&run.remarks);
        self.position.extend_from_slice(&run.position);
        self.motion.extend_from_slice(&run.motion);
        self.effort.extend_from_slice(&run.effort);
        self.untold_speed.extend_from_slice(&run.untold_speed);
        for (own, new) in [
            (&mut self.predicted, &run.predicted),
            (&mut self.current, &run.current),
        ] {
            if let (Some(own), Some(new)) = (own, new) {
                own.extend_from_slice(new);
            }
        }
        self.position_noise = self.position_noise.max(run.position_noise);
        self.effort_noise = self.effort_noise.max(run.effort_noise);
        self.speed_floor = self.speed_floor.max(run.speed_floor);
    }

    fn keep_parts(&mut self, parts: Vec<JointRun>) {
        self.parts = parts;
    }
}

/// The separate recordings of a joined run, with their sample ranges.
pub fn parts(run: &JointRun) -> impl Iterator<Item = (&JointRun, Range<usize>)> {
    let mut first = 0;
    run.parts.iter().map(move |part| {
        let range = first..first + part.len();
        first = range.end;
        (part, range)
    })
}

/// Columns over a joined run, computed separately for each recording.
pub fn over_parts(
    run: &JointRun,
    of: impl Fn(&JointRun, Range<usize>) -> Option<Columns> + Sync,
) -> Option<Columns> {
    if run.parts.is_empty() {
        return of(run, 0..run.len());
    }
    let parts: Vec<_> = parts(run).collect();
    let each = parts.into_par_iter().map(|(part, range)| of(part, range));
    each.collect::<Option<Vec<Columns>>>()?
        .into_iter()
        .reduce(after)
}

/// The columns of one recording followed by those of the next.
fn after(before: Columns, next: Columns) -> Columns {
    let chained = |(before, next): (Vec<f64>, Vec<f64>)| [before, next].concat();
    match (before, next) {
        (Columns::Free(before), Columns::Free(next)) => {
            Columns::Free(before.into_iter().zip(next).map(chained).collect())
        }
        (Columns::Fixed(before), Columns::Fixed(next)) => Columns::Fixed(chained((before, next))),
        (before, _) => before,
    }
}
