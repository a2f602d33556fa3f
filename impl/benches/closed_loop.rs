//! This file says what a tick costs: the whole loop, and its controller and its plant alone.
#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a bench may stop at the first surprise"
)]

mod rig;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use rigproof_spec::methods::SAMPLE_STEP_S;

use rig::{ClosedLoop, TICKS, hand, record};

/// One tick after the other through 10 s, then from the start; many short samples, so that their median leaves out what else the machine does.
fn ticks(bencher: &mut Criterion) {
    let mut group = bencher.benchmark_group("tick");
    group.sampling_mode(SamplingMode::Flat).sample_size(1000);
    group.measurement_time(Duration::from_secs(2));
    let (start, places, record) = (ClosedLoop::new(), hand(), record());
    let mut ticks = (0..TICKS).cycle();
    let mut rig = start.clone();
    group.bench_function("closed loop", |b| {
        b.iter(|| {
            let tick = ticks.next().unwrap();
            if tick == 0 {
                rig = start.clone();
            }
            rig.step(black_box(places[tick]))
        });
    });
    let mut controller = start.controller;
    group.bench_function("controller", |b| {
        b.iter(|| {
            let tick = ticks.next().unwrap();
            if tick == 0 {
                controller = start.controller;
            }
            controller.tick(black_box(&record[tick].0))
        });
    });
    let mut plant = start.plant;
    group.bench_function("plant", |b| {
        b.iter(|| {
            let tick = ticks.next().unwrap();
            if tick == 0 {
                plant = start.plant;
            }
            let (sensed, command) = black_box(&record[tick]);
            plant.step(sensed.tip_force_n.into(), command.currents_a, SAMPLE_STEP_S)
        });
    });
    group.finish();
}

criterion_group!(benches, ticks);
criterion_main!(benches);
