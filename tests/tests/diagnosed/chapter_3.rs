//! This file is the experiments of §3.3 and §3.5 on one brake, one after another in one recording: current steps, speed ramps, sinusoids of
//! speed, slow cycles of the current. What the thesis says that its model leaves out is planted at the sizes it states.

use core::f64::consts::{PI, TAU};

use rigproof_model::brake::Brake;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::brake_table;
use rigproof_spec::units::{RAD_S_PER_RPM, rad_s_from_rpm};

use crate::diagnosed::recording::{Noise, Recording, STEP_S, Turned};

/// Standard deviation of the torquemeter, N·m: the thesis does not say.
const TORQUE_NOISE_NM: f64 = 0.019;

/// §3.3.2: 0.0082 N·m/rpm.
pub const DRAG: f64 = 0.0082 / RAD_S_PER_RPM;
/// §3.5, figure 3.16: just over 1 N·m more than expected at 1 A after the speed changes sign.
pub const OVERSHOOT_NM: f64 = 1.07;
/// Travel within which it decays, rad: lost with the figure.
pub const OVERSHOOT_TRAVEL: f64 = 0.13;
/// Figure 3.17: the loop is lost with the figure; a play of this half width that this share of the current goes through opens it by 0.3 N·m
/// each way at the slope of table 3.2.
pub const PLAY_A: f64 = 0.157;
pub const PLAY_SHARE: f64 = 0.3;
/// §3.4.1: standard deviation of the steady torque from trial to trial at the greatest current, N·m.
pub const SCATTER_NM: f64 = 0.4;

/// The overshoot as a share of the torque.
pub fn overshoot(joint: Joint) -> f64 {
    OVERSHOOT_NM / brake_table(joint).greatest_nm()
}

/// What is planted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Planted {
    pub drag: bool,
    pub overshoot: bool,
    pub play: bool,
    pub scatter: bool,
}

impl Planted {
    fn words(self) -> String {
        let all = [
            (self.drag, "-drag"),
            (self.overshoot, "-overshoot"),
            (self.play, "-play"),
            (self.scatter, "-scatter"),
        ];
        let own = all.into_iter().filter(|(is_planted, _)| *is_planted);
        own.map(|(_, word)| word).collect()
    }
}

/// One sample of the experiments: current, A, speed, rad/s, and the trial that it belongs to.
struct Sample {
    current_a: f64,
    speed_rad_s: f64,
    trial: usize,
}

/// The experiments; `all` takes the whole matrix of §3.4, else a part of every kind.
fn experiments(all: bool) -> Vec<Sample> {
    let mut samples = Vec::new();
    let mut trial = 0;
    let mut run = |seconds: f64, current_a: &dyn Fn(f64) -> f64, speed_rpm: &dyn Fn(f64) -> f64| {
        let count = libm::round(seconds / STEP_S) as usize;
        samples.extend((0..count).map(|k| {
            let time_s = (k as f64 + 0.5) * STEP_S;
            Sample {
                current_a: current_a(time_s),
                speed_rad_s: rad_s_from_rpm(speed_rpm(time_s)),
                trial,
            }
        }));
        trial += 1;
    };
    // The current is off between two experiments.
    let after_a_pause =
        |current_a: f64| move |time_s: f64| if time_s < 0.1 { 0.0 } else { current_a };
    let (speeds_rpm, currents_a): (&[f64], &[f64]) = if all {
        (
            &[0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0],
            &[0.2, 0.4, 0.6, 0.8, 1.0],
        )
    } else {
        (&[0.5, 4.0, 32.0], &[0.2, 0.6, 1.0])
    };
    // The brake is turned without current first, so that what it remembers of the time before is gone.
    run(3.0, &|_| 0.0, &|_| 10.0);
    // §3.3.1 and §3.4: three steps of the current at each speed.
    for &speed_rpm in speeds_rpm {
        for &current_a in currents_a {
            for _ in 0..3 {
                let step = |time_s| if time_s < 0.2 { 0.0 } else { current_a };
                run(0.55, &step, &|_| speed_rpm);
            }
        }
    }
    // §3.3.2: the speed goes from 0 to 60 rpm, the current stays.
    for current_a in if all {
        &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0][..]
    } else {
        &[0.0, 0.4, 0.8][..]
    } {
        let speed_rpm = |time_s: f64| f64::min(20.0 * time_s, 60.0 * (4.0 - time_s));
        run(4.0, &after_a_pause(*current_a), &speed_rpm);
    }
    // §3.3.3: sinusoids of speed.
    for current_a in [0.5, 1.0] {
        for (hertz, periods) in [(0.25, if all { 3.0 } else { 1.0 }), (1.0, 4.0)] {
            let speed_rpm = |time_s: f64| 10.0 * libm::sin(TAU * hertz * time_s);
            run(periods / hertz, &after_a_pause(current_a), &speed_rpm);
        }
    }
    // §3.5, figure 3.17: the current goes up and down, the speed stays.
    for (hertz, periods) in [(0.1, 1.0), (0.2, 2.0)] {
        let current_a = |time_s: f64| 0.5 - 0.5 * libm::cos(2.0 * PI * hertz * time_s);
        run(periods / hertz, &current_a, &|_| 10.0);
    }
    samples
}

/// A recording of the experiments on a brake of the reference model with something planted.
pub fn recording(joint: Joint, planted: Planted, all: bool, seed: u64) -> Recording {
    let samples = experiments(all);
    let mut noise = Noise::new(seed);
    let greatest_nm = brake_table(joint).greatest_nm();
    let trials = samples.last().map_or(0, |last| last.trial + 1);
    let shares = noise.on(vec![0.0; trials], SCATTER_NM / greatest_nm);
    let mut theta_rad = 0.29;
    let mut brake = Brake::new(joint, theta_rad);
    let mut play_a = samples[0].current_a;
    // What is left of the overshoot since the sense last changed.
    let (mut last_sense, mut left) = (0.0, 1.0);
    let mut run = Turned::default();
    for Sample {
        current_a,
        speed_rad_s,
        trial,
    } in samples
    {
        theta_rad += speed_rad_s * STEP_S;
        let sense = speed_rad_s.signum();
        let kept = libm::exp(-(speed_rad_s * STEP_S).abs() / OVERSHOOT_TRAVEL);
        left = if sense == last_sense { left } else { 1.0 } * kept;
        last_sense = sense;
        play_a = play_a.clamp(current_a - PLAY_A, current_a + PLAY_A);
        let share = if planted.play { PLAY_SHARE } else { 0.0 };
        let held_a = current_a + share * (play_a - current_a);
        let mut torque_nm = brake.step(held_a, theta_rad, speed_rad_s, STEP_S);
        let mut share = 0.0;
        if planted.overshoot {
            share += OVERSHOOT_NM / greatest_nm * left;
        }
        if planted.scatter {
            share += shares[trial];
        }
        torque_nm += torque_nm * share;
        if planted.drag {
            torque_nm += DRAG * speed_rad_s;
        }
        run.angles_rad.push(theta_rad);
        run.currents_a.push(current_a);
        run.torques_nm.push(torque_nm);
    }
    let name = format!("chapter-3-{}{}", joint.letter(), planted.words());
    Recording::of_bench(name, joint, run, noise, TORQUE_NOISE_NM)
}
