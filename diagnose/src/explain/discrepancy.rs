//! This file says how many neighbouring rows of a residual count as one independent sample.

use super::folds::Folds;
use crate::problem::Problem;
use crate::rules::{FEWEST_REPEATS, LEAST_CORRELATION, ROWS_A_SAMPLE};

/// The number of rows that carry as much information as one independent sample. `left` is the white
/// residual of the best explanation, 0 where a row is not usable.
///
/// It is `ROWS_A_SAMPLE` times the integrated autocorrelation, at most one block, since blocks are
/// taken as independent. A residual that repeats with a repeating motion is counted once.
pub fn rows_a_sample(problem: &Problem, folds: &Folds, left: &[f64]) -> f64 {
    let outputs = problem.windows.outputs;
    let within = (ROWS_A_SAMPLE * correlation(left, outputs))
        .min(folds.mean_rows() / outputs as f64)
        .max(ROWS_A_SAMPLE);
    let driving = problem.windows.average(&problem.run.driving());
    let mean = driving.iter().sum::<f64>() / driving.len().max(1) as f64;
    let driving: Vec<f64> = driving.iter().map(|own| own - mean).collect();
    within * repeated(&driving, left, outputs)
}

/// The number of times that a residual repeats with the motion: the design effect of clustered
/// samples (Kish, Survey Sampling, 1965), with the weights of Newey and West (Econometrica 55,
/// 1987). 1 where motion or residual does not repeat. `outputs` rows belong to one time.
fn repeated(driving: &[f64], residual: &[f64], outputs: usize) -> f64 {
    let most = driving.len() / outputs / FEWEST_REPEATS;
    let motion = |lag: usize| {
        let (earlier, later) = (driving.len() - lag * outputs, lag * outputs);
        let parts = [driving.get(..earlier), driving.get(later..)].map(Option::unwrap_or_default);
        let sizes = parts.map(|own| products(own, 0).sqrt());
        products(driving, lag * outputs) / sizes.iter().product::<f64>().max(1e-300)
    };
    let left = |lag: usize| products(residual, lag * outputs) / products(residual, 0).max(1e-300);
    let lags: Vec<f64> = (0..=most).map(motion).collect();
    let turned = lags.iter().position(|own| *own <= 0.0);
    let open = lags.get(turned.unwrap_or(lags.len())..).unwrap_or_default();
    let best = open.iter().copied().fold(0.0, f64::max);
    // The first peak that is as high as the highest: later ones are its multiples.
    let is_peak = |own: &[f64]| matches!(own, [a, b, c] if a <= b && b >= c && *b >= best - LEAST_CORRELATION);
    let Some(peak) = open.windows(3).position(is_peak) else {
        return 1.0;
    };
    let period = turned.unwrap_or(0) + peak + 1;
    let count = driving.len() / outputs / period;
    let pairs = (1..count).map(|k| {
        let weight = 1.0 - k as f64 / count as f64;
        let lag = k * period;
        2.0 * weight * motion(lag).max(0.0) * left(lag)
    });
    1.0 + pairs.sum::<f64>().max(0.0)
}

/// The integrated autocorrelation of white rows, in rows of one equation: 1 where they are
/// independent.
fn correlation(left: &[f64], outputs: usize) -> f64 {
    let variance = products(left, 0).max(1e-300);
    let lags = (1..left.len() / outputs / 4).map(|lag| products(left, lag * outputs) / variance);
    let alike = lags.take_while(|own| *own >= LEAST_CORRELATION);
    1.0 + 2.0 * alike.sum::<f64>()
}

/// The sum of products of rows with those `later` rows on.
fn products(rows: &[f64], later: usize) -> f64 {
    rows.iter()
        .zip(rows.iter().skip(later))
        .map(|(a, b)| a * b)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wandering(keeps: f64) -> Vec<f64> {
        let mut state = 1_u64;
        let mut value = 0.0;
        let rows = (0..4000).map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            value = keeps * value + (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            value
        });
        rows.collect()
    }

    #[test]
    fn independent_rows_are_one_apiece() {
        assert!((correlation(&wandering(0.0), 1) - 1.0).abs() < 0.2);
    }

    #[test]
    fn what_comes_again_with_the_motion_is_counted_once() {
        let turning = |k: usize| libm::sin(core::f64::consts::TAU * k as f64 / 100.0);
        let motion: Vec<f64> = (0..2000).map(turning).collect();
        let bent: Vec<f64> = motion.iter().map(|x| x * x * x).collect();
        // Twenty repetitions, with the weights of so few.
        let own = repeated(&motion, &bent, 1);
        assert!((own - 13.0).abs() < 1.0, "{own}");
        let noise = &wandering(0.0)[..2000];
        assert!((repeated(&motion, noise, 1) - 1.0).abs() < 0.7);
        let own = repeated(&wandering(0.9)[..2000], &bent, 1);
        assert!(own < 2.5, "{own}");
    }

    #[test]
    fn equations_that_stand_row_by_row_are_not_taken_for_one_another() {
        let [one, two] = [0.0, 0.8].map(wandering);
        let both: Vec<f64> = one.iter().zip(&two).flat_map(|(a, b)| [*a, *b]).collect();
        // The second output has 1/(1 - 0.8²) of the energy of the first.
        let share = 1.0 / (1.0 + 0.36);
        let own = correlation(&both, 2);
        assert!((own - (1.0 + share * 8.0)).abs() < 2.0, "{own}");
    }

    #[test]
    fn a_wandering_rest_says_less() {
        // The integrated autocorrelation of an autoregressive process is (1 + a)/(1 - a).
        let own = correlation(&wandering(0.8), 1);
        assert!((own - 9.0).abs() < 2.5, "{own}");
    }
}
