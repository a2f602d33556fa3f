//! This file claims that friction under load is named on a bench whose load is simulated, and that
//! its calibration leaves nothing.

use super::recorded::{EFFORT_NOISE, NOMINAL, QUANTUM, exact_bench, signals, trace};
use crate::plant::Run;
use crate::report::Verdict;
use crate::{Options, diagnose};
use rigproof_trace::rig::{Recording, Rig};
use std::path::Path;

fn rig() -> Rig {
    let text = format!(
        "name = \"slide\"\nplant = \"bench\"\nmotion = \"linear\"\n[channels]\n\
         position = {{ channel = \"x\", unit = \"m\", quantum = {QUANTUM:e} }}\n\
         force = {{ channel = \"f\", unit = \"N\", noise = {EFFORT_NOISE} }}\n\
         simulated = {{ channel = \"load\", unit = \"N\" }}\n\
         [[effect]]\nmechanism = \"viscous\"\ncoefficient = {{ value = 7.3, unit = \"N·s/m\" }}\n\
         [[effect]]\nmechanism = \"spring\"\nstiffness = {{ value = 41.7, unit = \"N/m\" }}\n\
         [protocol]\ndrive = \"held\"\n"
    );
    Rig::parse(&text, Path::new("rig.toml")).unwrap()
}

/// A slide that carries a load, of which a share is friction.
fn recorded(share: f64) -> Recording {
    let mut run = exact_bench(NOMINAL, 9000);
    let load = |time_s: f64| 3.1 + 2.3 * libm::sin(0.71 * time_s + 0.4);
    let loads: Vec<f64> = run.motion.iter().map(|now| load(now.time_s)).collect();
    for ((effort, now), load) in run.effort.iter_mut().zip(&run.motion).zip(&loads) {
        *effort += load * (1.0 + share * now.sense);
    }
    assert_eq!(run.clock().samples, loads.len());
    let seen = signals(&run, 67);
    let trace = trace(seen, &[("load", loads)]);
    rig().apply(&trace, Path::new("test")).unwrap()
}

#[test]
fn friction_under_a_simulated_load_is_named_and_calibrated() {
    let options = Options {
        refit: false,
        next_experiment: false,
        ..Options::default()
    };
    for (share, names) in [(0.0, &[][..]), (0.23, &["load_friction"])] {
        let recording = recorded(share);
        let found = diagnose(&rig(), &[&recording], None, &options);
        let named: Vec<_> = found.report.effects.iter().map(|e| e.mechanism).collect();
        assert_eq!(named, names, "{}", found.report.summary);
        let toml = found.calibration.to_toml();
        let calibration = Rig::parse(&toml, Path::new("calibration.toml")).unwrap();
        let again = diagnose(&calibration, &[&recording], None, &options).report;
        assert_eq!(again.verdict, Verdict::Consistent, "{}", again.summary);
        if let Some(effect) = found.report.effects.first() {
            let number = &effect.parameters["share"];
            assert!((number.value / share - 1.0).abs() < 0.02, "{number:?}");
        }
    }
}
