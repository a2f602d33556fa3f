//! This file times a tick of the controller, and its estimator of velocity alone. Each number is of one tick of a moving tip.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use rigproof_impl::actuation::Actuation;
use rigproof_impl::encoder::{COUNTS_PER_TURN, Encoder};
use rigproof_impl::law::{Law, Proportional, Sdof};
use rigproof_impl::number::Real;
use rigproof_impl::path::Line;
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_impl::velocity::Velocity;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, SAMPLE_STEP_S};

const LAYOUT: Layout = Layout::FourBrake;
/// Samples of one pass.
const SAMPLES: u32 = 4096;

/// A tip that is led around the middle of the workspace and pushed about.
fn samples<R: Real>() -> Vec<Sensed<R>> {
    let wave = |k: u32, hz: f64| libm::sin(TAU * hz * SAMPLE_STEP_S * f64::from(k));
    let count = |angle_rad: f64| (angle_rad / TAU * f64::from(COUNTS_PER_TURN)).round() as i32;
    (0..SAMPLES)
        .map(|k| Sensed {
            number: k,
            counts: [
                count(2.1 + 0.31 * wave(k, 0.71) + 0.011 * wave(k, 9.3)),
                count(0.9 + 0.27 * wave(k, 0.53) + 0.013 * wave(k, 8.7)),
            ],
            tip_force_n: Vector::new(R::of(5.3 * wave(k, 1.7)), R::of(4.1 * wave(k, 2.3))),
        })
        .collect()
}

fn pass<R: Real, L: Law<R> + Copy>(criterion: &mut Criterion, name: &str, law: L) {
    let ready = Tick::new(&Settings::thesis(LAYOUT), law).unwrap();
    let samples = samples::<R>();
    let mut acted = 0;
    let mut tick = ready;
    for sensed in &samples {
        acted += u32::from(tick.tick(sensed).currents_a.iter().any(|a| *a > R::zero()));
    }
    assert!(
        acted > SAMPLES / 4,
        "{name} acts in {acted} of {SAMPLES} ticks only"
    );
    criterion.bench_function(&format!("{name}, {SAMPLES} ticks"), |bencher| {
        bencher.iter_batched_ref(
            || ready,
            |tick| {
                for sensed in &samples {
                    black_box(tick.tick(black_box(sensed)));
                }
            },
            BatchSize::SmallInput,
        );
    });
}

fn ticks<R: Real>(criterion: &mut Criterion, name: &str) {
    let line = Line::<R>::through([-0.113, 0.383], [0.107, 0.412]).unwrap();
    let actuation = Actuation::<R>::thesis(LAYOUT);
    let gain_n_s_per_m = 497.0;
    let proportional = Proportional::new(actuation, line, BLEND_BOUNDARY_M, gain_n_s_per_m);
    let sdof = Sdof::new(actuation, line, BLEND_BOUNDARY_M, 0.0);
    pass(
        criterion,
        &format!("tick/{name}/proportional"),
        proportional.unwrap(),
    );
    pass(criterion, &format!("tick/{name}/sdof"), sdof.unwrap());
    let encoder = Encoder::<R>::new(COUNTS_PER_TURN, 0).unwrap();
    let ready = [Velocity::new(&encoder, SAMPLE_STEP_S); 2];
    let samples = samples::<R>();
    criterion.bench_function(
        &format!("velocity/{name}, {SAMPLES} ticks of both joints"),
        |bencher| {
            bencher.iter_batched_ref(
                || ready,
                |joints| {
                    for sensed in &samples {
                        for (joint, count) in joints.iter_mut().zip(black_box(sensed).counts) {
                            black_box(joint.update(count));
                        }
                    }
                },
                BatchSize::SmallInput,
            );
        },
    );
}

fn both(criterion: &mut Criterion) {
    ticks::<f64>(criterion, "f64");
    ticks::<f32>(criterion, "f32");
}

criterion_group!(benches, both);
criterion_main!(benches);
