//! This file says what a step of the plant costs: free, and with brakes, friction and backlash, on both layouts.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-3;
/// Where the arms start, rad: the middle of the workspace.
const THETA_RAD: [f64; 2] = [2.17, 0.83];

/// A spring to where the tip starts that also drives around it.
fn swirl(tip_m: Vector<f64>, middle_m: Vector<f64>, velocity_m_s: Vector<f64>) -> Vector<f64> {
    let off = tip_m - middle_m;
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
    criterion.bench_function(&format!("free step, {layout:?}"), |bencher| {
        let mut motion = start;
        bencher.iter(|| {
            let velocity = motion.linkage.tip_velocity(motion.rates_rad_s);
            let force_n = swirl(motion.linkage.tip_m, middle_m, velocity * 7.0);
            let outcome = motion.step_free(&mechanism, black_box(force_n), STEP_S);
            assert_eq!(outcome, Outcome::Moved);
        });
    });
}

fn full(criterion: &mut Criterion, layout: Layout) {
    let parameters = Parameters::of(layout);
    let start = Plant::new(&parameters, THETA_RAD, [0.0; 2], &[]).unwrap();
    let middle_m = start.tip_m() + Vector::new(0.061, -0.023);
    criterion.bench_function(&format!("full step, {layout:?}"), |bencher| {
        let mut plant = start;
        let mut k = 0_usize;
        bencher.iter(|| {
            let force_n = swirl(plant.tip_m(), middle_m, plant.tip_velocity_m_s());
            let mut currents_a = [0.31, 0.17, 0.23, 0.0];
            for (index, current_a) in currents_a.iter_mut().take(3).enumerate() {
                if index == (k / 40) % 3 {
                    *current_a = 0.83;
                }
            }
            k += 1;
            let outcome = plant.step(black_box(force_n).into(), currents_a, STEP_S);
            assert_eq!(outcome, Outcome::Moved);
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
