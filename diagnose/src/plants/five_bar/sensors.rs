//! This file gives the resolution and the noise of the five-bar's sensors.

use crate::align::smallest_step;
use rigproof_trace::rig::Signal;

pub(super) fn quantum_of(angle: &Signal) -> f64 {
    angle
        .quantum
        .unwrap_or_else(|| smallest_step(&angle.samples))
}

pub(super) fn angle_noise(angle: &Signal) -> f64 {
    (quantum_of(angle) / 12f64.sqrt()).hypot(angle.noise.unwrap_or(0.0))
}

/// The noise of a force as stated, otherwise estimated from its second differences, which are small
/// for a smooth force.
pub(super) fn noise_of_force(force: &Signal) -> f64 {
    if let Some(noise) = force.noise {
        return noise.hypot(force.quantum.unwrap_or(0.0) / 12f64.sqrt());
    }
    let mut bends: Vec<f64> = force
        .samples
        .windows(3)
        .filter_map(|w| match w {
            [a, b, c] => Some((a - 2.0 * b + c).abs()),
            _ => None,
        })
        .filter(|bend| bend.is_finite())
        .collect();
    bends.sort_by(f64::total_cmp);
    let median = bends.get(bends.len() / 2).copied().unwrap_or(0.0);
    // For white noise the median of a magnitude is 0.6745 standard deviations, and a second
    // difference has √6 times the deviation of a sample.
    (median / (0.6745 * 6f64.sqrt())).max(smallest_step(&force.samples) / 12f64.sqrt())
}
