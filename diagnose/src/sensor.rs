//! This file simulates a sensor: noise and quantisation.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use rigproof_trace::rig::Signal;

/// Nearly a standard normal draw: the sum of twelve uniform ones.
pub(crate) fn normal(random: &mut Pcg64Mcg) -> f64 {
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..12).map(|_| uniform()).sum::<f64>() - 6.0
}

/// The signal with fresh noise and quantised. The noise has the stated size, or that of an estimate
/// if none is stated.
pub(crate) fn sensed(signal: &Signal, estimate: f64, random: &mut Pcg64Mcg) -> Signal {
    let deviation = match (signal.noise, signal.quantum) {
        (None, None) => estimate,
        (noise, _) => noise.unwrap_or(0.0),
    };
    let mut out = signal.clone();
    for x in &mut out.samples {
        *x += deviation * normal(random);
        *x = signal
            .quantum
            .map_or(*x, |quantum| (*x / quantum).round() * quantum);
    }
    out
}
