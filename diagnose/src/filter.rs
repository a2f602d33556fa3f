//! This file is the zero-phase low-pass filter: Butterworth and Chebyshev sections run forward and backward.

use core::f64::consts::PI;

/// One second-order section in direct form II transposed, with `a0` = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

/// A low-pass filter of even order as a cascade of second-order sections.
#[derive(Clone, Debug, PartialEq)]
pub struct LowPass {
    sections: Vec<Section>,
    order: usize,
}

impl LowPass {
    /// Butterworth of even `order` with its −3 dB point at `cutoff` (fraction of the Nyquist rate, 0 to 1).
    pub fn butterworth(order: usize, cutoff: f64) -> LowPass {
        let poles = pole_angles(order).map(|angle| (-libm::sin(angle), libm::cos(angle)));
        LowPass::from_poles(poles, order, cutoff, 1.0)
    }

    /// Chebyshev type I of even `order` with `ripple_db` in the pass band that ends at `cutoff`.
    pub fn chebyshev(order: usize, ripple_db: f64, cutoff: f64) -> LowPass {
        let epsilon = libm::sqrt(libm::pow(10.0, ripple_db / 10.0) - 1.0);
        let mu = libm::asinh(1.0 / epsilon) / order as f64;
        let poles = pole_angles(order).map(|angle| {
            (
                -libm::sinh(mu) * libm::sin(angle),
                libm::cosh(mu) * libm::cos(angle),
            )
        });
        let gain = 1.0 / libm::sqrt(1.0 + epsilon * epsilon);
        LowPass::from_poles(poles, order, cutoff, gain)
    }

    /// Bilinear transform of analog poles `(real, imaginary)` (upper half plane) to sections.
    fn from_poles(
        poles: impl Iterator<Item = (f64, f64)>,
        order: usize,
        cutoff: f64,
        gain: f64,
    ) -> LowPass {
        let w = libm::tan(0.5 * PI * cutoff);
        let mut sections: Vec<Section> = poles
            .map(|(re, im)| {
                let square = (re * re + im * im) * w * w;
                let a0 = 1.0 - 2.0 * re * w + square;
                let b = square / a0;
                Section {
                    b: [b, 2.0 * b, b],
                    a: [
                        2.0 * (square - 1.0) / a0,
                        (1.0 + 2.0 * re * w + square) / a0,
                    ],
                }
            })
            .collect();
        if let Some(first) = sections.first_mut() {
            first.b = first.b.map(|b| b * gain);
        }
        LowPass { sections, order }
    }

    /// Filters forward and backward, with the ends extended by odd reflection.
    ///
    /// The output has the length of the input. A signal of fewer than two samples is returned
    /// unchanged.
    pub fn zero_phase(&self, signal: &[f64]) -> Vec<f64> {
        let (Some(&first), Some(&last)) = (signal.first(), signal.last()) else {
            return Vec::new();
        };
        let pad = (3 * (2 * self.order + 1)).min(signal.len().saturating_sub(1));
        let before = signal
            .iter()
            .skip(1)
            .take(pad)
            .rev()
            .map(|x| 2.0 * first - x);
        let after = signal
            .iter()
            .rev()
            .skip(1)
            .take(pad)
            .map(|x| 2.0 * last - x);
        let mut extended: Vec<f64> = before.chain(signal.iter().copied()).chain(after).collect();
        self.run(&mut extended);
        extended.reverse();
        self.run(&mut extended);
        extended.reverse();
        extended.into_iter().skip(pad).take(signal.len()).collect()
    }

    /// Runs the cascade in place, started in the steady state of the first sample.
    fn run(&self, signal: &mut [f64]) {
        for section in &self.sections {
            let Section {
                b: [b0, b1, b2],
                a: [a1, a2],
            } = *section;
            let gain = (b0 + b1 + b2) / (1.0 + a1 + a2);
            let start = signal.first().copied().unwrap_or(0.0);
            let mut state = [(gain - b0) * start, (b2 - a2 * gain) * start];
            for x in signal.iter_mut() {
                let y = b0 * *x + state[0];
                state = [b1 * *x - a1 * y + state[1], b2 * *x - a2 * y];
                *x = y;
            }
        }
    }
}

/// Angles of the upper-half poles of an even-order prototype, measured from the imaginary axis.
fn pole_angles(order: usize) -> impl Iterator<Item = f64> {
    (0..order / 2).map(move |k| PI * (2 * k + 1) as f64 / (2 * order) as f64)
}

/// Central difference of a signal, one-sided at its ends, per second.
pub fn gradient(signal: &[f64], step_s: f64) -> Vec<f64> {
    let n = signal.len();
    let at = |k: usize| signal.get(k).copied().unwrap_or(0.0);
    (0..n)
        .map(|k| {
            let (low, high) = (k.saturating_sub(1), (k + 1).min(n - 1));
            (at(high) - at(low)) / (step_s * (high - low).max(1) as f64)
        })
        .collect()
}

/// Root mean square; 0 for an empty slice.
pub fn rms(values: &[f64]) -> f64 {
    let sum: f64 = values.iter().map(|x| x * x).sum();
    (sum / values.len().max(1) as f64).sqrt()
}

/// The least and the greatest of the values; NaN counts for neither.
pub fn ends(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let each = values.into_iter();
    each.fold(start, |[low, high], x| [low.min(x), high.max(x)])
}

/// Root mean square of the usable ones among values.
pub fn usable_rms(values: &[f64], usable: &[bool]) -> f64 {
    let kept = values.iter().zip(usable).filter(|(_, usable)| **usable);
    rms(&kept.map(|(value, _)| *value).collect::<Vec<f64>>())
}

/// About the standard deviation of the noise of a sample that is white, from sixth differences.
///
/// They take away what changes slowly from sample to sample, and their median what jumps now and then. `None` where
/// most of them are zero, as in a channel that mostly rests on one step.
pub fn white_noise(signal: &[f64]) -> Option<f64> {
    let mut differences = signal.to_vec();
    for _ in 0..6 {
        let pairs = differences.iter().zip(differences.iter().skip(1));
        differences = pairs.map(|(own, next)| next - own).collect();
    }
    // The squared binomials of the sixth row.
    let noise = deviation(differences)? / 924_f64.sqrt();
    (noise > 0.0).then_some(noise)
}

/// The standard deviation of normal values about 0, by the median of their magnitudes.
pub fn deviation(values: Vec<f64>) -> Option<f64> {
    let mut sizes: Vec<f64> = values.into_iter().map(f64::abs).collect();
    sizes.sort_by(f64::total_cmp);
    // The median of the magnitude of a normal variable.
    Some(sizes.get(sizes.len() / 2)? / 0.674_489_750_196_081_7)
}

/// Keeps every `factor`-th sample after the Chebyshev anti-alias filter of the published protocols
/// (order 8, 0.05 dB, 0.8 of the new Nyquist rate, zero phase).
pub fn decimate(signal: &[f64], factor: usize) -> Vec<f64> {
    LowPass::chebyshev(8, 0.05, 0.8 / factor as f64)
        .zero_phase(signal)
        .into_iter()
        .step_by(factor)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signal() -> Vec<f64> {
        (0..60)
            .map(|k| libm::sin(0.21 * k as f64) + 0.3 * libm::cos(1.7 * k as f64) + 0.01 * k as f64)
            .collect()
    }

    // Expected values: SciPy 1.x `sosfiltfilt` of `butter(4, 0.23)` with padlen 27 and of
    // `cheby1(8, 0.05, 0.16)` with padlen 51, samples 0, 7, 31 and 59 of the signal above.
    fn agrees(filter: &LowPass, expected: [f64; 4]) {
        let filtered = filter.zero_phase(&signal());
        for (index, expected) in [0, 7, 31, 59].into_iter().zip(expected) {
            let error = (filtered[index] - expected).abs();
            assert!(
                error < 1e-12,
                "sample {index}: {} not {expected}",
                filtered[index]
            );
        }
    }

    #[test]
    fn butterworth_agrees_with_scipy() {
        agrees(
            &LowPass::butterworth(4, 0.23),
            [
                0.30006264869036525,
                1.0683925902663738,
                0.5349022215495596,
                0.7065159510782164,
            ],
        );
    }

    #[test]
    fn chebyshev_agrees_with_scipy() {
        agrees(
            &LowPass::chebyshev(8, 0.05, 0.16),
            [
                0.30243724777566566,
                0.999039584362279,
                0.510438225358606,
                0.6971447620688453,
            ],
        );
    }

    #[test]
    fn white_noise_is_told_from_motion_and_jumps() {
        // A multiplicative generator; twelve uniform numbers added are nearly normal.
        let mut state = 77_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let noisy: Vec<f64> = (0..8000)
            .map(|k| {
                let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                let t = 1e-3 * f64::from(k);
                let side = if t.rem_euclid(0.61) < 0.27 { 2.0 } else { -3.0 };
                side + 5.0 * libm::sin(60.0 * t) + 0.031 * normal
            })
            .collect();
        let found = white_noise(&noisy).unwrap();
        assert!((found / 0.031 - 1.0).abs() < 0.1, "{found}");
        assert_eq!(white_noise(&[1.0; 100]), None);
    }
}
