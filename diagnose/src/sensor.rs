//! This file says what a sensor makes of a quantity: noise, and counts.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use rigproof_trace::rig::Signal;

/// Close to a normal draw of variance 1: the sum of twelve uniform ones.
pub(crate) fn normal(random: &mut Pcg64Mcg) -> f64 {
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..12).map(|_| uniform()).sum::<f64>() - 6.0
}

/// The signal with fresh noise, in counts: of the size that it states, or of an estimate where it states none.
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
