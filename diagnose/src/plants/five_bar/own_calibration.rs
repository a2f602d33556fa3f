//! This file claims that a five-bar simulated with its own calibration is diagnosed as consistent,
//! and that stated effects are obeyed.
//!
//! One seed for each of ten effects; `RIGPROOF_SEEDS=5` in the environment takes five for each
//! mechanism that is a candidate.

use super::recorded::{nothing, recording, rig};
use super::replica::replica;
use crate::filter::rms;
use crate::plant::Described;
use crate::report::Verdict;
use crate::sensor::sensed;
use crate::{Diagnosis, Options, diagnose};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rayon::prelude::*;
use rigproof_spec::effect::Mechanism::{self, *};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, JointEffect};
use rigproof_trace::rig::{RigEffect, Value};
use std::path::Path;

/// What is left out: a mechanism, where it acts, and its parameters in SI units.
type LeftOut = (Mechanism, At, &'static [f64]);

/// Where an effect of a five-bar acts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum At {
    Whole,
    /// At a joint.
    One(Joint),
    /// As a share of the torque of a joint's brake.
    Share(Joint),
    /// On one axis of the force sensor.
    Axis(usize),
}
use At::{Axis, One, Share, Whole};
use Joint::{A, B, C, E};

/// Left out in every run of the tests. The last four also get a calibration of their own.
const ALWAYS: &[LeftOut] = &[
    (TimeConstant, One(E), &[2.3]),
    (CurrentGain, One(A), &[1.31]),
    (LinkLength, One(A), &[2.7e-3]),
    (Stribeck, Share(E), &[0.47, 0.53, 1.0]),
    (Lag, One(B), &[0.037]),
    (ChannelSkew, Whole, &[0.009]),
    (Spring, One(B), &[1.31, 1.19]),
    (ForceGain, Axis(0), &[0.13]),
    (PlaneSpring, Whole, &[17.0, 1.3, 0.11, 0.27]),
    (Viscous, One(E), &[0.19]),
];

/// The other candidates of a five-bar, left out where `RIGPROOF_SEEDS` is stated.
const WITH_SEEDS: &[LeftOut] = &[
    (DryOffset, One(E), &[0.137]),
    (ConstantBias, One(C), &[-0.113]),
    (VelocityPower, One(E), &[0.137, 0.5]),
    (GainError, One(B), &[0.17]),
    (DirectionAsymmetry, One(E), &[0.031, 0.071]),
    (Stribeck, One(A), &[0.23, 0.37, 1.3]),
    (Presliding, One(C), &[0.19, 0.013]),
    (Presliding, Share(C), &[0.43, 0.013]),
    (DryOffset, Share(A), &[0.17]),
    (ReversalOvershoot, One(B), &[0.37, 0.083]),
    (Ripple, One(A), &[0.091, -0.053, 0.113]),
    (Ripple, Share(B), &[0.31, -0.17, 0.31]),
    (UnevenFriction, One(A), &[0.061, -0.037, 0.37]),
    (NonlinearSpring, One(C), &[0.071]),
    (JointStop, One(B), &[2.3, 1.37, 1.0]),
    (BiasDrift, One(A), &[0.31]),
    (DeadTime, One(A), &[0.0237]),
    (Saturation, One(B), &[0.213]),
    (Saturation, One(B), &[0.313, 2.1]),
    (CurrentHysteresis, One(C), &[0.071, 0.3]),
    (ThermalFade, One(A), &[0.31, 7.3]),
    (TorqueDrift, One(A), &[-0.031]),
    (BacklashWidth, One(A), &[0.031]),
    (LoadDependent, One(E), &[0.0071]),
    (Gravity, Whole, &[0.71, -1.13]),
    (Payload, Whole, &[0.37]),
    (
        InertiaError,
        Whole,
        &[0.0137, -0.0071, 0.0053, 0.0047, 0.071],
    ),
    (InertiaScale, Whole, &[0.13]),
    (ForceGain, Whole, &[0.13]),
    (ForceBias, Whole, &[0.31, -0.23]),
    (ForceRotation, Whole, &[0.137]),
    (EncoderOffset, One(A), &[0.021]),
    (EncoderScale, One(B), &[0.017]),
    (EccentricEncoder, One(B), &[0.031, -0.017]),
];

fn stating((mechanism, at, values): LeftOut) -> FiveBar {
    let mut stated = rig(Layout::FourBrake);
    stated.effects.push(JointEffect {
        joint: match at {
            One(joint) | Share(joint) => Some(joint),
            Whole | Axis(_) => None,
        },
        axis: match at {
            Axis(axis) => Some(axis),
            Whole | One(_) | Share(_) => None,
        },
        effect: RigEffect {
            mechanism,
            values: values.iter().map(|value| Value::known(*value)).collect(),
            onset: None,
            of_torque: matches!(at, Share(_)),
        },
    });
    stated
}

/// The number of seeds, if one is stated.
fn stated_seeds() -> Option<u64> {
    std::env::var("RIGPROOF_SEEDS").ok()?.parse().ok()
}

/// What is left out and the seed: `always` of the first list, and all of both where a number of
/// seeds is stated.
fn cases(always: &[LeftOut]) -> Vec<(LeftOut, u64)> {
    let seeds = stated_seeds();
    let more = seeds.map_or(&[][..], |_| WITH_SEEDS);
    let first = seeds.map_or(always, |_| ALWAYS).iter();
    let all = first.chain(more);
    all.flat_map(|own| (0..seeds.unwrap_or(1)).map(move |seed| (*own, 31 + 7 * seed)))
        .collect()
}

/// The recording of a rig as described, along the path of the thesis's rig.
fn recorded(stated: &FiveBar, seed: u64) -> FiveBarRecording {
    let own = rig(Layout::FourBrake);
    let path = recording(Layout::FourBrake, 4.0, seed, &nothing);
    let exact = replica(&own, stated, &path).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let [angle, force] = exact.noise;
    let mut seen = exact.recording;
    for signal in &mut seen.theta {
        *signal = sensed(signal, angle, &mut random);
    }
    for signal in &mut seen.force {
        *signal = sensed(signal, force, &mut random);
    }
    seen
}

fn options() -> Options {
    Options {
        refit: false,
        next_experiment: false,
        ..Options::default()
    }
}

fn names(diagnosis: &Diagnosis<FiveBar>) -> Vec<(&'static str, Option<&'static str>)> {
    let effects = diagnosis.report.effects.iter();
    effects.map(|e| (e.mechanism, e.joint)).collect()
}

/// What is wrong with a model whose free runs do not end nearer to the recording than those of the
/// rig without the effect. Where the effect moves the tip by less than the free runs of a true
/// description miss it by, they may miss it by that much.
fn ends_no_nearer(model: &FiveBar, recording: &FiveBarRecording, seed: u64) -> Option<String> {
    let tip_m = |model: &FiveBar, recording: &FiveBarRecording| {
        let free = model.simulated(model, recording, 0.3).unwrap();
        rms(&free.outputs[2].simulated)
    };
    let nominal = rig(Layout::FourBrake);
    let (with, without) = (tip_m(model, recording), tip_m(&nominal, recording));
    if with <= 0.5 * without {
        return None;
    }
    let least = tip_m(&nominal, &recorded(&nominal, seed));
    (with > 1.1 * least).then(|| {
        format!("free runs: {with} m with it, {without} without, {least} where nothing is left out")
    })
}

/// Fails with what is wrong in each case.
fn assert_right(cases: Vec<(LeftOut, u64)>, wrong: impl Fn(LeftOut, u64) -> Vec<String> + Sync) {
    let said = cases.into_par_iter().flat_map_iter(|(own, seed)| {
        let wrong = wrong(own, seed).into_iter();
        wrong.map(move |words| format!("{own:?}, seed {seed}: {words}"))
    });
    let said: Vec<String> = said.collect();
    assert!(said.is_empty(), "{}", said.join("\n"));
}

#[test]
fn a_description_that_states_the_truth_is_obeyed() {
    assert_right(cases(ALWAYS), |own, seed| {
        let stated = stating(own);
        let recording = recorded(&stated, seed);
        let found = diagnose(&stated, &[&recording], None, &options());
        let mut wrong = Vec::new();
        if found.report.verdict != Verdict::Consistent {
            let said = (&found.report.summary, names(&found), &found.report.floor);
            wrong.push(format!("{said:?}"));
        }
        wrong.extend(ends_no_nearer(&stated, &recording, seed));
        wrong
    });
}

#[test]
fn with_its_own_calibration_nothing_is_named_again() {
    let last = ALWAYS.len() - 4;
    assert_right(cases(&ALWAYS[last..]), |own, seed| {
        let recording = recorded(&stating(own), seed);
        let first = diagnose(&rig(Layout::FourBrake), &[&recording], None, &options());
        let toml = first.calibration.to_toml();
        let calibration = match FiveBar::parse(&toml, Path::new("calibration.toml")) {
            Ok(calibration) => calibration,
            Err(error) => return vec![format!("{error}\n{toml}")],
        };
        let again = diagnose(&calibration, &[&recording], None, &options());
        // Something was left out, and the recording is long enough to show it.
        let is_seen = first.report.verdict != Verdict::Consistent;
        let is_quiet = again.report.effects.is_empty() && again.report.fault.is_none();
        let mut wrong = Vec::new();
        if !(is_quiet && is_seen) {
            let said = (&first.report.summary, names(&first));
            let then = (&again.report.summary, names(&again));
            wrong.push(format!("{said:?}, then {then:?}"));
        }
        wrong.extend(ends_no_nearer(&calibration, &recording, seed));
        wrong
    });
}
