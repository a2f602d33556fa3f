//! This file says what 10 s at 1 kHz cost: the whole loop, and its controller and its plant alone.
#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a bench may stop at the first surprise"
)]

mod rig;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rigproof_impl::plant::Plant;
use rigproof_spec::methods::SAMPLE_STEP_S;

use rig::{ClosedLoop, TICKS, hand, record};

fn ten_seconds(bencher: &mut Criterion) {
    let mut group = bencher.benchmark_group("10 s at 1 kHz");
    group.throughput(Throughput::Elements(TICKS as u64));
    let (start, places, record) = (ClosedLoop::new(), hand(), record());
    group.bench_function("closed loop", |b| {
        b.iter(|| {
            let mut rig = start.clone();
            for place in &places {
                rig.step(black_box(*place));
            }
            rig.plant
        });
    });
    group.bench_function("controller", |b| {
        b.iter(|| {
            let mut controller = start.controller;
            for (sensed, _) in &record {
                black_box(controller.tick(black_box(sensed)));
            }
        });
    });
    group.bench_function("plant", |b| {
        b.iter(|| {
            let mut plant: Plant = start.plant;
            for (sensed, command) in black_box(&record) {
                plant.step(sensed.tip_force_n.into(), command.currents_a, SAMPLE_STEP_S);
            }
            plant
        });
    });
    group.finish();
}

criterion_group!(benches, ten_seconds);
criterion_main!(benches);
