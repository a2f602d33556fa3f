//! This file hides one thing before, in or behind the gear of a joint, and asks where the diagnosis says it is.

use core::f64::consts::TAU;
use std::path::Path;

use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rayon::prelude::*;
use rigproof_diagnose::report::{Report, Verdict};
use rigproof_diagnose::{Options, diagnose};
use rigproof_trace::Trace;
use rigproof_trace::rig::chain::ChainRig;
use rigproof_trace::series::Channel;

const EXAMPLE: &str = include_str!("../../rigs/elastic-joint.toml");
const URDF: &str = include_str!("../../rigs/elastic-joint.urdf");
const STEP_S: f64 = 1e-3;
const STEPS_A_SAMPLE: usize = 8;
const COUNT: usize = 14_000;
// The numbers that the example states.
const MASS_KG: f64 = 3.2;
const ARM_M: f64 = 0.28;
const ABOUT_CENTRE: f64 = 0.31;
const STIFFNESS: f64 = 9000.0;
const ROTOR: f64 = 0.4;
const RATIO: f64 = 100.0;
const GRAVITY: f64 = 9.806_65;
/// Speed about which friction changes its sense, rad/s.
const TURNS: f64 = 2e-3;

/// The joint as it is.
#[derive(Clone, Copy, Debug)]
struct Joint {
    /// Coulomb friction of motor and link, N·m.
    dry: [f64; 2],
    /// Viscous friction of motor, gear and link, N·m·s/rad.
    viscous: [f64; 3],
    stiffness: f64,
    gap: f64,
    rotor: f64,
    /// What the torque sensor shows of 1 N·m.
    sensor: f64,
    /// What the link's encoder shows at 0, rad.
    zero: f64,
}

/// As described.
const TRUE: Joint = Joint {
    dry: [0.0; 2],
    viscous: [0.0; 3],
    stiffness: STIFFNESS,
    gap: 0.0,
    rotor: ROTOR,
    sensor: 1.0,
    zero: 0.0,
};

/// Positions and speeds of motor and link.
type State = [f64; 4];

impl Joint {
    fn passes(&self, [motor, motor_speed, link, link_speed]: State) -> f64 {
        let (twist, rate) = (motor - link, motor_speed - link_speed);
        let most = 0.5 * self.gap;
        let [_, damping, _] = self.viscous;
        let touches = if twist.abs() < most { 0.0 } else { 1.0 };
        self.stiffness * (twist - twist.clamp(-most, most)) + touches * damping * rate
    }

    fn rate(&self, state: State, time_s: f64) -> State {
        let [_, motor_speed, link, link_speed] = state;
        let [dry_motor, dry_link] = self.dry;
        let [viscous_motor, _, viscous_link] = self.viscous;
        let passes = self.passes(state);
        let lost =
            |dry: f64, viscous: f64, speed: f64| dry * libm::tanh(speed / TURNS) + viscous * speed;
        let weight = MASS_KG * GRAVITY * ARM_M * libm::sin(link);
        let inertia = ABOUT_CENTRE + MASS_KG * ARM_M * ARM_M;
        [
            motor_speed,
            (driven(state, time_s) - passes - lost(dry_motor, viscous_motor, motor_speed))
                / self.rotor,
            link_speed,
            (passes - weight - lost(dry_link, viscous_link, link_speed)) / inertia,
        ]
    }

    fn after_step(&self, state: State, time_s: f64, step_s: f64) -> State {
        let moved = |by: State, step_s: f64| core::array::from_fn(|k| state[k] + step_s * by[k]);
        let half = 0.5 * step_s;
        let first = self.rate(state, time_s);
        let second = self.rate(moved(first, half), time_s + half);
        let third = self.rate(moved(second, half), time_s + half);
        let fourth = self.rate(moved(third, step_s), time_s + step_s);
        let mean =
            core::array::from_fn(|k| (first[k] + 2.0 * (second[k] + third[k]) + fourth[k]) / 6.0);
        moved(mean, step_s)
    }

    fn recorded(&self) -> Trace {
        let mut random = Pcg64Mcg::seed_from_u64(71);
        let mut noise = |deviation: f64| Normal::new(0.0, deviation).unwrap().sample(&mut random);
        let ([start, speed], mut rows) = (wanted(0.0), Vec::new());
        let mut state = [start, speed, start, speed];
        for sample in 0..COUNT {
            let time_s = sample as f64 * STEP_S;
            let [motor, _, link, _] = state;
            let counted = |value: f64, quantum: f64| (value / quantum).round() * quantum;
            rows.push([
                counted(link + self.zero, 2e-5),
                driven(state, time_s) + noise(0.05),
                counted(RATIO * motor, 5e-4),
                self.sensor * self.passes(state) + noise(0.03),
            ]);
            for step in 0..STEPS_A_SAMPLE {
                let step_s = STEP_S / STEPS_A_SAMPLE as f64;
                state = self.after_step(state, time_s + step as f64 * step_s, step_s);
            }
        }
        let units = [
            ("q", "rad"),
            ("tau", "N·m"),
            ("theta", "rad"),
            ("tau_s", "N·m"),
        ];
        let channels = units
            .into_iter()
            .enumerate()
            .map(|(k, (name, unit))| Channel {
                name: name.to_owned(),
                unit: unit.to_owned(),
                samples: rows.iter().map(|row| row[k]).collect(),
            });
        Trace {
            time_s: (0..COUNT).map(|k| k as f64 * STEP_S).collect(),
            channels: channels.collect(),
        }
    }
}

/// Wanted position and speed of the motor.
fn wanted(time_s: f64) -> [f64; 2] {
    let sines = [(0.5, 0.23, 0.4), (0.35, 0.61, 2.1), (0.25, 1.17, 4.4)];
    let each = sines.map(|(high, hz, phase)| {
        let (sine, cosine) = libm::sincos(TAU * hz * time_s + phase);
        [high * sine, high * TAU * hz * cosine]
    });
    each.into_iter()
        .fold([0.0; 2], |[q, v], [own, its]| [q + own, v + its])
}

/// The motor's torque: a proportional and derivative controller with the weight fed forward.
fn driven([motor, speed, ..]: State, time_s: f64) -> f64 {
    let [position, wanted_speed] = wanted(time_s);
    let weight = MASS_KG * GRAVITY * ARM_M * libm::sin(motor);
    130.0 * (position - motor) + 15.0 * (wanted_speed - speed) + weight
}

/// What is recorded beside the link's position and the motor's torque.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Beside {
    Encoder,
    Sensor,
    Both,
}

use Beside::{Both, Encoder, Sensor};

fn diagnosed(joint: &Joint, beside: Beside) -> Report {
    told(joint, beside, &|text| text)
}

/// The report on a joint whose description was changed.
fn told(joint: &Joint, beside: Beside, change: &dyn Fn(String) -> String) -> Report {
    let keeps = |line: &&str| match beside {
        Beside::Encoder => !line.starts_with("torque"),
        Beside::Sensor => !line.starts_with("motor"),
        Beside::Both => true,
    };
    let text: Vec<&str> = EXAMPLE.lines().filter(keeps).collect();
    let inside = format!("urdf = '''\n{URDF}'''");
    let text = text
        .join("\n")
        .replace("urdf = \"elastic-joint.urdf\"", &inside);
    let rig = ChainRig::parse(&change(text), Path::new("elastic.toml")).unwrap();
    let recording = rig
        .taken(joint.recorded(), Path::new("elastic.csv"))
        .unwrap();
    diagnose(&rig, &[&recording], None, &Options::default()).report
}

/// Hides something, with one number each, beside what is recorded; says whether its one name is the expected one.
fn is_named(joint: Joint, beside: Beside, (mechanism, place): (&str, &str), number: f64) {
    let report = diagnosed(&joint, beside);
    println!("{mechanism} at {place}, {beside:?}: {}", report.summary);
    let named = report.effects.iter().filter(|own| own.status == "named");
    let named: Vec<_> = named.map(|own| (own.mechanism, own.joint)).collect();
    let summary = &report.summary;
    assert_eq!(named, [(mechanism, Some(place))], "{beside:?}: {summary}");
    // Of a backlash its gap, of everything else the one number.
    let mut numbers = report.effects[0].parameters.values();
    let found = numbers.next().unwrap().value;
    let off = (found / number - 1.0).abs();
    assert!(off < 0.02, "{mechanism} at {place}: {found}");
}

#[test]
fn friction_is_named_on_its_side_of_the_gear() {
    let dry = |dry| Joint { dry, ..TRUE };
    let viscous = |viscous| Joint { viscous, ..TRUE };
    let dry_at = |place| ("dry_offset", place);
    let viscous_at = |place| ("viscous", place);
    [
        (dry([1.1, 0.0]), Encoder, dry_at("elbow.motor"), 1.1),
        (dry([1.1, 0.0]), Sensor, dry_at("elbow.motor"), 1.1),
        (dry([0.0, 0.9]), Encoder, dry_at("elbow"), 0.9),
        (dry([0.0, 0.9]), Both, dry_at("elbow"), 0.9),
        (
            viscous([1.4, 0.0, 0.0]),
            Sensor,
            viscous_at("elbow.motor"),
            1.4,
        ),
        (
            viscous([0.0, 40.0, 0.0]),
            Both,
            viscous_at("elbow.transmission"),
            40.0,
        ),
        (viscous([0.0, 0.0, 1.2]), Encoder, viscous_at("elbow"), 1.2),
    ]
    .into_par_iter()
    .for_each(|(joint, beside, name, number)| is_named(joint, beside, name, number));
}

#[test]
fn what_a_gear_its_motor_and_its_sensors_lack_is_named() {
    let gap = Joint { gap: 0.003, ..TRUE };
    let soft = Joint {
        stiffness: 0.7 * STIFFNESS,
        ..TRUE
    };
    let rotor = Joint {
        rotor: 1.3 * ROTOR,
        ..TRUE
    };
    let sensor = Joint {
        sensor: 1.0 / 0.95,
        ..TRUE
    };
    let zero = Joint {
        zero: 0.001,
        ..TRUE
    };
    let gear = "elbow.transmission";
    let softer = -0.3 * STIFFNESS;
    [
        (soft, Encoder, ("transmission_stiffness", gear), softer),
        (gap, Encoder, ("transmission_backlash", gear), 0.003),
        (
            rotor,
            Encoder,
            ("added_inertia", "elbow.motor"),
            0.3 * ROTOR,
        ),
        (sensor, Both, ("gain_error", "elbow.torque"), -0.05),
        (zero, Encoder, ("encoder_offset", gear), -0.001),
    ]
    .into_par_iter()
    .for_each(|(joint, beside, name, number)| is_named(joint, beside, name, number));
}

#[test]
fn a_joint_that_is_as_described_lacks_nothing_whatever_is_recorded_of_it() {
    for beside in [Encoder, Sensor, Both] {
        let report = diagnosed(&TRUE, beside);
        assert_eq!(
            report.verdict,
            Verdict::Consistent,
            "{beside:?}: {}",
            report.summary
        );
    }
}

/// Friction on both sides of a soft gear, four numbers at once.
#[test]
fn friction_on_both_sides_of_a_soft_gear_is_told_apart() {
    let joint = Joint {
        dry: [1.1, 0.6],
        stiffness: 0.8 * STIFFNESS,
        ..TRUE
    };
    let report = diagnosed(&joint, Beside::Encoder);
    let mut named: Vec<_> = report
        .effects
        .iter()
        .map(|own| (own.mechanism, own.joint))
        .collect();
    named.sort_unstable();
    let expected = [
        ("dry_offset", Some("elbow")),
        ("dry_offset", Some("elbow.motor")),
        ("transmission_stiffness", Some("elbow.transmission")),
    ];
    assert_eq!(named, expected, "{}", report.summary);
}

#[test]
fn a_forgotten_gear_ratio_or_sign_is_a_fault_that_says_so() {
    for (other, times) in [("scale = 1", "99.9"), ("scale = 0.01, sign = -1", "-0.99")] {
        let change = |text: String| text.replace("scale = 0.01", other);
        let report = told(&TRUE, Encoder, &change);
        let reason = report.fault.unwrap().reason;
        let said = format!("moves {times}");
        assert!(reason.contains(&said), "{reason}");
    }
}
