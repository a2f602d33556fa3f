//! This file says what a step of the plant costs: free, and with brakes, friction and backlash, on both layouts.
//!
//! The forces of 300 steps are recorded once and repeated from the same start, so that what a force costs is not counted.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-3;
const STEPS: u32 = 300;
/// Where the arms start, rad: the middle of the workspace.
const THETA_RAD: [f64; 2] = [2.17, 0.83];

/// A spring to a point that also drives around it.
fn swirl(off: Vector<f64>, velocity_m_s: Vector<f64>) -> Vector<f64> {
    off * -310.0 + off.left() * 170.0 - velocity_m_s * 3.1
}

fn free(criterion: &mut Criterion, layout: Layout) {
    let Parameters {
        arms,
        inertia,
        scheme,
        ..
    } = Parameters::of(layout);
    let mechanism = Mechanism::<f64>::new(&arms, &inertia, scheme);
    let start = Motion::new(&mechanism, THETA_RAD.into(), Vector::new(0.71, -0.37)).unwrap();
    let middle_m = start.linkage.tip_m + Vector::new(0.013, -0.021);
    let mut motion = start;
    let mut record = || {
        let velocity = motion.linkage.tip_velocity(motion.rates_rad_s);
        let force_n = swirl(motion.linkage.tip_m - middle_m, velocity * 7.0);
        motion.step_free(&mechanism, force_n, STEP_S);
        force_n
    };
    let forces_n: Vec<Vector<f64>> = (0..STEPS).map(|_| record()).collect();
    let mut group = criterion.benchmark_group("plant");
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    group.bench_function(format!("free step, {layout:?}"), |bencher| {
        bencher.iter(|| {
            let mut motion = start;
            for force_n in &forces_n {
                let outcome = motion.step_free(&mechanism, *black_box(force_n), STEP_S);
                assert_eq!(outcome, Outcome::Moved);
            }
            motion
        });
    });
}

/// One brake after the other, 40 steps each, is asked for much.
fn currents_a(k: u32) -> [f64; 4] {
    let mut currents_a = [0.11, 0.07, 0.13, 0.0];
    for (place, current_a) in (0..3).zip(&mut currents_a) {
        if (k / 40) % 3 == place {
            *current_a = 0.83;
        }
    }
    currents_a
}

fn full(criterion: &mut Criterion, layout: Layout) {
    let start = Plant::new(&Parameters::of(layout), THETA_RAD, [0.0; 2], &[]).unwrap();
    let middle_m = start.tip_m() + Vector::new(0.061, -0.023);
    let mut plant = start;
    let mut held = 0;
    let mut record = |k: u32| {
        let part = f64::from(k) / f64::from(STEPS);
        let push_n = Vector::new(9.4 * part - 11.0, 13.0 - 8.7 * part);
        let force_n = swirl(plant.tip_m() - middle_m, plant.tip_velocity_m_s()) + push_n;
        plant.step(force_n.into(), currents_a(k), STEP_S);
        held += plant.stuck().into_iter().filter(|held| *held).count();
        force_n.into()
    };
    let forces_n: Vec<[f64; 2]> = (0..STEPS).map(&mut record).collect();
    println!("{layout:?}: {held} joints held in {STEPS} steps");
    let mut group = criterion.benchmark_group("plant");
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    group.bench_function(format!("full step, {layout:?}"), |bencher| {
        bencher.iter(|| {
            let mut plant = start;
            for (k, force_n) in (0..STEPS).zip(&forces_n) {
                let outcome = plant.step(*black_box(force_n), currents_a(k), STEP_S);
                assert_eq!(outcome, Outcome::Moved);
            }
            plant
        });
    });
}

fn steps(criterion: &mut Criterion) {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        free(criterion, layout);
        full(criterion, layout);
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
