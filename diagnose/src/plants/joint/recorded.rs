//! This file makes recordings for unit tests, from the reference model at a fine step, with known
//! noise.

use super::align::Signals;
use super::inertia::Inertia;
use crate::plants::joint::run::{JointRun, PlantKind};
use crate::sensor::normal;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rigproof_model::axis::{Axis, Transmission};
use rigproof_model::bench::resistance;
use rigproof_model::effects::{Instant, law};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_trace::{Channel, Trace};

pub type Laws<'a> = &'a [(Mechanism, &'a [f64])];

/// Sample interval, s.
pub const STEP_S: f64 = 1.1e-3;
/// Mass of the axis, kg.
pub const INERTIA: f64 = 1.37;
/// Resolution of the axis's position, m.
pub const QUANTUM: f64 = 1.3e-6;
/// Standard deviation of the bench's metered force, N.
pub const EFFORT_NOISE: f64 = 0.043;
/// The nominal physics of the axis.
pub const NOMINAL: Laws = &[(Mechanism::Viscous, &[7.3]), (Mechanism::Spring, &[41.7])];
/// Steps of the reference model per sample.
const FINE: usize = 8;

/// Seeded noise of standard deviation 1, close to Gaussian.
pub struct Noise(Pcg64Mcg);

impl Noise {
    pub fn new(seed: u64) -> Noise {
        Noise(Pcg64Mcg::seed_from_u64(seed))
    }

    pub fn draw(&mut self) -> f64 {
        normal(&mut self.0)
    }
}

/// The force that drives the axis, N.
pub fn drive(time_s: f64) -> f64 {
    6.3 * libm::sin(2.33 * time_s)
        + 5.1 * libm::sin(5.2 * time_s + 1.2)
        + 2.7 * libm::sin(11.9 * time_s + 0.4)
}

/// A slide as it is written down, in m and N: position `x`, effort `f` and what stands beside them.
pub fn trace(seen: Signals, beside: &[(&str, Vec<f64>)]) -> Trace {
    let channel = |name: &str, unit: &str, samples| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples,
    };
    let own = [
        channel("x", "m", seen.position),
        channel("f", "N", seen.effort),
    ];
    let beside = beside.iter();
    let beside = beside.map(|(name, samples)| channel(name, "N", samples.clone()));
    Trace {
        time_s: seen.time_s,
        channels: own.into_iter().chain(beside).collect(),
    }
}

/// A recording of an axis without sensor noise. The drive is held between samples if `held`, smooth
/// otherwise.
pub fn exact_axis(laws: Laws, count: usize, held: bool) -> JointRun {
    exact_axis_with(laws, Transmission::default(), count, held)
}

/// The same with a transmission.
pub fn exact_axis_with(
    laws: Laws,
    transmission: Transmission,
    count: usize,
    held: bool,
) -> JointRun {
    let axis = Axis {
        inertia: INERTIA,
        laws: laws.iter().map(|(m, p)| law(*m, p).unwrap()).collect(),
        transmission,
    };
    let mut state = axis.state(0.0, 0.013, 0.0);
    let (mut motion, mut effort) = (Vec::new(), Vec::new());
    let fine_s = STEP_S / FINE as f64;
    for k in 0..count {
        let time_s = k as f64 * STEP_S;
        motion.push(Instant {
            time_s,
            position: state.position,
            speed: state.speed,
            sense: if state.speed == 0.0 {
                0.0
            } else {
                state.speed.signum()
            },
        });
        effort.push(drive(time_s));
        for j in 0..FINE {
            let now = |j: usize| {
                if held {
                    drive(time_s)
                } else {
                    drive(time_s + j as f64 * fine_s)
                }
            };
            axis.step(&mut state, now(j), now(j + 1), fine_s);
        }
    }
    run(PlantKind::Axis, motion, effort, held)
}

/// A recording of a bench under imposed motion, without sensor noise.
pub fn exact_bench(laws: Laws, count: usize) -> JointRun {
    let fine_s = STEP_S / FINE as f64;
    let fine: Vec<Instant> = (0..count * FINE)
        .map(|k| {
            let t = k as f64 * fine_s;
            let speed = 0.61 * 2.7 * libm::cos(2.7 * t) + 0.23 * 10.7 * libm::cos(10.7 * t + 0.6);
            Instant {
                time_s: t,
                position: 0.61 * libm::sin(2.7 * t) + 0.23 * libm::sin(10.7 * t + 0.6),
                speed,
                sense: speed.signum(),
            }
        })
        .collect();
    let laws: Vec<_> = laws.iter().map(|(m, p)| law(*m, p).unwrap()).collect();
    let effort = resistance(&laws, &fine, fine_s);
    let motion = fine.iter().step_by(FINE).copied().collect();
    let effort = effort.into_iter().step_by(FINE).collect();
    run(PlantKind::Bench, motion, effort, false)
}

fn run(plant: PlantKind, motion: Vec<Instant>, effort: Vec<f64>, held: bool) -> JointRun {
    JointRun {
        described: Vec::new(),
        plant,
        kind: Motion::Linear,
        inertia: match plant {
            PlantKind::Axis => Inertia::Known(INERTIA),
            PlantKind::Bench => Inertia::None,
        },
        step_s: STEP_S,
        start_s: 0.0,
        held,
        rows: None,
        position: motion.iter().map(|now| now.position).collect(),
        recorded: vec![true; motion.len()],
        untold_speed: vec![1e-4; motion.len()],
        motion,
        effort,
        predicted: None,
        current: None,
        law: None,
        position_noise: QUANTUM / 12f64.sqrt(),
        effort_noise: EFFORT_NOISE,
        speed_floor: 1e-4,
        metered_by: Vec::new(),
        servo: None,
        parts: Vec::new(),
        remarks: Vec::new(),
    }
}

/// The exact run as sensors record it: position quantised, effort noisy.
pub fn signals(run: &JointRun, seed: u64) -> Signals {
    let mut noise = Noise::new(seed);
    Signals {
        plant: run.plant,
        kind: run.kind,
        time_s: run.motion.iter().map(|now| now.time_s).collect(),
        position: run
            .position
            .iter()
            .map(|x| QUANTUM * (x / QUANTUM).round())
            .collect(),
        effort: run
            .effort
            .iter()
            .map(|e| e + EFFORT_NOISE * noise.draw())
            .collect(),
        goal: None,
        predicted: None,
        current: None,
        held: run.held,
        position_quantum: Some(QUANTUM),
        position_noise: None,
        effort_noise: Some(EFFORT_NOISE),
        effort_limit: None,
    }
}
