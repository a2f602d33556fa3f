//! This file tells the noise of a channel from what the motion makes.

/// Fewer third differences do not tell.
const LEAST: usize = 60;
/// The median of the magnitude of a normal variable, in standard deviations.
const MEDIAN: f64 = 0.674_489_750_196_081_7;
/// The variance of a third difference of white noise, 1 + 9 + 9 + 1 times that of a sample.
const VARIANCE: f64 = 20.0;

/// About the standard deviation of the noise of a sample, or nothing where most samples say nothing of it.
///
/// Third differences take away what changes slowly from sample to sample, and their median what jumps now and then.
/// What the motion makes within four samples counts as noise, so that slowly sampled channels look too noisy.
pub fn of(samples: &[f64]) -> Option<f64> {
    of_runs(
        samples
            .windows(4)
            .filter_map(|run| run.first_chunk().copied()),
    )
}

/// The same, of runs of four samples that follow each other.
pub fn of_runs(runs: impl Iterator<Item = [f64; 4]>) -> Option<f64> {
    let mut sizes: Vec<f64> = runs
        .map(|[a, b, c, d]| (d - 3.0 * c + 3.0 * b - a).abs())
        .filter(|size| size.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes
        .get(sizes.len() / 2)
        .filter(|_| sizes.len() >= LEAST)?;
    let noise = median / MEDIAN / VARIANCE.sqrt();
    (noise > 0.0).then_some(noise)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn noise_is_told_from_motion_and_from_jumps() {
        // Twelve uniform numbers added make a normal one, nearly.
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut uniform = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state as f64 / u64::MAX as f64
        };
        let mut samples: Vec<f64> = (0..6000)
            .map(|k| {
                let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                let t = 2e-3 * f64::from(k);
                let jump = if t.rem_euclid(0.7) < 0.31 { 3.7 } else { -2.9 };
                jump + 4.3 * libm::sin(5.9 * t) + 0.0237 * normal
            })
            .collect();
        samples[77] = f64::NAN;
        let noise = of(&samples).unwrap();
        assert_relative_eq!(noise, 0.0237, max_relative = 0.06);
        assert!(of(&samples[..40]).is_none());
        assert!(of(&[2.5; 90]).is_none());
    }
}
