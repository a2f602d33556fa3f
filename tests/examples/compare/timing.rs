//! This file says how a tick is timed: in short pieces, so that what else the machine does falls out of the median.

use std::time::Instant;

/// Ticks of a piece.
const PIECE: usize = 50;

/// What a tick costs, ns: the median and the least of the repeats of every piece, averaged over the pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// By the medians.
    pub median_ns: f64,
    /// By the least.
    pub least_ns: f64,
}

/// The cost of a tick where `start` begins a run and `tick` takes one tick of it under a force; the first run is not counted.
pub fn cost<E>(
    repeats: usize,
    forces_n: &[[f64; 2]],
    start: impl Fn() -> E,
    tick: impl Fn(&mut E, [f64; 2]),
) -> Cost {
    let mut pieces_ns = vec![Vec::with_capacity(repeats); forces_n.len().div_ceil(PIECE)];
    for repeat in 0..=repeats {
        let mut engine = start();
        for (piece_ns, piece) in pieces_ns.iter_mut().zip(forces_n.chunks(PIECE)) {
            let from = Instant::now();
            for force_n in piece {
                tick(&mut engine, *force_n);
            }
            if repeat > 0 {
                piece_ns.push(from.elapsed().as_secs_f64() * 1e9);
            }
        }
        std::hint::black_box(engine);
    }
    for piece_ns in &mut pieces_ns {
        piece_ns.sort_by(f64::total_cmp);
    }
    let mean = |at: usize| {
        pieces_ns.iter().map(|piece_ns| piece_ns[at]).sum::<f64>() / forces_n.len() as f64
    };
    Cost {
        median_ns: mean(repeats / 2),
        least_ns: mean(0),
    }
}
