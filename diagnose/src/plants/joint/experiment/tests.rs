//! This file claims that a joint whose rivals one motion does not separate is given another motion
//! that does.

use super::super::recorded::{Noise, QUANTUM};
use crate::report::Report;
use crate::{Diagnosis, Options, diagnose};
use core::f64::consts::TAU;
use rigproof_trace::rig::Rig;
use rigproof_trace::{Channel, Trace};
use std::path::Path;

const NOISE_N: f64 = 0.02;

fn rig() -> Rig {
    let text = format!(
        "name = \"slide\"\nplant = \"bench\"\nmotion = \"linear\"\n[channels]\n\
         position = {{ channel = \"x\", unit = \"m\", quantum = {QUANTUM:e} }}\n\
         force = {{ channel = \"f\", unit = \"N\", noise = {NOISE_N} }}\n"
    );
    Rig::parse(&text, Path::new("rig.toml")).unwrap()
}

/// A slide with viscous friction that the description lacks, to and fro at one speed, m/s, and then
/// at another one.
fn recorded(speeds: [f64; 2], seed: u64) -> Trace {
    let mut noise = Noise::new(seed);
    let time_s: Vec<f64> = (0..12_000).map(|k| 1e-3 * f64::from(k)).collect();
    let (mut turned, mut x, mut f) = (0.0, Vec::new(), Vec::new());
    for t in &time_s {
        let speed = speeds[usize::from(*t > 6.0)];
        // A triangle of 0.1 m to each side with rounded tips: nearly one speed.
        let (sine, cosine) = libm::sincos(turned);
        let round = (1.0 - 0.9998 * sine * sine).sqrt();
        let q = 0.1 * libm::asin(0.9999 * sine) * 4.0 / TAU;
        x.push(QUANTUM * (q / QUANTUM).round());
        f.push(2.3 * speed * cosine / round + NOISE_N * noise.draw());
        turned += 1e-3 * speed * TAU / 0.4;
    }
    let channel = |name: &str, unit: &str, samples: Vec<f64>| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples,
    };
    let channels = vec![channel("x", "m", x), channel("f", "N", f)];
    Trace { time_s, channels }
}

fn diagnosed(trace: &Trace) -> Diagnosis<Rig> {
    let rig = rig();
    let recording = rig.apply(trace, Path::new("run.csv")).unwrap();
    diagnose(&rig, &[&recording], None, &Options::default())
}

fn named(report: &Report) -> Vec<&str> {
    report.effects.iter().map(|own| own.mechanism).collect()
}

#[test]
fn frictions_that_one_speed_does_not_separate_are_told_apart_at_another() {
    let found = diagnosed(&recorded([0.17; 2], 3));
    let next = found.report.next_experiment.unwrap();
    let what = next.what.unwrap();
    assert!(what.contains("speed") || what.contains("rest"), "{what}");
    let of_both = |own: &crate::report::Separation| {
        let names = [&own.one[..], &own.other[..]];
        names.contains(&"viscous") && names.contains(&"dry_offset") && own.tellable
    };
    assert!(
        next.separations.iter().any(of_both),
        "{:?}",
        next.separations
    );
    let plan = found.experiment.unwrap();
    assert_eq!(
        (&plan.channels[0].name[..], &plan.channels[0].unit[..]),
        ("position", "m")
    );
    // A recording at two speeds names the truth.
    let again = diagnosed(&recorded([0.17, 0.085], 4));
    assert_eq!(named(&again.report), ["viscous"]);
    assert!(again.report.next_experiment.is_none());
}
