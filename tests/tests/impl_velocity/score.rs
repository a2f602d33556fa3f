//! This file says how far an estimator of velocity is from the truth.

use std::f64::consts::TAU;
use std::fmt;

use crate::impl_velocity::candidates::{Candidate, Estimator};
use crate::impl_velocity::motions::{Motion, SAMPLE_S, Sample};

/// Samples at the start of a motion that are not scored.
const WARM_UP: usize = 80;
/// Samples into a rest from which an estimate must be zero.
const SETTLED: usize = 50;
/// Largest delay that is looked for, samples.
const LONGEST_DELAY: usize = 31;

/// How far an estimator is from the truth.
#[derive(Clone, Debug)]
pub struct Score {
    /// Root mean square error of the base joints' rates, rad/s.
    pub rms: f64,
    /// Greatest error, rad/s.
    pub worst: f64,
    /// Shift of the truth that fits best, ms.
    delay_ms: f64,
    /// Share of the samples of a turning joint (A, E, B, C) whose estimate turns the other way.
    pub wrong_sign: f64,
    /// Share of the samples well into a rest whose estimate is not zero, and how many there were.
    pub restless: f64,
    pub resting: f64,
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "rms {:.5} worst {:.3} rad/s, delay {:.1} ms, wrong sign {:.2} %, not still at rest {:.1} % of {}",
            self.rms,
            self.worst,
            self.delay_ms,
            100.0 * self.wrong_sign,
            100.0 * self.restless,
            self.resting
        )
    }
}

pub fn resolution_rad(counts_per_turn: f64) -> f64 {
    TAU / counts_per_turn
}

/// What is counted on the way.
#[derive(Default)]
struct Sums {
    squares: f64,
    samples: f64,
    worst: f64,
    shifted: [f64; LONGEST_DELAY + 1],
    wrong: f64,
    turning: f64,
    restless: f64,
    resting: f64,
}

pub fn score(candidate: Candidate, counts_per_turn: f64, motions: &[Motion]) -> Score {
    let mut sums = Sums::default();
    for motion in motions {
        let mut estimated = [0, 1].map(|joint| rates(candidate, counts_per_turn, motion, joint));
        for (joint, rates) in estimated.iter_mut().enumerate() {
            base_joint(&mut sums, motion, joint, rates);
        }
        for (k, sample) in motion.iter().enumerate().skip(WARM_UP) {
            signs(&mut sums, sample, [estimated[0][k], estimated[1][k]]);
        }
    }
    Score {
        rms: (sums.squares / sums.samples).sqrt(),
        worst: sums.worst,
        delay_ms: 1e3 * SAMPLE_S * lowest(&sums.shifted),
        wrong_sign: sums.wrong / sums.turning,
        restless: sums.restless / sums.resting.max(1.0),
        resting: sums.resting,
    }
}

/// The estimated rates of a base joint, rad/s.
fn rates(candidate: Candidate, counts_per_turn: f64, motion: &Motion, joint: usize) -> Vec<f64> {
    let resolution_rad = resolution_rad(counts_per_turn);
    let mut estimator = Estimator::new(candidate);
    let count = |sample: &Sample| (sample.theta_rad[joint] / resolution_rad).round() as i64;
    let rate = |sample| estimator.update(count(sample)) * resolution_rad / SAMPLE_S;
    motion.iter().map(rate).collect()
}

fn base_joint(sums: &mut Sums, motion: &Motion, joint: usize, rates: &[f64]) {
    let truth = |k: usize| motion[k].rates_rad_s[joint];
    let mut still = 0;
    for (k, rate) in rates.iter().enumerate().skip(WARM_UP) {
        let error = rate - truth(k);
        sums.squares += error * error;
        sums.samples += 1.0;
        sums.worst = sums.worst.max(error.abs());
        for (shift, sum) in sums.shifted.iter_mut().enumerate() {
            let error = rate - truth(k - shift);
            *sum += error * error;
        }
        still = if truth(k) == 0.0 { still + 1 } else { 0 };
        if still > SETTLED {
            sums.resting += 1.0;
            sums.restless += f64::from(*rate != 0.0);
        }
    }
}

fn signs(sums: &mut Sums, sample: &Sample, estimate: [f64; 2]) {
    for row in sample.joints {
        let of = |[a, b]: [f64; 2]| row[0] * a + row[1] * b;
        let (truth, estimate) = (of(sample.rates_rad_s), of(estimate));
        if truth.abs() > 1e-6 {
            sums.turning += 1.0;
            sums.wrong += f64::from(truth * estimate < 0.0);
        }
    }
}

/// Where a curve through the least of some values is lowest.
fn lowest(values: &[f64]) -> f64 {
    let order = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
    let least = (0..values.len()).min_by(order).unwrap();
    if least == 0 || least + 1 == values.len() {
        return least as f64;
    }
    let [before, at, after] = [values[least - 1], values[least], values[least + 1]];
    least as f64 + 0.5 * (before - after) / (before - 2.0 * at + after)
}
