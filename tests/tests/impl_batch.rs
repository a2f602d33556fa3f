//! Many rigs at once move as each alone does, whatever number of threads moves them.

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use rigproof_impl::batch::{Batch, Block, LANES};
use rigproof_impl::plant::Scheme;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;

const BLOCKS: usize = 37;
const STEPS: usize = 400;
const STEP_S: f64 = 1e-3;

/// The force on each rig of a block in a step, N.
fn forces_n(block: usize, step: usize) -> [[f64; LANES]; 2] {
    let lanes = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let phase = |lane: f64| 0.0173 * step as f64 + 0.71 * lane + 0.29 * block as f64;
    [
        lanes.map(|lane| 3.1 * libm::sin(phase(lane))),
        lanes.map(|lane| -2.7 * libm::cos(1.3 * phase(lane))),
    ]
}

/// Every rig after the run, moved by so many threads in pieces of so many blocks.
fn ends(threads: usize, piece: usize) -> Vec<Block> {
    let layout = Layout::FourBrake;
    let batch = Batch::new(&arms(layout), &inertia(layout), Scheme::Midpoint);
    let start = |block: usize| {
        let off = 0.0031 * block as f64;
        Block::new(
            &batch,
            [[2.17 - off, 0.83 + off]; LANES],
            [[0.13, -0.07]; LANES],
        )
        .unwrap()
    };
    let mut blocks: Vec<Block> = (0..BLOCKS).map(start).collect();
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        blocks
            .par_chunks_mut(piece)
            .enumerate()
            .for_each(|(index, rigs)| {
                for step in 0..STEPS {
                    let forces: Vec<_> = (0..rigs.len())
                        .map(|k| forces_n(index * piece + k, step))
                        .collect();
                    batch.step_free(rigs, &forces, STEP_S);
                }
            });
    });
    blocks
}

#[test]
fn rigs_move_the_same_whatever_the_number_of_threads() {
    let alone = ends(1, BLOCKS);
    assert!(alone.windows(2).all(|pair| pair[0] != pair[1]));
    for (threads, piece) in [(1, 1), (2, 5), (3, 4), (7, 2)] {
        assert!(
            ends(threads, piece) == alone,
            "{threads} threads, pieces of {piece}"
        );
    }
}

#[test]
fn a_block_has_so_many_rigs_and_each_begins_with_rates_that_are_numbers() {
    let layout = Layout::FourBrake;
    let batch = Batch::new(&arms(layout), &inertia(layout), Scheme::Midpoint);
    let thetas = [[2.17, 0.83]; LANES];
    let mut rates = [[0.13, -0.07]; LANES];
    let block = Block::new(&batch, thetas, rates).unwrap();
    assert_eq!(block.base_rates_rad_s(LANES - 1), Some([0.13, -0.07]));
    assert_eq!(block.base_rates_rad_s(LANES), None);
    assert_eq!(block.base_angles_rad(LANES), None);
    rates[LANES - 1][1] = f64::NAN;
    assert_eq!(Block::new(&batch, thetas, rates), None);
}
