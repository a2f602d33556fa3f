//! This file runs the five-bar through a recording and keeps what happened: the truth and what the sensors see.

use super::FINE_STEPS;
use super::linkage::{Pair, plus};
use super::plant::FiveBar;
use super::setup::{RATE_HZ, Setup};
use crate::effect::{At, Effect};
use crate::form::Form;
use rigproof_spec::geometry::angle_ranges;
use std::f64::consts::TAU;

/// The rig at one sample.
#[derive(Clone, Debug)]
pub struct Sample {
    pub theta: Pair,
    pub rates: Pair,
    pub acceleration: Pair,
    /// Which joints stick.
    pub stuck: [bool; 4],
    /// Whether a joint sticks, slides or turns round just then.
    pub changes: bool,
    /// Force of the hand, N, as the sensor has it, without noise.
    pub shown_force_n: Pair,
    pub currents_a: [f64; 4],
    pub nominal_yields_nm: [f64; 4],
    /// What each hidden effect resists with along θA and θB, N·m; nothing for those that only the equations show.
    pub hidden_nm: Vec<Pair>,
}

/// A handle on a spring between sensor and tip.
struct Handle {
    mass: f64,
    stiffness: f64,
    damping: f64,
    at_m: Pair,
    velocity: Pair,
}

/// Damping ratio of the handle.
const HANDLE_DAMPING: f64 = 0.08;

/// Runs the rig with its hidden effects, `FINE_STEPS` to a sample; `None` where the hand
/// takes it out of the ranges of its angles (table 4.2), whose stops the plant does not have.
pub fn run(setup: &Setup, hidden: &[Effect]) -> Option<Vec<Sample>> {
    let step_s = 1.0 / (RATE_HZ * FINE_STEPS as f64);
    let count = (setup.duration_s * RATE_HZ) as usize;
    let mut rig = FiveBar::new(setup.layout, setup.start, hidden)?;
    let ranges = angle_ranges(setup.layout);
    let mut drive = setup.drive.clone();
    let mut handle = Handle::of(hidden, rig.pose.tip_m);
    // Force of the hand at the middle of every fine step.
    let mut forces: Vec<Pair> = Vec::with_capacity(count * FINE_STEPS);
    let mut samples: Vec<Sample> = Vec::with_capacity(count);
    for k in 0..count {
        let sample_s = k as f64 / RATE_HZ;
        if !rig.pose.is_within(&ranges, rig.theta) {
            return None;
        }
        let seen = quantised(setup, shown_theta(setup, hidden, rig.theta));
        let currents_a = drive.currents_a(&rig.arms, sample_s, seen, 1.0 / RATE_HZ);
        let [fx, fy] = forces.last().copied().unwrap_or_default();
        let mut hidden_nm = vec![[0.0; 2]; hidden.len()];
        rig.hidden_nm(sample_s, fx.hypot(fy), &mut hidden_nm);
        samples.push(Sample {
            theta: rig.theta,
            rates: rig.rates,
            acceleration: rig.acceleration,
            stuck: rig.stuck(),
            changes: false,
            shown_force_n: [0.0; 2],
            currents_a,
            nominal_yields_nm: rig.nominal_yields_nm(),
            hidden_nm,
        });
        let signs = rig.signs;
        for fine in 0..FINE_STEPS {
            let time_s = sample_s + fine as f64 * step_s;
            let hand_n = push(setup, &mut rig, &mut handle, time_s, step_s, currents_a)?;
            forces.push(hand_n);
            if fine == 0
                && let Some(sample) = samples.last_mut()
            {
                // The acceleration of the sample's instant is between those of the steps that meet there.
                sample.acceleration =
                    plus(sample.acceleration, 1.0, rig.acceleration).map(|x| 0.5 * x);
                sample.changes = signs != rig.signs;
            }
        }
    }
    for (k, sample) in samples.iter_mut().enumerate() {
        let time_s = k as f64 / RATE_HZ;
        sample.shown_force_n = shown_force(hidden, time_s, |time_s| {
            between(&forces, time_s / step_s - 0.5)
        });
    }
    Some(samples)
}

/// One fine step; returns the hand's force at its middle, N.
fn push(
    setup: &Setup,
    rig: &mut FiveBar,
    handle: &mut Option<Handle>,
    time_s: f64,
    step_s: f64,
    currents_a: [f64; 4],
) -> Option<Pair> {
    let mut hand_n = None;
    let mut spring_n = [0.0; 2];
    rig.step(
        time_s,
        step_s,
        currents_a,
        &mut |time_s, tip_m, velocity| {
            let (at_m, hand_velocity) = match &*handle {
                None => (tip_m, velocity),
                Some(handle) => (handle.at_m, handle.velocity),
            };
            let force_n = setup.hand.force_n(time_s, at_m, hand_velocity);
            hand_n.get_or_insert(force_n);
            match &*handle {
                None => force_n,
                Some(handle) => {
                    spring_n = handle.spring_n(tip_m, velocity);
                    spring_n
                }
            }
        },
    )?;
    let hand_n = hand_n.unwrap_or_default();
    if let Some(handle) = handle {
        handle.step(step_s, plus(hand_n, -1.0, spring_n));
    }
    Some(hand_n)
}

/// A value between its neighbours; the first and the last one hold beyond the ends.
fn between(values: &[Pair], place: f64) -> Pair {
    let place = place.clamp(0.0, values.len().saturating_sub(1) as f64);
    let get = |k: f64| {
        values
            .get(k as usize)
            .or(values.last())
            .copied()
            .unwrap_or_default()
    };
    let (before, after) = (get(place.floor()), get(place.floor() + 1.0));
    plus(before, place.fract(), plus(after, -1.0, before))
}

/// What the force channels show at a time, without noise.
fn shown_force(hidden: &[Effect], time_s: f64, at: impl Fn(f64) -> Pair) -> Pair {
    let acting = || hidden.iter().filter(|effect| effect.acts(time_s));
    let delay_s: f64 = acting()
        .map(|effect| match (effect.form, effect.values) {
            (Form::Skew, [delay, ..]) => delay,
            (Form::VaryingSkew, [delay, period, ..]) => {
                delay * (1.0 - libm::cos(TAU * time_s / period))
            }
            _ => 0.0,
        })
        .sum();
    acting().fold(at(time_s - delay_s), |force, effect| {
        match (effect.form, effect.values) {
            (Form::ForceGain, [fraction, ..]) => {
                let [x, y] = force;
                match effect.at {
                    At::Sensor(0) => [x * (1.0 + fraction), y],
                    At::Sensor(_) => [x, y * (1.0 + fraction)],
                    _ => force.map(|x| x * (1.0 + fraction)),
                }
            }
            (Form::Crosstalk, [share, ..]) => {
                let [x, y] = force;
                match effect.at {
                    At::Sensor(0) => [x + share * y, y],
                    _ => [x, y + share * x],
                }
            }
            (Form::ForceBias, [x, y, ..]) => plus(force, 1.0, [x, y]),
            // A sensor that is turned to the left sees a force turned to the right.
            (Form::ForceRotation, [angle, ..]) => {
                let (s, c) = libm::sincos(angle);
                let [x, y] = force;
                [c * x + s * y, c * y - s * x]
            }
            _ => force,
        }
    })
}

/// What the encoders show of θA and θB, rad, before they count.
pub fn shown_theta(setup: &Setup, hidden: &[Effect], theta: Pair) -> Pair {
    use rigproof_spec::joint::Joint;
    let show = |joint: Joint, angle: f64, start: f64| {
        let here = hidden.iter().filter(|effect| effect.at == At::Joint(joint));
        here.fold(angle, |angle, effect| match effect.form {
            Form::EncoderScale => start + (1.0 + effect.first()) * (angle - start),
            Form::EncoderOffset => angle + effect.first(),
            Form::Eccentric => {
                let [amplitude, phase, ..] = effect.values;
                angle + amplitude * (libm::sin(angle + phase) - libm::sin(start + phase))
            }
            _ => angle,
        })
    };
    let ([a, b], [start_a, start_b]) = (theta, setup.start);
    [show(Joint::A, a, start_a), show(Joint::B, b, start_b)]
}

/// Rounded to the nearest count.
pub fn quantised(setup: &Setup, theta: Pair) -> Pair {
    theta.map(|x| (x / setup.quantum_rad()).round() * setup.quantum_rad())
}

impl Handle {
    fn of(hidden: &[Effect], at_m: Pair) -> Option<Handle> {
        hidden
            .iter()
            .find_map(|effect| match (effect.form, effect.values) {
                (Form::Compliance, [mass, frequency_hz, ..]) => {
                    let omega = TAU * frequency_hz;
                    Some(Handle {
                        mass,
                        stiffness: mass * omega * omega,
                        damping: 2.0 * HANDLE_DAMPING * mass * omega,
                        at_m,
                        velocity: [0.0; 2],
                    })
                }
                _ => None,
            })
    }

    /// The spring's force on the tip, N.
    fn spring_n(&self, tip_m: Pair, tip_velocity: Pair) -> Pair {
        let stretch = plus(self.at_m, -1.0, tip_m).map(|x| x * self.stiffness);
        plus(
            stretch,
            self.damping,
            plus(self.velocity, -1.0, tip_velocity),
        )
    }

    /// Moves the handle under what is left of the hand's force, N.
    fn step(&mut self, step_s: f64, net_n: Pair) {
        self.velocity = plus(self.velocity, step_s / self.mass, net_n);
        self.at_m = plus(self.at_m, step_s, self.velocity);
    }
}
