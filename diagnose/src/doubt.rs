//! This file varies a recorded motion within its uncertainty, to find how uncertain a brake's
//! torque is.

use crate::rules::{BEND_S, SENSE_SIGMAS};
use core::f64::consts::TAU;
use rigproof_model::effects::Instant;

/// How a position was smoothed.
pub struct Smoothing {
    /// Sample interval, s.
    pub step_s: f64,
    /// Cut-off of the low-pass, Hz.
    pub cutoff_hz: f64,
    /// Standard deviation of one sample of the position, m or rad.
    pub noise: f64,
    /// Speed below which noise decides the direction, m/s or rad/s.
    pub speed_floor: f64,
}

impl Smoothing {
    /// The uncertainty of the speed, one value per sample, m/s or rad/s.
    ///
    /// It has two parts: sensor noise, and the error of the low-pass where the acceleration jumps.
    /// The second is estimated from the difference between recorded and smoothed position, times
    /// `octaves`.
    pub fn untold_speeds(&self, raw: &[f64], motion: &[Instant], octaves: &[f64]) -> Vec<f64> {
        let reach = (BEND_S / self.step_s).round().max(1.0) as usize;
        let pairs = raw.iter().zip(motion);
        let bend: Vec<f64> = pairs.map(|(raw, now)| (raw - now.position).abs()).collect();
        let samples = octaves.iter().take(bend.len()).enumerate();
        samples
            .map(|(k, octaves)| {
                let around = bend.get(k.saturating_sub(reach)..(k + reach + 1).min(bend.len()));
                let greatest = around.into_iter().flatten().copied().fold(0.0, f64::max);
                // White noise alone differs by up to four standard deviations, and the floor
                // already counts those.
                let excess = (greatest - SENSE_SIGMAS * self.noise).max(0.0);
                self.speed_floor + octaves * TAU * self.cutoff_hz * excess
            })
            .collect()
    }
}

/// A motion with its speed changed by its uncertainty.
pub fn turning(motion: &[Instant], untold: &[f64], sign: f64) -> Vec<Instant> {
    let pairs = motion.iter().zip(untold);
    pairs
        .map(|(now, untold)| Instant {
            speed: (now.speed.abs() + sign * untold)
                .max(0.0)
                .copysign(now.speed),
            ..*now
        })
        .collect()
}

/// A motion whose position is one sample late.
pub fn a_sample_late(motion: &[Instant]) -> Vec<Instant> {
    let before = motion.iter().take(1).chain(motion);
    let pairs = motion.iter().zip(before);
    pairs
        .map(|(now, before)| Instant {
            position: before.position,
            ..*now
        })
        .collect()
}

/// A signal whose jumps come one sample late. Where it continues its slope it is unchanged.
pub fn jumps_late(signal: &[f64]) -> Vec<f64> {
    let begin = signal.iter().take(2).copied();
    let rest = signal.windows(3).map(|three| match three {
        [first, before, now] => (2.0 * before - first).clamp(before.min(*now), before.max(*now)),
        _ => f64::NAN,
    });
    begin.chain(rest).collect()
}

/// The greatest deviation of other signals from `own`, sample by sample.
pub fn greatest_change(own: &[f64], others: &[Vec<f64>]) -> Vec<f64> {
    let mut greatest = vec![0.0f64; own.len()];
    for other in others {
        let pairs = greatest.iter_mut().zip(own.iter().zip(other));
        pairs.for_each(|(greatest, (own, other))| *greatest = greatest.max((own - other).abs()));
    }
    greatest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_comes_late_and_a_slope_does_not() {
        let slope = [0.3, 0.4, 0.5, 0.61, 0.71];
        let late = jumps_late(&slope);
        let off = slope.iter().zip(&late).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 0.0101, "{late:?}");
        let late = jumps_late(&[0.2, 0.2, 0.2, 0.9, 0.9, 0.1, 0.1]);
        assert_eq!(late, [0.2, 0.2, 0.2, 0.2, 0.9, 0.9, 0.1]);
    }
}
