//! This file says what a diagnosis costs over the length of a recording, and what the free run costs.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use core::f64::consts::TAU;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rigproof_diagnose::plants::joint::from_rig;
use rigproof_diagnose::plants::joint::simulate::output;
use rigproof_diagnose::{Options, diagnose};
use rigproof_model::axis::{Axis, Transmission};
use rigproof_model::effects::law;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::{Recording, Rig};
use rigproof_trace::{Channel, Trace};
use std::hint::black_box;
use std::path::Path;

const RIG: &str = r#"name = "slide"
plant = "axis"
motion = "linear"
[channels]
position = { channel = "x", unit = "m", noise = 1e-6 }
command = { channel = "u", unit = "N", quantum = 1e-3 }
[parameters]
inertia = { value = 1.3, unit = "kg", status = "unknown" }
command_gain = { value = 1.0, unit = "N/N" }
[[effect]]
mechanism = "viscous"
coefficient = { value = 6.1, unit = "N·s/m", status = "unknown" }
[[effect]]
mechanism = "spring"
stiffness = { value = 43.0, unit = "N/m", status = "unknown" }
[protocol]
drive = "held"
"#;

const STEP_S: f64 = 1e-3;
/// Period of the motion, s: a longer recording is the same motion more often, with other noise.
const PERIOD_S: f64 = 2.5;
/// Standard deviation of the position's noise, m, as the rig states it.
const NOISE_M: f64 = 1e-6;
/// Shortest recording, s, and how many times longer the others are.
const SHORTEST_S: f64 = 7.5;
const TIMES: [usize; 3] = [1, 4, 16];

/// A slide on a spring under three sines that repeat, with the dry friction that its rig leaves out; 1 kHz. It has
/// run in for one period before the recording begins.
fn recording(rig: &Rig, duration_s: f64) -> Recording {
    let laws: [(Mechanism, &[f64]); 3] = [
        (Mechanism::Viscous, &[7.3]),
        (Mechanism::Spring, &[41.0]),
        (Mechanism::DryOffset, &[1.7]),
    ];
    let axis = Axis {
        inertia: 1.37,
        laws: laws
            .iter()
            .map(|(m, values)| law(*m, values).unwrap())
            .collect(),
        transmission: Transmission::default(),
    };
    let mut random = Pcg64Mcg::seed_from_u64(29);
    // Twelve uniform numbers less six: standard deviation 1, close to Gaussian.
    let mut noise = || {
        let uniform = |x: u64| (x >> 11) as f64 / (1u64 << 53) as f64;
        (0..12).map(|_| uniform(random.next_u64())).sum::<f64>() - 6.0
    };
    let mut state = axis.state(0.0, 0.013, 0.0);
    let (mut time_s, mut position, mut command) = (Vec::new(), Vec::new(), Vec::new());
    let run_in = (PERIOD_S / STEP_S) as usize;
    for k in 0..run_in + (duration_s / STEP_S) as usize {
        let turn = TAU * (k % run_in) as f64 / run_in as f64;
        let exact = 6.3 * libm::sin(turn)
            + 5.1 * libm::sin(2.0 * turn + 1.2)
            + 2.7 * libm::sin(5.0 * turn + 0.4);
        let sent = 1e-3 * (exact * 1e3).round();
        if k >= run_in {
            time_s.push((k - run_in) as f64 * STEP_S);
            position.push(state.position + NOISE_M * noise());
            command.push(sent);
        }
        axis.step(&mut state, sent, sent, STEP_S);
    }
    let channel = |name: &str, unit: &str, samples| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples,
    };
    let trace = Trace {
        time_s,
        channels: vec![channel("x", "m", position), channel("u", "N", command)],
    };
    rig.apply(&trace, Path::new("bench")).unwrap()
}

fn lengths(criterion: &mut Criterion) {
    let rig = Rig::parse(RIG, Path::new("rig.toml")).unwrap();
    let options = |refit| Options {
        refit,
        ..Options::default()
    };
    for (name, samples) in [("name", 10), ("diagnose", 10), ("free_run", 20)] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(samples);
        for times in TIMES {
            let recording = recording(&rig, SHORTEST_S * times as f64);
            let run = from_rig::aligned(&rig, &recording).unwrap();
            let (plant, protocol) = (from_rig::plant(&rig), from_rig::protocol(&rig));
            group.throughput(Throughput::Elements(recording.time_s.len() as u64));
            group.bench_function(format!("{times}x"), |bencher| {
                bencher.iter(|| match name {
                    "free_run" => black_box(output(&plant, &run, &protocol)),
                    _ => {
                        let found =
                            diagnose(&rig, &[&recording], None, &options(name == "diagnose"));
                        black_box(found).curves.after
                    }
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, lengths);
criterion_main!(benches);
