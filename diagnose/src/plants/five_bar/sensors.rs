//! This file is what the sensors of a five-bar leave unknown of a sample: the step of an encoder, and the noise of angles and forces.

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

/// The noise of a force as stated, else from its second differences, which a smooth force hardly has.
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
    // White noise: the median of a magnitude is 0.6745 of the standard deviation, that of a second difference √6 of a sample's.
    (median / (0.6745 * 6f64.sqrt())).max(smallest_step(&force.samples) / 12f64.sqrt())
}
