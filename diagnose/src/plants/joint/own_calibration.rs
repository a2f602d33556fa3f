//! This file claims that a plant simulated with its own calibration is diagnosed as consistent:
//! nothing is named again.
//!
//! One seed for each mechanism; `RIGPROOF_SEEDS=5` in the environment takes five.

use super::encoder::shown;
use super::recorded::{
    EFFORT_NOISE, INERTIA, NOMINAL, QUANTUM, exact_axis, exact_bench, signals, trace,
};
use super::run::{JointRun, PlantKind};
use super::simulate::{Model, Protocol, output};
use crate::cause::Scales;
use crate::effect::Effect;
use crate::plant::{Described, Run};
use crate::report::Verdict;
use crate::{Diagnosis, Options, diagnose};
use rayon::prelude::*;
use rigproof_spec::effect::Mechanism::{self, *};
use rigproof_trace::rig::{Recording, Rig, RigEffect, Value};
use std::path::Path;

/// Samples of a recording that shows what was left out of its description.
const COUNT: usize = 5_000;
/// The plants on which a mechanism is left out.
const BOTH: &[PlantKind] = &[PlantKind::Axis, PlantKind::Bench];
const AXIS: &[PlantKind] = &[PlantKind::Axis];
const BENCH: &[PlantKind] = &[PlantKind::Bench];

/// The mechanisms to leave out, with parameters and plants.
const LEFT_OUT: &[(Mechanism, &[f64], &[PlantKind])] = &[
    (DryOffset, &[1.73], BOTH),
    (ConstantBias, &[1.31], BOTH),
    (VelocityPower, &[3.1, 2.0], AXIS),
    (VelocityPower, &[0.37, 2.0], BENCH),
    (DirectionAsymmetry, &[1.9, 0.83], BOTH),
    (Stribeck, &[1.9, 0.07, 1.0], BOTH),
    (Presliding, &[1.73, 0.013], BOTH),
    (FrictionOvershoot, &[1.73, 0.031], BOTH),
    (DahlBristle, &[1.73, 0.017, 2.0], BOTH),
    (LugreBristle, &[1.73, 1.1, 0.013], BOTH),
    (AsymmetricPresliding, &[2.1, 1.3, 0.013], BOTH),
    (Ripple, &[0.91, -0.67, 0.11], BOTH),
    // Of an axis that has no friction it would drive.
    (UnevenFriction, &[0.91, -0.67, 0.11], BENCH),
    (NonlinearSpring, &[71.0], BOTH),
    (JointStop, &[5.3, 0.23, 1.0], BOTH),
    (BiasDrift, &[0.17], BOTH),
    (BiasDrift, &[0.53, 1.7], BOTH),
    (Lag, &[0.021], AXIS),
    (GainError, &[-0.13], AXIS),
    (ChannelSkew, &[0.017], BOTH),
    (DriveSaturation, &[7.1], AXIS),
    (DriveSaturation, &[9.3, 2.1], AXIS),
    (LoadFriction, &[0.19], AXIS),
    (FrictionFade, &[0.037, 0.061], BOTH),
    (AddedInertia, &[0.29], AXIS),
    (Compliance, &[0.23, 61.0, 0.11], AXIS),
    (EncoderScale, &[0.07], AXIS),
    (EccentricEncoder, &[0.0011, -0.0007, 0.083], AXIS),
];

/// Effects that are named, but leave more than noise where they are stated: with the command's rate
/// its noise is limited too, and what bounces in a gap answers the noise of its joint.
const RATHER_NAMED: &[(Mechanism, &[f64], &[PlantKind])] = &[
    (RateLimit, &[61.0], AXIS),
    (Compliance, &[0.43, 71.0, 0.07, 0.013], AXIS),
];

/// Effects that are not looked for, by a bench without a prediction or at all, but are simulated if
/// they are stated.
const STATED: &[(Mechanism, &[f64], &[PlantKind])] = &[
    (Lag, &[0.021], BENCH),
    (EncoderScale, &[0.07], BENCH),
    (LoadFriction, &[0.017, 2.0], AXIS),
    (EncoderOffset, &[0.31], BOTH),
    (Backlash, &[1.1, 0.011], AXIS),
];

fn rig(plant: PlantKind) -> Rig {
    let (name, effort, parameters) = match plant {
        PlantKind::Axis => (
            "axis",
            "command",
            format!(
                "[parameters]\ninertia = {{ value = {INERTIA}, unit = \"kg\" }}\ncommand_gain = {{ value = 1.0, unit = \"N/N\" }}\n"
            ),
        ),
        PlantKind::Bench => ("bench", "force", String::new()),
    };
    let text = format!(
        "name = \"slide\"\nplant = \"{name}\"\nmotion = \"linear\"\n[channels]\n\
         position = {{ channel = \"x\", unit = \"m\", quantum = {QUANTUM:e} }}\n\
         {effort} = {{ channel = \"f\", unit = \"N\", noise = {EFFORT_NOISE} }}\n{parameters}\
         [[effect]]\nmechanism = \"viscous\"\ncoefficient = {{ value = 7.3, unit = \"N·s/m\" }}\n\
         [[effect]]\nmechanism = \"spring\"\nstiffness = {{ value = 41.7, unit = \"N/m\" }}\n\
         [protocol]\ndrive = \"held\"\n"
    );
    Rig::parse(&text, Path::new("rig.toml")).unwrap()
}

/// The recording of a nominal plant with one more mechanism.
fn recording(plant: PlantKind, left_out: &Effect, seed: u64, count: usize) -> Recording {
    let mut base = match plant {
        PlantKind::Axis => exact_axis(NOMINAL, count, true),
        PlantKind::Bench => exact_bench(NOMINAL, count),
    };
    if plant == PlantKind::Axis {
        // The drive starts gently. After an abrupt start, a mass on a spring is hard to tell from
        // the edge of the drive.
        let times_s = base.motion.iter().map(|now| now.time_s);
        let pairs = base.effort.iter_mut().zip(times_s);
        pairs.for_each(|(effort, time_s)| *effort *= -libm::expm1(-3.0 * time_s));
    }
    let nominal = NOMINAL.iter().map(|(own, values)| Effect::of(*own, values));
    let model = Model {
        inertia: INERTIA,
        described: NOMINAL.len(),
        effects: nominal.chain([left_out.clone()]).collect(),
    };
    let protocol = Protocol {
        start_samples: 0,
        substeps: 8,
        ..Protocol::default()
    };
    let out = output(&model, &base, &protocol);
    let mut run: JointRun = base;
    match plant {
        PlantKind::Axis => run.position = out,
        PlantKind::Bench => {
            run.position = shown(&model.effects, run.position.clone(), run.clock());
            run.effort = out;
        }
    }
    let seen = signals(&run, seed);
    let trace = trace(seen, &[]);
    rig(plant).apply(&trace, Path::new("test")).unwrap()
}

fn names(diagnosis: &Diagnosis<Rig>) -> String {
    let effects = diagnosis.report.effects.iter();
    effects.map(|e| e.mechanism).collect::<Vec<_>>().join(", ")
}

fn seeds() -> u64 {
    let stated = std::env::var("RIGPROOF_SEEDS").ok();
    stated.and_then(|n| n.parse().ok()).unwrap_or(1)
}

type Case = (PlantKind, Effect, u64);

fn cases(of: &[(Mechanism, &[f64], &[PlantKind])]) -> Vec<Case> {
    let each = of.iter().flat_map(|(mechanism, values, plants)| {
        let plants = plants.iter();
        plants.map(|plant| (*plant, Effect::of(*mechanism, values)))
    });
    each.flat_map(|(plant, effect)| {
        (0..seeds()).map(move |seed| (plant, effect.clone(), 71 + 13 * seed))
    })
    .collect()
}

fn options() -> Options {
    Options {
        refit: false,
        next_experiment: false,
        ..Options::default()
    }
}

#[test]
fn a_description_that_states_the_truth_is_obeyed() {
    let wrong = cases(&[LEFT_OUT, STATED].concat())
        .into_par_iter()
        .filter_map(|(plant, effect, seed)| {
            let mut stated = rig(plant);
            stated.effects.push(RigEffect {
                mechanism: effect.mechanism(),
                values: effect.parameters.iter().map(|v| Value::known(*v)).collect(),
                onset: None,
                of_torque: effect.cause.scales == Scales::Torque,
            });
            // Half as many samples leave 1.3 and 1.5 times the noise on a bench with two of the
            // effects.
            let recording = recording(plant, &effect, seed, 2 * COUNT);
            let found = diagnose(&stated, &[&recording], None, &options());
            let told = &found.report;
            (told.verdict != Verdict::Consistent).then(|| {
                format!(
                    "{} {plant:?} {seed}: {} [{}] {:?}",
                    effect.mechanism().name(),
                    told.summary,
                    names(&found),
                    told.floor
                )
            })
        });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn with_its_own_calibration_nothing_is_named_again() {
    let wrong = cases(&[LEFT_OUT, RATHER_NAMED].concat())
        .into_par_iter()
        .filter_map(|(plant, effect, seed)| {
            let recording = recording(plant, &effect, seed, COUNT);
            let first = diagnose(&rig(plant), &[&recording], None, &options());
            let toml = first.calibration.to_toml();
            let read = Rig::parse(&toml, Path::new("calibration.toml"));
            let calibration = match read {
                Ok(calibration) => calibration,
                Err(error) => return Some(format!("{}: {error}", effect.mechanism().name())),
            };
            let again = diagnose(&calibration, &[&recording], None, &options());
            let is_quiet = again.report.effects.is_empty() && again.report.fault.is_none();
            // Something was left out, and the recording is long enough to show it.
            let is_seen = first.report.verdict != Verdict::Consistent;
            (!(is_quiet && is_seen)).then(|| {
                format!(
                    "{} {plant:?} {seed}: {} [{}], then {} [{}]",
                    effect.mechanism().name(),
                    first.report.summary,
                    names(&first),
                    again.report.summary,
                    names(&again)
                )
            })
        });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_no_joint_computes_is_refused_by_name() {
    let effect = |lines: &str| format!("[[effect]]\n{lines}");
    let number = |value: f64, unit: &str| format!("{{ value = {value}, unit = \"{unit}\" }}");
    let gravity = format!(
        "mechanism = \"gravity\"\nx = {0}\ny = {0}\n",
        number(9.81, "m/s²")
    );
    let load = |share| {
        format!(
            "mechanism = \"load_friction\"\nshare = {}\n",
            number(share, "1")
        )
    };
    let gain = format!(
        "mechanism = \"gain_error\"\nfraction = {}\n",
        number(0.1, "1")
    );
    let overshoot = format!(
        "mechanism = \"reversal_overshoot\"\nfraction = {}\ntravel = {}\n",
        number(0.1, "1"),
        number(0.01, "m")
    );
    let exact = [PlantKind::Axis, PlantKind::Bench]
        .map(|plant| recording(plant, &Effect::of(DryOffset, &[1.73]), 71, COUNT));
    let [axis, bench] = exact;
    for (plant, recording, lines, name) in [
        (PlantKind::Axis, &axis, &gravity, "gravity"),
        (PlantKind::Axis, &axis, &load(1.2), "load_friction"),
        (PlantKind::Axis, &axis, &overshoot, "reversal_overshoot"),
        (PlantKind::Bench, &bench, &load(0.2), "load_friction"),
        (PlantKind::Bench, &bench, &gain, "gain_error"),
        (PlantKind::Bench, &bench, &overshoot, "reversal_overshoot"),
    ] {
        let text = rig(plant).to_toml();
        let (head, protocol) = text.split_once("[protocol]").unwrap();
        let text = format!("{head}{}[protocol]{protocol}", effect(lines));
        let stated = Rig::parse(&text, Path::new("rig.toml")).unwrap();
        let found = diagnose(&stated, &[recording], None, &options()).report;
        assert_eq!(found.verdict, Verdict::DataFault, "{}", found.summary);
        assert!(
            found.summary.contains(&format!("`{name}`")),
            "{}",
            found.summary
        );
        assert!(stated.simulated(&stated, recording, 1.0).is_err(), "{name}");
        assert!(rig(plant).replica(&stated, recording).is_err(), "{name}");
    }
}

#[test]
fn a_gain_that_is_not_known_is_not_taken_as_known() {
    let recording = recording(PlantKind::Axis, &Effect::of(DryOffset, &[1.73]), 71, COUNT);
    let mut stated = rig(PlantKind::Axis);
    let parameters = stated.parameters.as_mut().unwrap();
    parameters.command_gain = Value::unknown(1.0);
    let found = diagnose(&stated, &[&recording], None, &options()).report;
    assert_eq!(found.verdict, Verdict::DataFault);
    assert!(
        found.summary.contains("`command_gain`"),
        "{}",
        found.summary
    );
}
