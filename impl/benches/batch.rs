//! This file says what a step of a rig costs when many free rigs are moved at once, on one core.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rigproof_impl::batch::{Batch, Block, LANES};
use rigproof_impl::plant::Scheme;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-3;

fn free(criterion: &mut Criterion) {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let batch = Batch::new(&arms(layout), &inertia(layout), Scheme::Midpoint);
        for count in [8, 64, 1024] {
            let start = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
                let off = 0.013 * f64::from(k);
                [2.17 - off, 0.83 + off]
            });
            let rates = [[0.0031, -0.0017]; LANES];
            let block = Block::new(&batch, start, rates).unwrap();
            let mut blocks = vec![block; count / LANES];
            let forces = vec![[[0.0; LANES]; 2]; count / LANES];
            let mut group = criterion.benchmark_group(format!("free batch, {layout:?}"));
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(format!("{count} rigs"), |bencher| {
                bencher.iter(|| batch.step_free(&mut blocks, black_box(&forces), STEP_S));
            });
            group.finish();
        }
    }
}

criterion_group!(benches, free);
criterion_main!(benches);
