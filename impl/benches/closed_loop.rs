//! This file says what 10 s at 1 kHz cost: the whole loop, the controller alone, the plant alone, and the linkage without brakes.
#![allow(clippy::unwrap_used, missing_docs, reason = "a bench may stop at the first surprise")]

mod rig;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Parameters, Plant, Scheme};
use rigproof_spec::layout::Layout;
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
    let Parameters { arms, inertia, .. } = Parameters::of(Layout::FourBrake);
    let mechanism: Mechanism<f64> = Mechanism::new(&arms, &inertia, Scheme::Midpoint);
    let theta_rad = start.plant.base_angles_rad().into();
    let motion = Motion::new(&mechanism, theta_rad, [0.0; 2].into()).unwrap();
    group.bench_function("linkage without brakes", |b| {
        b.iter(|| {
            let mut motion = motion;
            for tick in 0..TICKS {
                // Drives round and back without a drift.
                let [x, y] = PUSHES_N[tick / 16 % PUSHES_N.len()];
                motion.step_free(&mechanism, black_box([x, y]).into(), SAMPLE_STEP_S);
            }
            motion
        });
    });
    group.finish();
}

/// Forces that come to nothing over a round, N.
const PUSHES_N: [[f64; 2]; 4] = [[7.3, 3.1], [-7.3, -3.1], [-7.3, -3.1], [7.3, 3.1]];

criterion_group!(benches, ten_seconds);
criterion_main!(benches);
