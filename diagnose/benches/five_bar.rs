//! This file says what a diagnosis of a five-bar with four brakes costs over the length of its recording.
#![allow(clippy::unwrap_used, reason = "a bench may stop at the first surprise")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rigproof_diagnose::plants::five_bar::experiment::plan::Plan;
use rigproof_diagnose::plants::five_bar::experiment::play::play;
use rigproof_diagnose::plants::five_bar::free_run::Model;
use rigproof_diagnose::{Options, diagnose};
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};
use std::hint::black_box;
use std::path::Path;

const RIG: &str = r#"name = "bench"
plant = "rig"
layout = "four_brake"
[channels]
theta_a = { channel = "theta_a", unit = "rad", scale = 6.283185307179587e-6, quantum = 1.0 }
theta_b = { channel = "theta_b", unit = "rad", scale = 6.283185307179587e-6, quantum = 1.0 }
force_x = { channel = "force_x", unit = "N", noise = 0.025 }
force_y = { channel = "force_y", unit = "N", noise = 0.025 }
current_a = { channel = "current_a", unit = "A" }
current_e = { channel = "current_e", unit = "A" }
current_b = { channel = "current_b", unit = "A" }
current_c = { channel = "current_c", unit = "A" }
"#;

/// What the description leaves out.
const LEFT_OUT: &str = r#"[[effect]]
mechanism = "viscous"
joint = "E"
coefficient = { value = 0.04, unit = "N·m·s/rad" }
"#;

const STEP_S: f64 = 1e-3;
const LENGTHS_S: [f64; 3] = [15.0, 30.0, 60.0];
/// For how long a brake has currents before the next one does, s, and the currents, A.
const TURN_S: f64 = 2.5;
const CURRENTS_A: [f64; 5] = [0.1, 0.25, 0.4, 0.2, 0.3];

/// A winding path, and a staircase of current on one brake after another, then on none.
fn plan(duration_s: f64) -> Plan {
    let times_s = (0..(duration_s / STEP_S) as usize).map(|k| k as f64 * STEP_S);
    let sine = |t: f64, rate: f64, phase: f64| libm::sin(rate * t + phase);
    let hand = |t| {
        [
            0.02 + 0.056 * sine(t, 2.31, 0.3) + 0.029 * sine(t, 5.13, 1.1),
            0.40 + 0.041 * sine(t, 3.07, 2.1) + 0.024 * sine(t, 6.71, 0.7),
        ]
    };
    let current = |t: f64, brake: usize| {
        let stair = (t / TURN_S).fract() * CURRENTS_A.len() as f64;
        let has_its_turn = (t / TURN_S) as usize % 5 == brake;
        let step = CURRENTS_A.get(stair as usize).filter(|_| has_its_turn);
        step.copied().unwrap_or(0.0)
    };
    Plan {
        words: String::new(),
        step_s: STEP_S,
        hand_m: times_s.clone().map(hand).collect(),
        currents_a: [0, 1, 2, 3].map(|brake| times_s.clone().map(|t| current(t, brake)).collect()),
    }
}

fn recording(rig: &FiveBar, duration_s: f64) -> FiveBarRecording {
    let truth = FiveBar::parse(&format!("{RIG}{LEFT_OUT}"), Path::new("truth.toml")).unwrap();
    let played = play(&Model::of(&truth), rig.layout, &plan(duration_s)).unwrap();
    let sensed = played.sensed(rig, 5);
    sensed.recording(rig.layout, Default::default())
}

fn lengths(criterion: &mut Criterion) {
    let rig = FiveBar::parse(RIG, Path::new("rig.toml")).unwrap();
    let mut group = criterion.benchmark_group("five_bar");
    group.sample_size(10);
    for duration_s in LENGTHS_S {
        let recording = recording(&rig, duration_s);
        group.throughput(Throughput::Elements(recording.time_s.len() as u64));
        group.bench_function(format!("{duration_s} s"), |bencher| {
            bencher.iter(|| {
                let found = diagnose(&rig, &[&recording], None, &Options::default());
                assert_eq!(found.report.effects.len(), 1, "{}", found.report.summary);
                black_box(found).curves.after
            });
        });
    }
    group.finish();
}

criterion_group!(benches, lengths);
criterion_main!(benches);
