//! This file makes recordings of the five-bar for unit tests: the reference model led by a hand,
//! with encoders, sensor noise, and additional torques.

use super::from_rig::aligned;
use super::run::FiveBarRun;
use crate::plant::Run;
use crate::plants::joint::recorded::Noise;
use crate::problem::{Problem, Rows};
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::linkage::{Pose, inverse};
use rigproof_model::rig::Rig;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_S_PER_RPM;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};
use rigproof_trace::{Channel, Trace};
use std::path::Path;

/// Sample interval, s.
const STEP_S: f64 = 1e-3;
/// Steps of the reference model per sample.
const PARTS: usize = 4;
/// Standard deviation of the force sensor, N.
const FORCE_NOISE: f64 = 0.037;
/// Counts of an encoder per turn.
const COUNTS: f64 = 100_000.0;

/// Joint torques that the model leaves out, N·m, as a function of the pose, the rates of A, E, B,
/// C, and the time.
pub type LeftOut<'a> = &'a dyn Fn(&Pose, [f64; 4], f64) -> [f64; 4];

pub fn nothing(_: &Pose, _: [f64; 4], _: f64) -> [f64; 4] {
    [0.0; 4]
}

/// The description of the recordings below.
pub fn rig(layout: Layout) -> FiveBar {
    let (name, last) = match layout {
        Layout::ThreeBrake => ("three_brake", ""),
        Layout::FourBrake => (
            "four_brake",
            "current_c = { channel = \"ic\", unit = \"A\" }\n",
        ),
    };
    let count_rad = core::f64::consts::TAU / COUNTS;
    let text = format!(
        "name = \"five-bar\"\nplant = \"rig\"\nlayout = \"{name}\"\n[channels]\n\
         theta_a = {{ channel = \"qa\", unit = \"rad\", quantum = {count_rad:e} }}\n\
         theta_b = {{ channel = \"qb\", unit = \"rad\", quantum = {count_rad:e} }}\n\
         force_x = {{ channel = \"fx\", unit = \"N\", noise = {FORCE_NOISE} }}\n\
         force_y = {{ channel = \"fy\", unit = \"N\", noise = {FORCE_NOISE} }}\n\
         current_a = {{ channel = \"ia\", unit = \"A\" }}\n\
         current_e = {{ channel = \"ie\", unit = \"A\" }}\n\
         current_b = {{ channel = \"ib\", unit = \"A\" }}\n{last}[protocol]\ndrive = \"held\"\n"
    );
    FiveBar::parse(&text, Path::new("rig.toml")).unwrap()
}

/// The tip position to which the hand leads, m.
fn goal(time_s: f64) -> [f64; 2] {
    let sine = |rate: f64, phase: f64| libm::sin(rate * time_s + phase);
    [
        0.021 + 0.071 * sine(2.31, 0.3) + 0.037 * sine(5.13, 1.1),
        0.402 + 0.053 * sine(3.07, 2.1) + 0.029 * sine(6.71, 0.7),
    ]
}

/// The current of a brake: off, then a step every 0.9 s, each brake at its own time.
fn current(place: usize, time_s: f64) -> f64 {
    let step = ((time_s + 0.23 * place as f64) / 0.9) as usize;
    [0.0, 0.31, 0.0, 0.17, 0.0, 0.0, 0.43][(step + 3 * place) % 7]
}

/// A recording of `seconds` with joint torques that the model leaves out.
pub fn recording(layout: Layout, seconds: f64, seed: u64, left_out: LeftOut) -> FiveBarRecording {
    let mut own = Rig::new(layout, goal(0.0)).unwrap();
    let arms = own.parameters().arms;
    let mut noise = Noise::new(seed);
    let count = (seconds / STEP_S) as usize;
    let names = ["qa", "qb", "fx", "fy", "ia", "ie", "ib", "ic"];
    let mut columns: [Vec<f64>; 8] = Default::default();
    let braked = |place: usize| layout.brakes().contains(&Joint::ALL[place]);
    for k in 0..count {
        let time_s = k as f64 * STEP_S;
        let hand = |at_s: f64, tip: [f64; 2], speed: [f64; 2]| {
            let to = goal(at_s);
            [0, 1].map(|i| 420.0 * (to[i] - tip[i]) - 11.0 * speed[i])
        };
        let now = hand(time_s, own.tip_m(), own.tip_velocity_m_s());
        let currents = [0, 1, 2, 3].map(|place| {
            if braked(place) {
                current(place, time_s)
            } else {
                0.0
            }
        });
        let counts = own.base_angles_rad().map(|angle| {
            (angle * COUNTS / core::f64::consts::TAU).round() * core::f64::consts::TAU / COUNTS
        });
        let seen = now.map(|f| f + FORCE_NOISE * noise.draw());
        let row = counts.into_iter().chain(seen).chain(currents);
        columns.iter_mut().zip(row).for_each(|(c, x)| c.push(x));
        for part in 0..PARTS {
            // The hand's goal is constant within a part. Its midpoint gives the right mean.
            let middle_s = time_s + (part as f64 + 0.5) * STEP_S / PARTS as f64;
            let force = |tip: [f64; 2], speed: [f64; 2]| {
                let at = hand(middle_s, tip, speed);
                let pose = inverse::pose(&arms, tip).unwrap();
                let j = jacobian(&arms, &pose).unwrap();
                let rates = j * nalgebra::Vector2::from(speed);
                let torques = left_out(&pose, rates.into(), middle_s);
                let extra = j.transpose() * nalgebra::Vector4::from(torques);
                [at[0] + extra.x, at[1] + extra.y]
            };
            own.step_under(&force, currents, STEP_S / PARTS as f64)
                .unwrap();
        }
    }
    let trace = Trace {
        time_s: (0..count).map(|k| k as f64 * STEP_S).collect(),
        channels: names
            .into_iter()
            .zip(columns)
            .map(|(name, samples)| Channel {
                name: name.to_owned(),
                unit: String::new(),
                samples,
            })
            .collect(),
    };
    rig(layout).apply(&trace, Path::new("test")).unwrap()
}

/// A short run with four brakes in which nothing is left out.
pub fn short_run() -> FiveBarRun {
    let recording = recording(Layout::FourBrake, 3.0, 19, &nothing);
    aligned(&rig(Layout::FourBrake), &recording).unwrap()
}

/// Its problem, in windows of 80 ms.
pub fn problem(run: &FiveBarRun) -> Problem<'_> {
    Problem::new(run, run.windows_of(0.080))
}

/// A target with given rows.
pub fn target(problem: &Problem, raw: Vec<f64>) -> Rows {
    Rows {
        prior_deviation: f64::INFINITY,
        signal: Vec::new(),
        white: problem.whitener.whiten(&raw),
        raw,
    }
}

/// Rows of noise, 0.9 times the sensors' noise.
pub fn noise_rows(problem: &Problem, seed: u64) -> Vec<f64> {
    let mut noise = Noise::new(seed);
    let rows = problem.windows.usable.iter();
    rows.map(|_| 0.9 * problem.floor * noise.draw()).collect()
}

/// The drag that the thesis measured and left out (§3.3.2), N·m·s/rad.
pub const DRAG: f64 = 0.0082 / RAD_S_PER_RPM;
