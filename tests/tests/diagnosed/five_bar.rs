//! This file runs the golden cases of the rig, on the implementation and on the reference, and records them.

use core::f64::consts::TAU;

use rigproof_impl::plant::{Outcome, Parameters, Plant};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_model::linkage::inverse;
use rigproof_model::rig::Rig;
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::diagnosed::bench::stronger;
use crate::diagnosed::laws::law;
use crate::diagnosed::recording::{Noise, Recording, counted};
use crate::diagnosed::script::Script;

/// Counts of the finer of the thesis's two encoders in a turn (§5.3.1).
const COUNTS: u32 = 1_000_000;
/// Standard deviation of the force sensor, N.
const FORCE_NOISE_N: f64 = 0.037;
/// For how long a locked brake has had its current before the tip is let go, in samples.
const LOCKED_SAMPLES: usize = 1000;

/// What happened, a sample a tick.
#[derive(Clone, Default)]
pub struct Run {
    /// θA and θB at the start of the tick, rad.
    pub theta_rad: Vec<[f64; 2]>,
    /// The force over the tick, N.
    pub forces_n: Vec<[f64; 2]>,
    /// The currents over the tick, A.
    pub currents_a: Vec<[f64; 4]>,
}

const CASES: [&str; 4] = [
    "path_three_brake",
    "path_four_brake",
    "release_three_brake",
    "release_four_brake",
];

/// Every run of every case on the implementation, case by case.
pub fn cases() -> impl Iterator<Item = (&'static str, Vec<Recording>)> {
    CASES.into_iter().map(|case| {
        let script = Script::of(case);
        let runs = script.runs().map(|run| on_implementation(&script, run).0);
        (case, runs.collect())
    })
}

/// Every run of every case by itself: on the implementation, and on the reference under the same forces and currents.
pub fn recordings() -> Vec<Recording> {
    let mut recordings = Vec::new();
    for case in CASES {
        let script = Script::of(case);
        for run in script.runs() {
            let (own, seen) = on_implementation(&script, run);
            let reference = on_rig(&script, run, &seen);
            let name = format!("{case}-{run}-reference");
            recordings.extend([own, recorded(&name, script.layout(), &reference)]);
        }
    }
    recordings
}

fn on_implementation(script: &Script, run: usize) -> (Recording, Run) {
    let layout = script.layout();
    let seen = on_plant(script, run, &Parameters::of(layout));
    let name = format!("{}-{run}-impl", script.case);
    (recorded(&name, layout, &seen), seen)
}

fn start_m(script: &Script, run: usize) -> [f64; 2] {
    if is_path(script) {
        [
            script.number(run, "line from x, where the tip starts at rest"),
            script.number(run, "line from y"),
        ]
    } else {
        [script.first(run, "start_x"), script.first(run, "start_y")]
    }
}

fn is_path(script: &Script) -> bool {
    script.case.starts_with("path")
}

/// A run on the implementation: its tick, if there is a controller, and its plant.
pub fn on_plant(script: &Script, run: usize, parameters: &Parameters) -> Run {
    let pose = inverse::pose(&arms(script.layout()), start_m(script, run)).unwrap();
    let theta_rad = [pose.theta_a_rad, pose.theta_b_rad];
    let plant = Plant::new(parameters, theta_rad, [0.0; 2], &[]).unwrap();
    if is_path(script) {
        steered(script, run, plant)
    } else {
        released(script, run, plant)
    }
}

/// A hand's forces, each held for a while, and a controller.
fn steered(script: &Script, run: usize, mut plant: Plant) -> Run {
    let (times_s, x, y) = (
        script.numbers(run, "time"),
        script.numbers(run, "force_x"),
        script.numbers(run, "force_y"),
    );
    let settings = Settings {
        counts_per_turn: [COUNTS; 2],
        ..Settings::thesis(script.layout())
    };
    let mut tick = Tick::new(&settings, law(script, run)).unwrap();
    let mut seen = Run::default();
    for row in 1..times_s.len() {
        let force_n = [x[row - 1], y[row - 1]];
        while (seen.theta_rad.len() as f64 + 0.5) * SAMPLE_STEP_S < times_s[row] {
            let theta_rad = plant.base_angles_rad();
            let count = |angle: f64| libm::round(angle / TAU * f64::from(COUNTS)) as i32;
            let command = tick.tick(&Sensed {
                number: seen.theta_rad.len() as u32,
                counts: theta_rad.map(count),
                tip_force_n: force_n.into(),
            });
            seen.step(&mut plant, force_n, command.currents_a.map(f64::from));
        }
    }
    seen
}

/// A spring of constant force, and a brake that is locked.
fn released(script: &Script, run: usize, mut plant: Plant) -> Run {
    let one = |column| script.first(run, column);
    let [to_x, to_y] = [one("cylinder_x"), one("cylinder_y")];
    let currents_a = ["current_a", "current_e", "current_b", "current_c"].map(one);
    let samples = libm::round(script.end_s(run) / SAMPLE_STEP_S) as usize;
    let mut seen = Run::default();
    for _ in 0..LOCKED_SAMPLES {
        seen.step(&mut plant, [0.0; 2], currents_a);
    }
    for _ in 0..samples {
        // The pull in the middle of the step, as far as it is foreseen.
        let tip_m = plant.tip_m() + plant.tip_velocity_m_s() * (0.5 * SAMPLE_STEP_S);
        let to = [to_x - tip_m.x, to_y - tip_m.y];
        let away_m = libm::hypot(to[0], to[1]);
        let force_n = to.map(|part| part / away_m * one("spring_force"));
        seen.step(&mut plant, force_n, currents_a);
    }
    seen
}

impl Run {
    fn step(&mut self, plant: &mut Plant, force_n: [f64; 2], currents_a: [f64; 4]) {
        self.theta_rad.push(plant.base_angles_rad());
        self.forces_n.push(force_n);
        self.currents_a.push(currents_a);
        assert_eq!(
            plant.step(force_n, currents_a, SAMPLE_STEP_S),
            Outcome::Moved
        );
    }
}

/// The reference under the forces and currents of a run.
pub fn on_rig(script: &Script, run: usize, given: &Run) -> Run {
    let mut rig = Rig::new(script.layout(), start_m(script, run)).unwrap();
    let mut seen = given.clone();
    for (k, theta_rad) in seen.theta_rad.iter_mut().enumerate() {
        *theta_rad = rig.base_angles_rad();
        rig.step(given.forces_n[k], given.currents_a[k], SAMPLE_STEP_S)
            .unwrap();
    }
    seen
}

/// The recording of a run: counts, forces with noise, currents.
pub fn recorded(name: &str, layout: Layout, run: &Run) -> Recording {
    let count_rad = TAU / f64::from(COUNTS);
    let mut noise = Noise::new(
        name.bytes()
            .fold(4127, |seed, b| seed * 31 % 1_000_003 + u64::from(b)),
    );
    let theta = |i: usize| counted(run.theta_rad.iter().map(|theta| theta[i]), count_rad);
    // At the instant of a sample a force that jumps there is at the middle of its jump.
    let mut force = |i: usize| {
        let before = run.forces_n.iter().take(1).chain(&run.forces_n);
        let pairs = before.zip(&run.forces_n);
        noise.on(pairs.map(|(b, f)| 0.5 * (b[i] + f[i])), FORCE_NOISE_N)
    };
    let mut columns = vec![
        ("qa", "rad", theta(0)),
        ("qb", "rad", theta(1)),
        ("fx", "N", force(0)),
        ("fy", "N", force(1)),
    ];
    let braked = layout.brakes();
    let mut channels = String::new();
    for (i, (joint, name)) in rigproof_spec::joint::Joint::ALL
        .into_iter()
        .zip(["ia", "ie", "ib", "ic"])
        .enumerate()
        .filter(|(_, (joint, _))| braked.contains(joint))
    {
        columns.push((name, "A", run.currents_a.iter().map(|now| now[i]).collect()));
        let letter = joint.letter().to_lowercase();
        channels += &format!("current_{letter} = {{ channel = \"{name}\", unit = \"A\" }}\n");
    }
    let layout = match layout {
        Layout::ThreeBrake => "three_brake",
        Layout::FourBrake => "four_brake",
    };
    let rig = format!(
        "name = \"{name}\"\nplant = \"rig\"\nlayout = \"{layout}\"\n[channels]\n\
         theta_a = {{ channel = \"qa\", unit = \"rad\", quantum = {count_rad:e} }}\n\
         theta_b = {{ channel = \"qb\", unit = \"rad\", quantum = {count_rad:e} }}\n\
         force_x = {{ channel = \"fx\", unit = \"N\", noise = {FORCE_NOISE_N} }}\n\
         force_y = {{ channel = \"fy\", unit = \"N\", noise = {FORCE_NOISE_N} }}\n\
         {channels}[protocol]\ndrive = \"held\"\n"
    );
    Recording::new(name.to_owned(), rig, SAMPLE_STEP_S, columns)
}

/// A case, a run of it, and the place of a brake that works in it.
const STRONGER: [(&str, usize, usize); 2] = [("path_three_brake", 9, 1), ("path_four_brake", 8, 1)];

/// Path runs of an implementation of which one brake has a greater gain than its table's.
pub fn with_gain(gain: f64) -> Vec<Recording> {
    let one = |(case, run, place): (&str, usize, usize)| {
        let script = Script::of(case);
        let layout = script.layout();
        let mut parameters = Parameters::of(layout);
        let table = &mut parameters.brakes[place];
        *table = table.map(|table| stronger(&table, gain));
        let seen = on_plant(&script, run, &parameters);
        recorded(&format!("{case}-{run}-gain"), layout, &seen)
    };
    STRONGER.into_iter().map(one).collect()
}
