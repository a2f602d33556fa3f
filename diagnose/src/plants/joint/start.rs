//! This file estimates the start state of a free run: a parabola through the first samples, then a
//! fit of the model to the samples after it.

use super::drive::Efforts;
use super::laws::bend_bristles;
use super::simulate::{Free, Model, Protocol};
use crate::filter::rms;
use crate::plants::joint::run::JointRun;
use crate::problem::less;
use crate::rules::FITTED_TIMES;
use rigproof_model::axis::State;

/// Iterations of the fit. Over so short a stretch the model is nearly linear in its start state.
const ROUNDS: usize = 3;

/// The first sample of a free run, and the state there. `there` are the positions behind what the
/// encoder shows.
pub(super) fn begun(
    (plant, free): (&Model, &mut Free),
    (run, there): (&JointRun, &[f64]),
    fine: &Efforts,
    protocol: &Protocol,
) -> (usize, State) {
    let (first, position, speed) = start(there, run.step_s, protocol.start_samples);
    let begin_s = run.start_s + first as f64 * run.step_s;
    let state_at = |[position, speed]: [f64; 2], free: &mut Free| {
        free.take_hold(begin_s);
        let mut state = free.axis.state(begin_s, position, speed);
        bend_bristles(plant, &mut state.memory, speed);
        state
    };
    let mut best = [position, speed];
    let last = (first + FITTED_TIMES * protocol.start_samples).min(there.len().saturating_sub(1));
    let is_stated = first == 0 || protocol.warm_up_periods > 0;
    if is_stated || last <= first {
        return (first, state_at(best, free));
    }
    let step_s = run.step_s / protocol.substeps as f64;
    let errors = |at: [f64; 2], free: &mut Free| -> Vec<f64> {
        let mut state = state_at(at, free);
        let samples = fine.chunks(protocol.substeps).zip(there).zip(&run.recorded);
        let mut errors = Vec::with_capacity(last - first);
        for ((pairs, there), recorded) in samples.skip(first).take(last - first) {
            errors.push(f64::from(*recorded) * (state.position - there));
            free.take_hold(state.time_s);
            free.run(&mut state, pairs, step_s);
        }
        errors
    };
    let small = [
        run.position_noise.max(f64::MIN_POSITIVE),
        run.position_noise / (run.step_s * protocol.start_samples as f64),
    ];
    let mut least = errors(best, free);
    for _ in 0..ROUNDS {
        let slopes = [0, 1].map(|which| {
            let mut moved = best;
            if let (Some(own), Some(by)) = (moved.get_mut(which), small.get(which)) {
                *own += by;
            }
            less(&errors(moved, free), &least)
        });
        let Some([by_position, by_speed]) = step(&slopes, &least) else {
            break;
        };
        let [position, speed] = best;
        let [unit_position, unit_speed] = small;
        let tried = [
            position + by_position * unit_position,
            speed + by_speed * unit_speed,
        ];
        let left = errors(tried, free);
        if rms(&left) >= rms(&least) || !rms(&left).is_finite() {
            break;
        }
        (best, least) = (tried, left);
    }
    (first, state_at(best, free))
}

/// The least-squares step of the start state: `errors` projected on the two sensitivities.
fn step([a, b]: &[Vec<f64>; 2], errors: &[f64]) -> Option<[f64; 2]> {
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let gram = nalgebra::Matrix2::new(product(a, a), product(a, b), product(a, b), product(b, b));
    let right = nalgebra::Vector2::new(-product(a, errors), -product(b, errors));
    gram.lu().solve(&right).map(Into::into)
}

/// The end of a parabola through the first `samples` positions: sample, position and speed.
fn start(position: &[f64], step_s: f64, samples: usize) -> (usize, f64, f64) {
    if samples < 3 {
        return (0, position.first().copied().unwrap_or(0.0), 0.0);
    }
    let last = samples - 1;
    let points: Vec<(f64, f64)> = position
        .iter()
        .take(samples)
        .enumerate()
        .map(|(k, &x)| ((k as f64 - last as f64) * step_s, x))
        .collect();
    let [position, speed, _] = parabola(&points);
    (last, position, speed)
}

/// Least-squares coefficients of 1, t, t².
fn parabola(points: &[(f64, f64)]) -> [f64; 3] {
    let mut gram = nalgebra::Matrix3::zeros();
    let mut right = nalgebra::Vector3::zeros();
    let scale = points.first().map_or(1.0, |p| p.0.abs().max(1e-12));
    for &(t, x) in points {
        let row = nalgebra::Vector3::new(1.0, t / scale, t * t / (scale * scale));
        gram += row * row.transpose();
        right += row * x;
    }
    let c = gram.lu().solve(&right).unwrap_or_default();
    [c.x, c.y / scale, c.z / (scale * scale)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::joint::recorded::{NOMINAL, exact_axis, signals};
    use crate::plants::joint::refit::error_rms;
    use crate::plants::joint::simulate::tests::plant;

    #[test]
    fn the_start_state_of_a_parabola_is_its_end() {
        let mut run = exact_axis(NOMINAL, 40, true);
        let at = |t: f64| 0.37 - 1.9 * t + 5.3 * t * t;
        for (k, x) in run.position.iter_mut().enumerate() {
            *x = at(k as f64 * run.step_s);
        }
        let (first, position, speed) = start(&run.position, run.step_s, 17);
        let t = 16.0 * run.step_s;
        assert_eq!(first, 16);
        assert!((position - at(t)).abs() < 1e-12, "{position}");
        assert!((speed - (10.6 * t - 1.9)).abs() < 1e-9, "{speed}");
    }

    #[test]
    fn a_start_state_is_fitted_beyond_what_a_parabola_tells() {
        let mut run = exact_axis(NOMINAL, 1900, true);
        let seen = signals(&run, 37);
        run.position = seen.position;
        // With counts this coarse, the parabola's speed is wrong enough to spoil the whole run.
        let coarse = 2e-4;
        run.position_noise = coarse / libm::sqrt(12.0);
        let rounded = run.position.iter().map(|x| coarse * (x / coarse).round());
        run.position = rounded.collect();
        let fitted = error_rms(&plant(), &run, &Protocol::default());
        assert!(fitted < 1.5 * run.position_noise, "{fitted} m");
    }
}
