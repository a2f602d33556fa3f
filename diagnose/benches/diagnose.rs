//! This file says what a diagnosis costs over the length of a recording, and what the free run costs.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rigproof_diagnose::simulate::output;
use rigproof_diagnose::{Options, diagnose, from_rig};
use rigproof_model::axis::Axis;
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
position = { channel = "x", unit = "m", quantum = 1e-6 }
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

/// A slide on a spring under three sines, with the dry friction that its rig leaves out; 1 kHz.
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
    };
    let mut state = axis.state(0.0, 0.013, 0.0);
    let (mut time_s, mut position, mut command) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..(duration_s / STEP_S) as usize {
        let t = k as f64 * STEP_S;
        let exact = 6.3 * libm::sin(2.33 * t)
            + 5.1 * libm::sin(5.2 * t + 1.2)
            + 2.7 * libm::sin(11.9 * t + 0.4);
        let sent = 1e-3 * (exact * 1e3).round();
        time_s.push(t);
        position.push(1e-6 * (state.position * 1e6).round());
        command.push(sent);
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
    let naming = Options {
        refit: false,
        ..Options::default()
    };
    for (name, samples) in [("diagnose", 10), ("free_run", 20)] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(samples);
        for duration_s in [6.25, 25.0, 100.0] {
            let recording = recording(&rig, duration_s);
            let run = from_rig::aligned(&rig, &recording).unwrap();
            let (plant, protocol) = (from_rig::plant(&rig), from_rig::protocol(&rig));
            group.throughput(Throughput::Elements(recording.time_s.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(duration_s), |bencher| {
                bencher.iter(|| match name {
                    "diagnose" => {
                        black_box(diagnose(&rig, &recording, None, &naming))
                            .curves
                            .after
                    }
                    _ => black_box(output(&plant, &run, &protocol)),
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, lengths);
criterion_main!(benches);
