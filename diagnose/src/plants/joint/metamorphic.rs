//! This file claims that the diagnosis does not depend on units, signs, order and offsets in which
//! a recording is written.

use super::recorded::{EFFORT_NOISE, NOMINAL, QUANTUM, exact_axis, signals};
use crate::report::{Number, Report};
use crate::{Options, diagnose};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::Rig;
use std::path::Path;

/// One way to write a recording.
#[derive(Clone, Copy)]
struct Written {
    /// Unit of the position, and the number of units in a metre.
    position: (&'static str, f64),
    /// Unit of the command, and the number of units in a newton.
    command: (&'static str, f64),
    /// Sign of the position's column and of the command's.
    signs: [f64; 2],
    /// The whole seconds of the first stamp, and the decimals of all stamps.
    stamps: (u64, usize),
    /// Whether the columns stand in reverse order.
    backwards: bool,
    /// Every n-th sample is written.
    every: usize,
    /// What the position's column counts from, m.
    from_m: f64,
}

const PLAIN: Written = Written {
    position: ("m", 1.0),
    command: ("N", 1.0),
    signs: [1.0; 2],
    stamps: (0, 9),
    backwards: false,
    every: 1,
    from_m: 0.0,
};

fn rig(written: &Written) -> Rig {
    let ((position, per_m), (command, per_n)) = (written.position, written.command);
    let [position_sign, command_sign] = written.signs;
    let text = format!(
        "name = \"slide\"\nplant = \"axis\"\nmotion = \"linear\"\n[channels]\n\
         position = {{ channel = \"x\", unit = \"{position}\", quantum = {:e}, sign = {position_sign} }}\n\
         command = {{ channel = \"f\", unit = \"{command}\", noise = {:e}, sign = {command_sign} }}\n\
         [parameters]\ninertia = {{ value = 1.29, unit = \"kg\", status = \"unknown\" }}\n\
         command_gain = {{ value = 1.0, unit = \"N/N\" }}\n\
         [[effect]]\nmechanism = \"viscous\"\ncoefficient = {{ value = 6.1, unit = \"N·s/m\", status = \"unknown\" }}\n\
         [[effect]]\nmechanism = \"spring\"\nstiffness = {{ value = 39.0, unit = \"N/m\", status = \"unknown\" }}\n\
         [protocol]\ndrive = \"straight\"\n",
        QUANTUM * per_m,
        EFFORT_NOISE * per_n,
    );
    Rig::parse(&text, Path::new("rig.toml")).unwrap()
}

/// The report of a slide with Coulomb friction that its description lacks.
fn told(written: &Written, name: &str) -> Report {
    told_by(&rig(written), written, name)
}

/// Writes a recording of the slide to a file, reads it back and diagnoses it by a description.
fn told_by(rig: &Rig, written: &Written, name: &str) -> Report {
    let laws = [NOMINAL, &[(Mechanism::DryOffset, &[1.73])]].concat();
    let seen = signals(&exact_axis(&laws, 7_000, false), 53);
    let [position_sign, command_sign] = written.signs;
    let (start_s, decimals) = written.stamps;
    let mut text = match written.backwards {
        true => "f,x,t\n".to_owned(),
        false => "t,x,f\n".to_owned(),
    };
    let samples = seen.time_s.iter().zip(&seen.position).zip(&seen.effort);
    for ((time_s, x), f) in samples.step_by(written.every) {
        let whole = start_s + *time_s as u64;
        let rest = format!("{:.decimals$}", time_s - time_s.floor());
        let stamp = match rest.strip_prefix("0") {
            Some(rest) => format!("{whole}{rest}"),
            None => format!("{}{}", whole + 1, &rest[1..]),
        };
        let x = position_sign * (x - written.from_m) * written.position.1;
        let f = command_sign * f * written.command.1;
        text += &match written.backwards {
            true => format!("{f:e},{x:e},{stamp}\n"),
            false => format!("{stamp},{x:e},{f:e}\n"),
        };
    }
    let own = format!("rigproof-written-{}-{name}.csv", std::process::id());
    let file = std::env::temp_dir().join(own);
    std::fs::write(&file, text).unwrap();
    let recording = rig.read_recording(&file);
    std::fs::remove_file(&file).unwrap();
    let options = Options {
        refit: false,
        next_experiment: false,
        ..Options::default()
    };
    diagnose(rig, &[&recording.unwrap()], None, &options).report
}

/// The names in a report, and all parameters of found and nominal effects.
fn said(report: &Report) -> (Vec<&'static str>, Vec<(String, f64)>) {
    let names = report.effects.iter().map(|own| own.mechanism).collect();
    let of_effects = report.effects.iter().flat_map(|own| {
        let numbers = own.parameters.iter();
        numbers.map(|(name, number)| (name.clone(), number.value))
    });
    let nominal = report.nominal.iter();
    let of_nominal = nominal.map(|(name, number)| (name.clone(), number.value));
    (names, of_effects.chain(of_nominal).collect())
}

/// Asserts the same names, and parameters that differ by at most a share.
fn assert_same(plain: &Report, other: &Report, share: f64, how: &str) {
    let ((names, numbers), (others, other_numbers)) = (said(plain), said(other));
    assert_eq!(names, others, "{how}: {}", other.summary);
    assert_eq!(plain.verdict, other.verdict, "{how}: {}", other.summary);
    for ((name, number), (_, other)) in numbers.iter().zip(&other_numbers) {
        let off = (other / number - 1.0).abs();
        assert!(off <= share, "{how}: {name} is {other}, {number} before");
    }
}

/// Ways to write one recording, each with the share by which a parameter may change. Rounding of
/// samples changes the last digits.
fn ways() -> [(&'static str, f64, Written); 8] {
    [
        (
            "units",
            1e-6,
            Written {
                position: ("mm", 1e3),
                command: ("kN", 1e-3),
                ..PLAIN
            },
        ),
        (
            "order of columns",
            0.0,
            Written {
                backwards: true,
                ..PLAIN
            },
        ),
        (
            "both signs",
            1e-9,
            Written {
                signs: [-1.0; 2],
                ..PLAIN
            },
        ),
        (
            "one sign",
            1e-9,
            Written {
                signs: [1.0, -1.0],
                ..PLAIN
            },
        ),
        (
            "stamps since 1970",
            1e-6,
            Written {
                stamps: (1_700_000_000, 9),
                ..PLAIN
            },
        ),
        (
            "stamps since 1970 to the microsecond",
            1e-6,
            Written {
                stamps: (1_700_000_000, 6),
                ..PLAIN
            },
        ),
        (
            "stamps of four decimals",
            1e-6,
            Written {
                stamps: (0, 4),
                ..PLAIN
            },
        ),
        (
            "stamps of three decimals",
            1e-4,
            Written {
                stamps: (0, 3),
                ..PLAIN
            },
        ),
    ]
}

#[test]
fn names_and_numbers_do_not_change_with_the_way_a_recording_is_written() {
    let plain = told(&PLAIN, "plain");
    assert_eq!(said(&plain).0, ["dry_offset"], "{}", plain.summary);
    for (how, share, written) in ways() {
        assert_same(&plain, &told(&written, &how.replace(' ', "_")), share, how);
    }
    // Half of the samples give the same result with less certainty.
    let halved = told(&Written { every: 2, ..PLAIN }, "halved");
    assert_same(&plain, &halved, 0.02, "every second sample");
}

#[test]
fn names_and_numbers_do_not_change_with_the_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| told(&PLAIN, &format!("threads-{threads}")))
    };
    assert_same(&with(1), &with(3), 0.0, "three threads");
}

#[test]
fn the_interval_of_a_spring_does_not_depend_on_where_positions_count_from() {
    let from_m = 3.1;
    let moved = Written { from_m, ..PLAIN };
    let [here, there] = [("from-0", PLAIN), ("from-3", moved)].map(|(name, written)| {
        let mut rig = rig(&written);
        rig.effects.retain(|own| own.mechanism != Mechanism::Spring);
        let report = told_by(&rig, &written, name);
        let mut effects = report.effects.into_iter();
        effects
            .find(|own| own.mechanism == "spring")
            .unwrap()
            .parameters
    });
    let half = |own: &Number| 0.5 * (own.high95.unwrap() - own.low95.unwrap());
    let [near, far] = [&here, &there].map(|own| &own["stiffness"]);
    // The effective number of blocks behind an interval is by the energy of the column.
    let wider = half(far) / half(near) - 1.0;
    let off = far.value / near.value - 1.0;
    assert!(
        off.abs() < 1e-5 && wider.abs() < 0.2,
        "{near:?} and {far:?}"
    );
    let rest_m = [&here, &there].map(|own| own["rest"].value);
    assert!((rest_m[0] - rest_m[1] - from_m).abs() < 1e-5, "{rest_m:?}");
}
