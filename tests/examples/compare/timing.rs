//! This file says how a step is timed: whole runs, one after the other, on the clock of the wall.

use std::time::Instant;

/// What a step costs, ns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The median of the runs.
    pub median_ns: f64,
    /// The least of the runs.
    pub least_ns: f64,
}

/// The cost of a step in runs of `steps` steps; the first run is not counted.
pub fn cost<T>(repeats: usize, steps: usize, mut run: impl FnMut() -> T) -> Cost {
    std::hint::black_box(run());
    let mut each_ns: Vec<f64> = (0..repeats)
        .map(|_| {
            let start = Instant::now();
            std::hint::black_box(run());
            start.elapsed().as_secs_f64() * 1e9 / steps as f64
        })
        .collect();
    each_ns.sort_by(f64::total_cmp);
    Cost {
        median_ns: each_ns[each_ns.len() / 2],
        least_ns: each_ns[0],
    }
}
