//! This file finds the stretches of a recording with constant current.

use crate::rules::{LEAST_TOLERANCE_A, SHORTEST_S, TOLERANCE_SIGMAS};
use core::ops::Range;

use super::sampled::{Sampled, median};

/// A stretch of constant current.
#[derive(Clone, Debug, PartialEq)]
pub struct Plateau {
    /// Its samples.
    pub samples: Range<usize>,
    /// Its mean current, A.
    pub current_a: f64,
}

/// The stretches of constant current, in order.
pub fn plateaus(sampled: &Sampled) -> Vec<Plateau> {
    let current = &sampled.current_a;
    let tolerance_a = (TOLERANCE_SIGMAS * noise_a(current)).max(LEAST_TOLERANCE_A);
    let mut found = Vec::new();
    let (mut first, mut sum) = (0, 0.0);
    let away = |k: usize, mean: f64| {
        current
            .get(k)
            .is_none_or(|i| (i - mean).abs() > tolerance_a)
    };
    for (k, value) in current.iter().enumerate() {
        let count = k - first;
        let mean = sum / count as f64;
        // A single sample is a disturbance, not a step.
        if count > 0 && away(k, mean) && away(k + 1, mean) {
            close(sampled, first..k, mean, &mut found);
            (first, sum) = (k, 0.0);
        }
        sum += value;
    }
    let count = current.len() - first;
    close(
        sampled,
        first..current.len(),
        sum / count as f64,
        &mut found,
    );
    found
}

fn close(sampled: &Sampled, samples: Range<usize>, current_a: f64, found: &mut Vec<Plateau>) {
    if sampled.part(samples.clone()).duration_s() >= SHORTEST_S {
        found.push(Plateau { samples, current_a });
    }
}

/// Standard deviation of the current's noise, from differences between samples.
fn noise_a(current: &[f64]) -> f64 {
    let steps = current.windows(2).map(|pair| match pair {
        [before, after] => (after - before).abs(),
        _ => 0.0,
    });
    let steps: Vec<f64> = steps.collect();
    // The median of |x − y| of two normal variables is 0.6745·√2 standard deviations.
    median(&steps) / 0.953_9
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(current_a: Vec<f64>) -> Sampled {
        let count = current_a.len();
        let line = |slope: f64| (0..count).map(|k| slope * k as f64).collect();
        Sampled {
            name: "run".to_owned(),
            time_s: line(0.001),
            position_rad: line(0.003),
            torque_nm: vec![0.7; count],
            current_a,
        }
    }

    #[test]
    fn a_ramp_between_two_currents_belongs_to_neither() {
        let mut current = vec![0.0; 150];
        current.extend((1..=7).map(|k| 0.1 * f64::from(k)));
        current.extend(vec![0.73; 130]);
        let found = plateaus(&sampled(current));
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].samples, 0..150);
        assert!((157..=158).contains(&found[1].samples.start), "{found:?}");
        assert!((found[1].current_a - 0.73).abs() < 1e-3);
    }

    #[test]
    fn one_disturbed_sample_divides_nothing_and_a_short_stretch_counts_for_nothing() {
        let mut current = vec![0.41; 300];
        current[170] = 0.9;
        current.extend(vec![0.62; 60]);
        let found = plateaus(&sampled(current));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].samples, 0..300);
        assert!((found[0].current_a - 0.41).abs() < 0.002);
    }

    #[test]
    fn a_current_that_never_stands_still_has_no_plateau() {
        let current = (0..900).map(|k| 0.5 + 0.5 * libm::sin(0.02 * f64::from(k)));
        for plateau in plateaus(&sampled(current.collect())) {
            // At most near the crests, where it is nearly constant.
            assert!(plateau.samples.len() < 120, "{plateau:?}");
        }
    }
}
