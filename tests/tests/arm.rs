//! This file holds the diagnosis of a serial arm against a recording of a real one; where it is absent it says so and passes over itself.

use rigproof_blind::{Plant as Made, make};
use rigproof_diagnose::plant::{Described, SimulatedOutput};
use rigproof_diagnose::report::Verdict;
use rigproof_diagnose::{Diagnosis, Options, diagnose};
use rigproof_model::chain::{Chain, Kind};
use rigproof_trace::Trace;
use rigproof_trace::rig::chain::{ChainRig, ModelFormat};
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    let near = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    std::env::var_os("RIGPROOF_DATA").map_or_else(near, PathBuf::from)
}

/// What may be left of each joint's effort on the second half, N·m.
const LEFT: [f64; 7] = [0.18, 0.25, 0.18, 0.19, 0.08, 0.06, 0.07];

#[test]
fn a_panda_lacks_friction_at_its_joints_and_masses_of_its_links() {
    let (urdf, recording) = (
        folder().join("panda/panda.urdf"),
        folder().join("panda/exciting_trajectory_1.csv"),
    );
    if !urdf.exists() || !recording.exists() {
        println!("passed over: panda is not here (docs/recordings.md says where to get it)");
        return;
    }
    let mut text = format!(
        "name = \"panda\"\nplant = \"chain\"\nurdf = {:?}\ntip = \"panda_link8\"\n",
        urdf.display().to_string()
    );
    for joint in 1..=7 {
        write!(
            text,
            "[[joint]]\nname = \"panda_joint{joint}\"\n\
             position = {{ channel = \"q{joint}\", unit = \"rad\" }}\n\
             effort = {{ channel = \"tau{joint}\", unit = \"N·m\" }}\n"
        )
        .unwrap();
    }
    let rig = ChainRig::parse(&text, Path::new("panda.toml")).unwrap();
    let (recording, ..) = rig
        .read_text(&recording, &rigproof_trace::csv::Hints::default())
        .unwrap();
    let options = Options {
        hold_out_share: 0.5,
        ..Options::default()
    };
    let report = diagnose(&rig, &[&recording], None, &options).report;
    for (joint, most) in (1..).zip(LEFT) {
        let name = format!("panda_joint{joint}");
        let mut joints = report.arm.iter().flat_map(|arm| &arm.joints);
        let left = joints.find(|own| own.joint == name).unwrap().after;
        println!("joint {joint}: {left} N·m of at most {most}");
        assert!(left <= most, "joint {joint}: {left} N·m");
    }
    let arm = report.arm.as_ref().unwrap();
    let shares: f64 = arm.joints.iter().map(|own| own.share).sum();
    assert!((shares - 1.0).abs() < 1e-9 && arm.part == "held_out");
    // Base, seven joints, flange; the shoulder's height as the maker states it.
    assert!(arm.line_m.len() == 9 && (arm.line_m[2][2] - 0.333).abs() < 1e-9);
    assert!(arm.joints.iter().all(|own| own.after < own.before));
    let named = |mechanisms: &[&str], joint: &str| {
        let mut own = report.effects.iter();
        own.any(|own| {
            let is_here = own.joint == Some(joint) && own.status == "named";
            is_here && mechanisms.contains(&own.mechanism)
        })
    };
    let joints: Vec<String> = (1..=7).map(|joint| format!("panda_joint{joint}")).collect();
    // What would be viscous friction beside a sharp sign is friction that bends (decision 0309).
    for joint in &joints {
        assert!(named(&["dry_offset", "presliding"], joint), "{joint}");
    }
    assert!(joints.iter().any(|joint| named(&["presliding"], joint)));
    assert!(joints.iter().any(|joint| named(&["link_inertia"], joint)));
}

/// A made arm with what is hidden, its recording and its description.
fn made(seed: u64) -> (ChainRig, Trace) {
    let case = make(Made::Chain, seed, None).unwrap();
    let rig = ChainRig::parse(&case.rig_toml, Path::new("case.toml")).unwrap();
    (rig, case.trace)
}

fn whole(rig: &ChainRig, trace: &Trace) -> Diagnosis<ChainRig> {
    let recording = rig.apply(trace, Path::new("case.csv")).unwrap();
    let options = Options {
        hold_out_share: 0.0,
        next_experiment: false,
        ..Options::default()
    };
    diagnose(rig, &[&recording], None, &options)
}

#[test]
fn an_arm_described_wrongly_says_so_in_one_line() {
    let (rig, trace) = made(14);
    let fault = |rig: &ChainRig| {
        let fault = whole(rig, &trace).report.fault.unwrap();
        assert!(!fault.reason.contains('\n'), "{}", fault.reason);
        fault.reason
    };
    let mut other = rig.clone();
    other.joints[0].name = "jiont1".to_owned();
    let said = fault(&other);
    assert!(
        said.contains("`jiont1` is no moving joint") && said.contains("joint1"),
        "{said}"
    );
    let mut fewer = rig.clone();
    fewer.joints.pop();
    let said = fault(&fewer);
    assert!(said.contains("has no `[[joint]]`"), "{said}");
    // Degrees that are said to be radians.
    let mut degrees = trace.clone();
    for channel in degrees.channels.iter_mut().filter(|own| own.unit == "rad") {
        channel.samples.iter_mut().for_each(|q| *q = q.to_degrees());
    }
    let said = whole(&rig, &degrees).report.fault.unwrap().reason;
    assert!(said.contains("are these degrees?"), "{said}");
}

/// The efforts of the calibrated arm lie much nearer to the recorded ones than those of the described arm.
#[test]
fn a_calibrated_arm_simulates_what_was_recorded() {
    // Coulomb friction at every joint; a rotor and a delay.
    for seed in [25, 19] {
        let (rig, trace) = made(seed);
        let recording = rig.apply(&trace, Path::new("case.csv")).unwrap();
        let calibration = whole(&rig, &trace).calibration;
        let outputs = |model: &ChainRig| rig.simulated(model, &recording, 1.0).unwrap().outputs;
        let (before, after) = (outputs(&rig), outputs(&calibration));
        assert_eq!(after.len(), rig.joints.len());
        for ((joint, before), after) in rig.joints.iter().zip(before).zip(after) {
            assert_eq!(after.name, format!("effort_{}", joint.name));
            let (before, after) = (median_left(&before), median_left(&after));
            println!("{seed} {}: {before} → {after}", joint.name);
            assert!(after < 0.25 * before, "{seed} {}: {after}", joint.name);
        }
    }
}

/// Springs, ripple, drag by a power of the speed, friction by the load and friction that bends are named at their joint, and the calibrated arm simulates them.
#[test]
fn what_else_a_joint_of_an_arm_lacks_is_named_and_simulated() {
    for (seed, name, joint) in [
        (24, "presliding", "joint1"),
        (40, "spring", "joint2"),
        (45, "load_friction", "joint2"),
        (128, "ripple", "joint2"),
        (78, "velocity_power", "joint2"),
    ] {
        let (rig, trace) = made(seed);
        let recording = rig.apply(&trace, Path::new("case.csv")).unwrap();
        let found = whole(&rig, &trace);
        let mut effects = found.report.effects.iter();
        assert!(
            effects.any(|own| own.mechanism == name && own.joint == Some(joint)),
            "{seed}: {}",
            found.report.summary
        );
        let [before, after] = [&rig, &found.calibration].map(|model| {
            let outputs = rig.simulated(model, &recording, 1.0).unwrap().outputs;
            median_left(
                outputs
                    .iter()
                    .find(|own| own.name.ends_with(joint))
                    .unwrap(),
            )
        });
        println!("{seed} {name} at {joint}: {before} → {after}");
        assert!(after < 0.25 * before, "{seed}: {after}");
    }
}

/// The middle of what a simulation leaves over, as a standard deviation. At a reversal friction jumps between samples.
fn median_left(own: &SimulatedOutput) -> f64 {
    let pairs = own.recorded.as_ref().unwrap().iter().zip(&own.simulated);
    let mut off: Vec<f64> = pairs.map(|(a, b)| (a - b).abs()).collect();
    off.sort_by(f64::total_cmp);
    off[off.len() / 2] / 0.6745
}

/// The same arm in MJCF: a body a joint with all that is fixed to it, and one at the tip.
fn as_mjcf(rig: &ChainRig) -> ChainRig {
    let arm = Chain::from_urdf(&rig.model, rig.tip.as_deref()).unwrap();
    let words = |own: &[f64]| own.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut text = "<mujoco><compiler angle=\"radian\"/><worldbody>\n".to_owned();
    for joint in &arm.joints {
        let (own, i) = (&joint.inertial, joint.inertial.central());
        let moments = [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
        writeln!(
            text,
            "<body name=\"{}\" pos=\"{}\" xyaxes=\"{}\"><joint name=\"{}\" type=\"{}\" axis=\"{}\" \
             damping=\"{}\" frictionloss=\"{}\"/><inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
            joint.link,
            words(joint.origin.as_slice()),
            words(joint.rotation.columns(0, 2).as_slice()),
            joint.name,
            if joint.kind == Kind::Revolute { "hinge" } else { "slide" },
            words(joint.axis.as_slice()),
            joint.damping,
            joint.friction,
            words(own.centre().as_slice()),
            own.mass,
            words(&moments),
        )
        .unwrap();
    }
    let ends = "</body>".repeat(arm.joints.len());
    let tip = words(arm.tip.as_slice());
    write!(
        text,
        "<body name=\"the tip\" pos=\"{tip}\"/>{ends}</worldbody></mujoco>"
    )
    .unwrap();
    ChainRig {
        format: ModelFormat::Mjcf,
        model: text,
        tip: Some("the tip".to_owned()),
        ..rig.clone()
    }
}

/// The model that is written back needs no more than what its table lists.
fn lacks_nothing(rig: &ChainRig, trace: &Trace, [model, table]: [&str; 2]) -> Vec<String> {
    let found = whole(rig, trace);
    let files = found.calibration.beside();
    let text = |name: &str| files.iter().find(|(own, _)| *own == name).map(|own| &own.1);
    let mut again = rig.clone();
    again.model = text(model).unwrap().clone();
    assert_ne!(again.model, rig.model);
    let report = whole(&again, trace).report;
    let kinds: Vec<&str> = report.effects.iter().map(|own| own.mechanism).collect();
    println!("{}: {:?} {kinds:?}", rig.name, report.verdict);
    match text(table) {
        None => assert_eq!(report.verdict, Verdict::Consistent, "{kinds:?}"),
        Some(left) => assert!(
            kinds.iter().all(|own| left.contains(own)),
            "{kinds:?}\n{left}"
        ),
    }
    let left = text(table).into_iter().flat_map(|own| own.lines().skip(1));
    let left = left.filter_map(|own| own.split(',').nth(1));
    let mut left: Vec<String> = left.map(str::to_owned).collect();
    left.dedup();
    left
}

#[test]
fn an_arm_with_its_calibrated_urdf_lacks_nothing() {
    // Coulomb friction at every joint and viscous friction at one; a payload beside a peak, which no URDF holds.
    for (seed, table) in [(25, false), (22, true)] {
        let (rig, trace) = made(seed);
        let left = lacks_nothing(&rig, &trace, ["calibrated.urdf", "not-in-urdf.csv"]);
        assert_eq!(!left.is_empty(), table, "{seed}: {left:?}");
    }
}

#[test]
fn an_arm_with_its_calibrated_mjcf_lacks_nothing_and_its_rotor_is_written() {
    // Coulomb friction; a payload beside a peak, which no MJCF holds; a rotor beside a delay.
    for (seed, table) in [(25, &[][..]), (22, &["stribeck"]), (19, &["channel_skew"])] {
        let (rig, trace) = made(seed);
        let rig = as_mjcf(&rig);
        let left = lacks_nothing(&rig, &trace, ["calibrated.xml", "not-in-mjcf.csv"]);
        assert_eq!(left, table, "{seed}");
    }
}

/// What begins during a recording, or has no number in a model, is in the table and not in the file.
#[test]
fn what_a_model_cannot_hold_stands_in_a_table() {
    let (rig, _) = made(25);
    let effects = "[[effect]]\nmechanism = \"viscous\"\njoint = \"joint1\"\n\
         onset = { value = 3.1, unit = \"s\" }\n\
         coefficient = { value = 0.7, unit = \"N·m·s/rad\" }\n\
         [[effect]]\nmechanism = \"constant_bias\"\njoint = \"joint2\"\n\
         level = { value = -0.31, unit = \"N·m\" }\n";
    for (rig, table) in [
        (rig.clone(), "not-in-urdf.csv"),
        (as_mjcf(&rig), "not-in-mjcf.csv"),
    ] {
        let text = rig.to_toml() + effects;
        let rig = ChainRig::parse(&text, Path::new("case.toml")).unwrap();
        let files = rig.beside();
        let [(name, lacks)] = &files[..] else {
            panic!("{files:?}");
        };
        assert_eq!(*name, table);
        let rows: Vec<&str> = lacks.lines().collect();
        let has = |row: &str, words: [&str; 2]| words.iter().all(|own| row.contains(own));
        assert_eq!(rows.len(), 3, "{lacks}");
        assert!(
            has(
                rows[1],
                ["constant_bias,level,-0.31,N·m", "no constant effort"]
            ),
            "{lacks}"
        );
        assert!(
            has(rows[2], ["viscous,coefficient,0.7,", "begins during"]),
            "{lacks}"
        );
    }
}

/// The equations hang on the arm, not on the format that describes it.
#[test]
fn an_arm_in_mjcf_gets_the_diagnosis_that_it_gets_in_a_urdf() {
    let (rig, trace) = made(19);
    let [one, other] = [&rig, &as_mjcf(&rig)].map(|rig| whole(rig, &trace).calibration.effects);
    assert!(!one.is_empty());
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(&other) {
        assert_eq!(
            (&one.joint, one.effect.mechanism),
            (&other.joint, other.effect.mechanism)
        );
        for (one, other) in one.effect.values.iter().zip(&other.effect.values) {
            let off = (one.value - other.value).abs();
            assert!(
                off < 1e-6 * one.value.abs(),
                "{} {}",
                one.value,
                other.value
            );
        }
    }
}

/// The samples of a made recording in a share of its time, on a clock of its own.
fn cut(trace: &Trace, [from, to]: [f64; 2]) -> Trace {
    let all = trace.len() as f64;
    let range = (from * all) as usize..(to * all) as usize;
    let mut part = trace.clone();
    let start_s = part.time_s[range.start];
    part.time_s = part.time_s[range.clone()]
        .iter()
        .map(|t| t - start_s)
        .collect();
    for channel in &mut part.channels {
        channel.samples = channel.samples[range.clone()].to_vec();
    }
    part
}

/// Two recordings show what one of them and their sum show, and a third says how well.
#[test]
fn several_recordings_of_an_arm_are_diagnosed_together() {
    let (rig, trace) = made(25);
    let alone = whole(&rig, &trace).calibration;
    let parts = [[0.0, 0.41], [0.41, 0.73], [0.73, 1.0]].map(|share| cut(&trace, share));
    let parts = parts.map(|own| rig.apply(&own, Path::new("case.csv")).unwrap());
    let [one, two, three] = &parts;
    let options = Options {
        next_experiment: false,
        ..Options::default()
    };
    let found = diagnose(&rig, &[one, two], Some(three), &options);
    assert!(found.report.fault.is_none(), "{:?}", found.report.fault);
    let names = |rig: &ChainRig| -> Vec<(String, &'static str)> {
        let each = rig.effects.iter();
        let each = each.map(|own| (own.joint.clone(), own.effect.mechanism.name()));
        let mut all: Vec<_> = each.collect();
        all.sort();
        all
    };
    assert_eq!(names(&found.calibration), names(&alone));
    let fit = found.report.fit.unwrap();
    let held_out = fit.held_out.unwrap();
    println!("{} → {} {}", held_out.before, held_out.after, fit.unit);
    assert!(held_out.after < 0.5 * held_out.before);
    // A recording at another rate is refused by its place.
    let mut other = three.clone();
    other.time_s.iter_mut().for_each(|t| *t *= 2.0);
    let fault = diagnose(&rig, &[one, &other], None, &options)
        .report
        .fault
        .unwrap();
    assert!(fault.reason.contains("at one rate"), "{}", fault.reason);
}
