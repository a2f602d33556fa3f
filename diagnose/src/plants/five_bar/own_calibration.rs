//! This file claims that a five-bar simulated with its own calibration is diagnosed as consistent,
//! and that stated effects are obeyed.
//!
//! One seed for each mechanism; `RIGPROOF_SEEDS=5` in the environment takes five.

use super::recorded::{nothing, recording, rig};
use super::replica::replica;
use crate::filter::rms;
use crate::plant::Described;
use crate::report::Verdict;
use crate::sensor::sensed;
use crate::{Diagnosis, Options, diagnose};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rigproof_spec::layout::Layout;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};
use std::path::Path;

/// The effects to leave out, as lines of a description. The last four also get a calibration of
/// their own.
const LEFT_OUT: &[&str] = &[
    "mechanism = \"time_constant\"\njoint = \"E\"\nscale = { value = 2.3, unit = \"1\" }\n",
    "mechanism = \"current_gain\"\njoint = \"A\"\nscale = { value = 1.31, unit = \"1\" }\n",
    "mechanism = \"link_length\"\njoint = \"A\"\nmore = { value = 2.7, unit = \"mm\" }\n",
    "mechanism = \"stribeck\"\njoint = \"E\"\nof = \"torque\"\npeak = { value = 0.47, unit = \"1\" }\nspeed = { value = 0.53, unit = \"rad/s\" }\nexponent = { value = 1.0, unit = \"1\" }\n",
    "mechanism = \"lag\"\njoint = \"B\"\ntime_constant = { value = 37.0, unit = \"ms\" }\n",
    "mechanism = \"channel_skew\"\ndelay = { value = 9.0, unit = \"ms\" }\n",
    "mechanism = \"spring\"\njoint = \"B\"\nstiffness = { value = 1.31, unit = \"N·m/rad\" }\nrest = { value = 1.19, unit = \"rad\" }\n",
    "mechanism = \"force_gain\"\naxis = \"x\"\nfraction = { value = 0.13, unit = \"1\" }\n",
    "mechanism = \"plane_spring\"\nstiffness = { value = 17.0, unit = \"N/m\" }\ntension = { value = 1.3, unit = \"N\" }\nx = { value = 0.11, unit = \"m\" }\ny = { value = 0.27, unit = \"m\" }\n",
    "mechanism = \"viscous\"\njoint = \"E\"\ncoefficient = { value = 0.19, unit = \"N·m·s/rad\" }\n",
];

fn stating(lines: &str) -> FiveBar {
    let (head, protocol) = rig(Layout::FourBrake)
        .to_toml()
        .split_once("[protocol]")
        .map_or_else(
            || unreachable!("a description has a protocol"),
            |(head, rest)| (head.to_owned(), format!("[protocol]{rest}")),
        );
    let text = format!("{head}[[effect]]\n{lines}{protocol}");
    FiveBar::parse(&text, Path::new("rig.toml")).unwrap()
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

fn seeds() -> u64 {
    let stated = std::env::var("RIGPROOF_SEEDS").ok();
    stated.and_then(|n| n.parse().ok()).unwrap_or(1)
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
/// rig without the effect.
fn ends_no_nearer(model: &FiveBar, recording: &FiveBarRecording, lines: &str) -> Option<String> {
    let tip_m = |model: &FiveBar| {
        let free = model.simulated(model, recording, 0.3).unwrap();
        rms(&free.outputs[2].simulated)
    };
    let (with, without) = (tip_m(model), tip_m(&rig(Layout::FourBrake)));
    (with > 0.5 * without).then(|| format!("{lines}free runs: {with} m with it, {without} without"))
}

#[test]
fn a_description_that_states_the_truth_is_obeyed() {
    let mut wrong = Vec::new();
    for lines in LEFT_OUT {
        let stated = stating(lines);
        for seed in 0..seeds() {
            let recording = recorded(&stated, 31 + 7 * seed);
            let found = diagnose(&stated, &[&recording], None, &options());
            if found.report.verdict != Verdict::Consistent {
                let said = (&found.report.summary, names(&found), &found.report.floor);
                wrong.push(format!("{lines}{said:?}"));
            }
            wrong.extend(ends_no_nearer(&stated, &recording, lines));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn with_its_own_calibration_nothing_is_named_again() {
    let mut wrong = Vec::new();
    for lines in LEFT_OUT.iter().rev().take(4) {
        for seed in 0..seeds() {
            let recording = recorded(&stating(lines), 31 + 7 * seed);
            let first = diagnose(&rig(Layout::FourBrake), &[&recording], None, &options());
            let toml = first.calibration.to_toml();
            let calibration = FiveBar::parse(&toml, Path::new("calibration.toml")).unwrap();
            let again = diagnose(&calibration, &[&recording], None, &options());
            wrong.extend(ends_no_nearer(&calibration, &recording, lines));
            // Something was left out, and the recording is long enough to show it.
            let is_seen = first.report.verdict != Verdict::Consistent;
            let is_quiet = again.report.effects.is_empty() && again.report.fault.is_none();
            if !(is_quiet && is_seen) {
                let said = (&first.report.summary, names(&first));
                wrong.push(format!(
                    "{lines}{said:?}, then {} {:?}",
                    again.report.summary,
                    names(&again)
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
